// SPDX-License-Identifier: MIT
// sivid-import MAPPING.json --out DIR: recorded files of any form into a data set.
#include <sivid/io/import_writer.hpp>

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

namespace {

enum exit_code { done = 0, bad_input = 2, internal_error = 70 };

int refuse(std::exception const& e) {
    std::cerr << "sivid-import: " << e.what() << "\n";
    return bad_input;
}

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
        return app.exit(e) == 0 ? done : bad_input;
    }
    auto const imported = sivid::import_dataset(sivid::read_import_mapping(mapping));
    sivid::write_import(imported, out);
    if (!quiet) std::cout << imported.protocol.text();
    return done;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return parse_and_run(argc, argv);
    } catch (sivid::input_error const& e) {
        return refuse(e);
    } catch (sivid::output_error const& e) {
        return refuse(e);
    } catch (std::exception const& e) {
        std::cerr << "sivid-import: internal error: " << e.what() << "\n";
        return internal_error;
    }
}
