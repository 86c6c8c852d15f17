// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_IMPORT_WRITER_HPP
#define SIVID_IMPORTING_IMPORT_WRITER_HPP

#include <sivid/importing/scenario/dataset_import.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_writer.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/text/text_file.hpp>

#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

namespace sivid {

/// Stores an imported data set as a folder: the data set, import.txt and import.json (the
/// protocol). It is written beside the folder and read back first. A new folder appears whole; in
/// one that is there the files take their names together (`file_set`): what cannot be written
/// leaves it as it was, and at no time does a mixture of two imports read as a data set.
/// @param model  of which it has to be; null: of whichever has its channels and inputs
/// @throws output_error
/// @throws input_error  when it is not of the model
/// @throws std::logic_error  when the reader refuses what was written
inline void write_import(imported_dataset const& imported, std::filesystem::path const& folder,
                         model_names const* model = nullptr) {
    namespace fs = std::filesystem;
    auto target = fs::absolute(folder).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();
    auto const staging = target.parent_path() / (target.filename().string() + ".part" +
                                                 std::to_string(std::random_device{}()));
    std::error_code fault;
    struct cleaner {
        fs::path const& path;
        ~cleaner() {
            std::error_code ignored;
            fs::remove_all(path, ignored);
        }
    } const clean{staging};
    auto const write_to = [&](fs::path const& place) {
        file_set files{place};
        files.add("import.txt", imported.protocol.text());
        files.add("import.json", imported.protocol.json());
        add_dataset(files, imported.data, imported.names); // dataset.json last
        files.commit();
    };
    write_to(staging);
    try {
        (void)read_dataset(staging, imported.names);
    } catch (input_error const& e) {
        throw std::logic_error{std::string{"the imported data set is not valid: "} + e.what()};
    }
    try {
        if (model != nullptr) (void)read_dataset(staging, *model);
    } catch (input_error const& e) {
        auto const& at = e.place().pointer;
        throw input_error{{.file = imported.protocol.mapping},
                          text_of("what it makes is not of the model: ",
                                  at.empty() ? "" : at + ": ", e.problem()),
                          e.remedy()};
    }
    if (!fs::exists(target, fault)) {
        fs::rename(staging, target, fault);
        if (fault) throw output_error{target.string() + ": cannot be written: " + fault.message()};
        return;
    }
    write_to(target);
}

} // namespace sivid

#endif // SIVID_IMPORTING_IMPORT_WRITER_HPP
