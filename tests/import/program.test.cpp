// SPDX-License-Identifier: MIT
// The program as a user runs it: exit codes, files, messages.
#include "io/matlab_support.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;

namespace {

support::finished_program run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "import");
    return support::run_program(IMPORT_PROGRAM, arguments);
}

/// A zlib stream that holds the text as it is, in blocks that are not compressed.
std::string stored_by_zlib(std::string const& text) {
    std::string out = "\x78\x01";
    std::uint32_t a = 1, b = 0;
    for (std::size_t i = 0; i < text.size() || i == 0; i += 60000) {
        auto const part = text.substr(i, 60000);
        auto const size = static_cast<std::uint16_t>(part.size());
        out += i + 60000 >= text.size() ? '\1' : '\0';
        for (int const x : {size & 0xFF, size >> 8, ~size & 0xFF, (~size >> 8) & 0xFF})
            out += static_cast<char>(x);
        out += part;
    }
    for (char const c : text) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    for (std::uint32_t const x : {b >> 8, b, a >> 8, a}) out += static_cast<char>(x & 0xFF);
    return out;
}

std::string const examples = std::string{SIVID_SOURCE_DIR} + "/examples/import/";

} // namespace

TEST_CASE("the worked examples are imported", "[import]") {
    for (std::string const name : {"german_logger", "serial_stream"}) {
        CAPTURE(name);
        temporary_folder const folder;
        auto const out = folder.path() / "out";
        auto const r = run({examples + name + "/mapping.json", "--out", out.string()});
        CHECK(r.code == 0);
        CHECK(r.err.empty());
        CHECK(r.out == folder.read("out/import.txt"));
        CHECK_THAT(r.out, ContainsSubstring("dropped: "));
        CHECK(fs::exists(out / "dataset.json"));
        CHECK(fs::exists(out / "import.json"));
        // Quietly, and over the old one.
        auto const again =
            run({examples + name + "/mapping.json", "--out", out.string(), "--quiet"});
        CHECK(again.code == 0);
        CHECK(again.out.empty());
    }
}

TEST_CASE("bad input: code 2, one message with file, line, field and remedy, nothing written",
          "[import]") {
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    auto const mapping = folder.path() / "mapping.json";
    temporary_folder const source;
    auto const original = [&] {
        fs::copy(examples + "german_logger", source.path(), fs::copy_options::recursive);
        return std::pair{source.read("mapping.json"), source.read("motor.csv")};
    }();
    auto const refused = [&](std::string const& m, std::string const& csv) {
        folder.write("mapping.json", m);
        folder.write("motor.csv", csv);
        auto const r = run({mapping.string(), "--out", out.string()});
        CHECK(r.code == 2);
        CHECK(r.out.empty());
        CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
        CHECK_FALSE(fs::exists(out));
        return r.err;
    };
    auto const& [m, csv] = original;
    using io_support::replaced;
    CHECK_THAT(refused(m, replaced(csv, "1520;", "15x20;")),
               ContainsSubstring(
                   "motor.csv: line 9, column 1 (Zeit): '15x20' is no time of the unit that the "
                   "mapping states; "));
    CHECK_THAT(refused(m, replaced(csv, "1520;0,00;", "1520;")),
               ContainsSubstring("motor.csv: line 9: 3 cells in a table of 4 columns; "));
    CHECK_THAT(refused(replaced(m, "\"Drehzahl\"", "\"Umdrehungen\""), csv),
               ContainsSubstring("mapping.json: /scenarios/0/channels/omega/column: "));
    CHECK_THAT(refused(replaced(m, "\"---\"", ""), csv),
               ContainsSubstring("'---' is not a finite number"));
    CHECK_THAT(refused(replaced(m, "\"interpolation\": \"hold\",", ""), csv),
               ContainsSubstring("a key is missing: /scenarios/0/interpolation ("));
    CHECK_THAT(refused(replaced(m, "motor.csv", "engine.csv"), csv),
               ContainsSubstring("no such file"));
    CHECK_THAT(refused("{", csv), ContainsSubstring("malformed JSON"));
    fs::remove(mapping);
    CHECK(run({mapping.string(), "--out", out.string()}).code == 2);
    // A folder that cannot be written.
    folder.write("file", "x");
    CHECK(run({examples + "german_logger/mapping.json", "--out", (folder.path() / "file").string()})
              .code == 2);
    CHECK(folder.read("file") == "x");
}

TEST_CASE("compressed MATLAB files: read, or refused with a way out", "[import]") {
    temporary_folder const folder;
    io_support::matlab_writer const w;
    auto const packed = stored_by_zlib(w.doubles("y", 1, 3, {1, 2, 4}));
    folder.write("mapping.json", R"({ "format": "sivid-mapping-1", "id": "i", "model": "m",
      "parameters": { "k": { "prior": [0, 1] } }, "max_outlier_fraction": 0,
      "scenarios": [ { "name": "A", "file": "a.mat", "source": { "kind": "matlab" },
                       "time": { "sample_time": 0.5 },
                       "channels": { "h": { "column": "y", "error": 0.1 } } } ] })");
    auto const import_mat = [&](std::string const& stream) {
        folder.write("a.mat", w.file(w.element(15, stream, false)));
        fs::remove_all(folder.path() / "out");
        return run(
            {(folder.path() / "mapping.json").string(), "--out", (folder.path() / "out").string()});
    };
    auto const whole = import_mat(packed);
    if (whole.code == 2) {
        CHECK_THAT(whole.err, ContainsSubstring("libmatio-dev"));
        SIVID_SKIP("sivid was built without libmatio");
    }
    CHECK(whole.code == 0);
    CHECK_THAT(folder.read("out/A.measurements.csv"), ContainsSubstring("\n1,4,0.1\n"));
    for (std::size_t at = 0; at < packed.size(); ++at) { // one byte wrong, or the end cut off
        auto wrong = packed;
        wrong[at] = static_cast<char>(wrong[at] ^ 0x20);
        for (auto const& stream : {wrong, packed.substr(0, at)}) {
            auto const r = import_mat(stream);
            CAPTURE(at, stream.size(), r.err);
            if (r.code == 0) { // bits that say nothing: at the end of a block's head
                CHECK(at == 2);
                CHECK_THAT(folder.read("out/A.measurements.csv"), ContainsSubstring("\n1,4,0.1\n"));
                continue;
            }
            CHECK(r.code == 2);
            CHECK_THAT(r.err, ContainsSubstring("a.mat"));
        }
    }
}

TEST_CASE("usage", "[import]") {
    CHECK(run({}).code == 2);
    CHECK(run({"mapping.json"}).code == 2);
    auto const nowhere = run({"mapping.json", "--out", ""});
    CHECK(nowhere.code == 2);
    CHECK_THAT(nowhere.err, ContainsSubstring("--out is empty"));
    CHECK(run({"mapping.json", "--out", "x", "--unknown"}).code == 2);
    auto const help = run({"--help"});
    CHECK(help.code == 0);
    CHECK_THAT(help.out, ContainsSubstring("--out"));
}
