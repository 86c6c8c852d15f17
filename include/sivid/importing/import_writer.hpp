// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_IMPORT_WRITER_HPP
#define SIVID_IMPORTING_IMPORT_WRITER_HPP

#include <sivid/importing/scenario/detail/dataset_import.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_writer.hpp>

#include <algorithm>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace sivid {

/// Stores an imported data set as a folder: the data set, import.txt and import.json (the
/// protocol). It is written beside the folder, read back, and moved there only then: whatever
/// fails, the folder stays as it was.
/// @throws output_error
/// @throws std::logic_error  when the reader refuses what was written
inline void write_import(imported_dataset const& imported, std::filesystem::path const& folder) {
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
    write_dataset(imported.data, imported.names, staging);
    write_atomically(staging / "import.txt", imported.protocol.text());
    write_atomically(staging / "import.json", imported.protocol.json());
    try {
        (void)read_dataset(staging, imported.names);
    } catch (input_error const& e) {
        throw std::logic_error{std::string{"the imported data set is not valid: "} + e.what()};
    }
    auto const give_up = [&] {
        throw output_error{target.string() + ": cannot be written: " + fault.message()};
    };
    if (!fs::exists(target, fault)) {
        fs::rename(staging, target, fault);
        if (fault) give_up();
        return;
    }
    std::vector<fs::path> files;
    for (auto const& file : fs::directory_iterator{staging})
        files.push_back(file.path().filename());
    // dataset.json last: with it the folder reads as complete.
    std::partition(files.begin(), files.end(), [](auto const& f) { return f != "dataset.json"; });
    for (auto const& file : files) {
        fs::rename(staging / file, target / file, fault);
        if (fault) give_up();
    }
}

} // namespace sivid

#endif // SIVID_IMPORTING_IMPORT_WRITER_HPP
