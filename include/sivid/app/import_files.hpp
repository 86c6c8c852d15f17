// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPORT_FILES_HPP
#define SIVID_APP_IMPORT_FILES_HPP

#include <sivid/app/program.hpp>
#include <sivid/importing/import_writer.hpp>
#ifdef SIVID_HAS_MATIO
#include <sivid/importing/matlab_reader.hpp>
#endif

#include <filesystem>
#include <iostream>

namespace sivid::app {

/// Imports the files that a mapping names into a data set, and prints the protocol of what was
/// dropped. @returns an exit code. @throws input_error, output_error
inline int import_files(std::filesystem::path const& mapping, std::filesystem::path const& out,
                        bool quiet) {
    if (out.empty()) throw output_error("--out is empty: give a folder for the data set");
    import_tools tools;
#ifdef SIVID_HAS_MATIO
    tools.read_matlab = read_matlab;
#endif
    auto const imported = import_dataset(read_import_mapping(mapping), tools);
    write_import(imported, out);
    if (!quiet) std::cout << imported.protocol.text();
    return done;
}

} // namespace sivid::app

#endif
