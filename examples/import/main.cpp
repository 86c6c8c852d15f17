// SPDX-License-Identifier: MIT
// sivid-import MAPPING.json --out DIR: recorded files of any form into a data set.
#include "console/program.hpp"

#include <sivid/importing/import_writer.hpp>
#ifdef SIVID_HAS_MATIO
#include <sivid/importing/matlab_reader.hpp>
#endif

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>

namespace {

int parse_and_run(int argc, char** argv) {
    std::filesystem::path mapping, out;
    bool quiet = false;
    CLI::App app{"Imports recorded files into a data set (sivid-dataset-1)"};
    app.add_option("mapping", mapping, "what the files hold (sivid-mapping-1)")->required();
    app.add_option("--out", out, "folder for the data set, import.txt and import.json")->required();
    app.add_flag("--quiet", quiet, "do not show the protocol");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    if (out.empty()) throw sivid::output_error("--out is empty: give a folder for the data set");
    sivid::import_tools tools;
#ifdef SIVID_HAS_MATIO
    tools.read_matlab = sivid::read_matlab;
#endif
    auto const imported = sivid::import_dataset(sivid::read_import_mapping(mapping), tools);
    sivid::write_import(imported, out);
    if (!quiet) std::cout << imported.protocol.text();
    return console::done;
}

} // namespace

int main(int argc, char** argv) {
    return console::guarded("sivid-import", [&] { return parse_and_run(argc, argv); });
}
