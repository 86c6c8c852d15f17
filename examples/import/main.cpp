// SPDX-License-Identifier: MIT
// sivid-import MAPPING.json --out DIR: recorded files of any form into a data set.
#include <sivid/app/import_files.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>

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
        return app.exit(e) == 0 ? 0 : static_cast<int>(sivid::app::bad_input);
    }
    return sivid::app::import_files(mapping, out, quiet);
}

} // namespace

int main(int argc, char** argv) {
    return sivid::app::guarded("sivid-import", [&] { return parse_and_run(argc, argv); });
}
