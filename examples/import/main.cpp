// SPDX-License-Identifier: MIT
// sivid-import MAPPING.json --out DIR: recorded files of any form into a data set.
#include "console/program.hpp"

#include <sivid/importing/import_writer.hpp>

#include <CLI/CLI.hpp>
#ifdef SIVID_HAS_ZLIB
#include <zlib.h>
#endif

#include <array>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

namespace {

#ifdef SIVID_HAS_ZLIB
/// Undoes zlib's compression; nothing when it is damaged or longer than so many bytes.
std::optional<std::string> inflated(std::string_view packed, std::size_t most) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return std::nullopt;
    // zlib takes the input by a pointer that is not const, and leaves it alone. Elements of MATLAB
    // files are below 4 GB.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    std::string text;
    std::array<char, 65536> buffer;
    int state = Z_OK;
    while (state == Z_OK && text.size() <= most) {
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        state = inflate(&stream, Z_NO_FLUSH);
        text.append(buffer.data(), buffer.size() - stream.avail_out);
    }
    inflateEnd(&stream);
    if (state != Z_STREAM_END || text.size() > most) return std::nullopt;
    return text;
}
#endif

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
#ifdef SIVID_HAS_ZLIB
    tools.inflate = inflated;
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
