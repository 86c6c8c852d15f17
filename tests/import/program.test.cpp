// SPDX-License-Identifier: MIT
// The program as a user runs it: exit codes, files, messages.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;

namespace {

support::finished_program run(std::vector<std::string> const& arguments) {
    return support::run_program(IMPORT_PROGRAM, arguments);
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
    CHECK_THAT(
        refused(m, replaced(csv, "1520;", "15x20;")),
        ContainsSubstring("motor.csv: line 9, column 1 (Zeit): '15x20' is not a finite number; "));
    CHECK_THAT(refused(m, replaced(csv, "1520;0,00;", "1520;")),
               ContainsSubstring("motor.csv: line 9: 3 cells in a table of 4 columns; "));
    CHECK_THAT(refused(replaced(m, "\"Drehzahl\"", "\"Umdrehungen\""), csv),
               ContainsSubstring("mapping.json: /scenarios/0/channels/omega/column: "));
    CHECK_THAT(refused(replaced(m, "\"---\"", ""), csv),
               ContainsSubstring("'---' is not a finite number"));
    CHECK_THAT(refused(replaced(m, "\"interpolation\": \"hold\",", ""), csv),
               ContainsSubstring("the key 'interpolation' is missing"));
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

TEST_CASE("usage", "[import]") {
    CHECK(run({}).code == 2);
    CHECK(run({"mapping.json"}).code == 2);
    CHECK(run({"mapping.json", "--out", "x", "--unknown"}).code == 2);
    auto const help = run({"--help"});
    CHECK(help.code == 0);
    CHECK_THAT(help.out, ContainsSubstring("--out"));
}
