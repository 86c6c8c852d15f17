// SPDX-License-Identifier: MIT
#include <sivid/importing/table/recorded_files.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using namespace io_support;

namespace {

/// Three scenarios of one table, the third with other columns.
std::string three() {
    std::string text{csv_mapping};
    auto const from = text.find("    { \"name\"");
    auto const one = text.substr(from, text.rfind(" ]") - from);
    auto const second =
        replaced(replaced(one, "\"A\"", "\"B\""), "\"offset\": 0", "\"offset\": -0.1");
    auto const third = replaced(replaced(one, "\"A\"", "\"C\""), "\"level\"", "\"bound\"");
    return text.insert(text.rfind(" ]"), ", " + second + ", " + third);
}

} // namespace

TEST_CASE("a file is read once for all scenarios that take the same of it") {
    temporary_folder const folder;
    folder.write("mapping.json", three());
    auto const mapping = read_import_mapping(folder.path() / "mapping.json");
    int count = 0;
    import_tools tools;
    tools.read = [&](fs::path const& file) {
        CHECK(file.filename() == "a.csv");
        ++count;
        return "# first\n" + std::string{small_table};
    };
    recorded_files files{mapping, tools};
    CHECK(files.read(mapping.scenarios[0]).lines == 6);
    auto const* a = &files.read(mapping.scenarios[1]);
    CHECK(count == 1);
    CHECK(a->stretches.at(0).rows.size() == 4);
    CHECK(*files.read(mapping.scenarios[2]).stretches.at(0).rows[0].cells[1] == dec("1"));
    CHECK(count == 2);
    // What is imported is the same as file by file, notes included.
    count = 0;
    auto const all = import_dataset(mapping, tools);
    CHECK(count == 2);
    CHECK(all.data.scenarios.at(1).duration == 0.2);
    CHECK(all.data.scenarios.at(2).stated.at(0).value == dec("0.01"));
    CHECK(has_note(all.protocol, "time shifted by -0.1 s"));
}

TEST_CASE("the notes of a log that several scenarios read are told for each") {
    temporary_folder const folder;
    std::string text{serial_mapping};
    auto const from = text.find("    { \"name\"");
    auto const one = text.substr(from, text.rfind(" ]") - from);
    folder.write("mapping.json",
                 text.insert(text.rfind(" ]"), ", " + replaced(one, "\"A\"", "\"B\"")));
    folder.write("a.log", "garbage\n" + serial_lines(0, 20));
    auto const r = import_in(folder);
    CHECK(noted(r.protocol, "not as many cells") == std::vector<std::size_t>{1, 1});
}

TEST_CASE("MATLAB files go through the program's function, or are refused with a way out") {
    temporary_folder const folder;
    folder.write("a.csv", "whatever");
    folder.write("mapping.json",
                 R"({ "format": "sivid-mapping-1", "id": "i", "model": "m",
      "parameters": { "k": { "prior": [0, 1] } }, "max_outlier_fraction": 0,
      "scenarios": [ { "name": "A", "file": "a.csv", "source": { "kind": "matlab" },
                       "time": { "sample_time": 0.5 },
                       "channels": { "h": { "column": "y", "error": 0.1 } } } ] })");
    auto const mapping = read_import_mapping(folder.path() / "mapping.json");
    try {
        (void)import_dataset(mapping);
        FAIL("imported without a reader");
    } catch (input_error const& e) {
        CHECK_THAT(e.what(),
                   ContainsSubstring("a.csv: a MATLAB file") && ContainsSubstring("libmatio-dev"));
    }
    import_tools tools;
    tools.read_matlab = [](fs::path const& file) {
        return matlab_file{file.string(),
                           {{"y", "double 1x3", false, 1, 3, std::vector<double>{1, 2, 4}}}};
    };
    auto const r = import_dataset(mapping, tools);
    CHECK(r.data.scenarios.at(0).duration == 1);
    CHECK(r.data.scenarios.at(0).stated.at(2).value == dec("4"));
}

TEST_CASE("columns in memory, by a mapping that is a text") {
    import_tools tools;
    tools.read_matlab = [](fs::path const& file) {
        CHECK(file == "frame");
        return matlab_file{"frame",
                           {{"y (m)", "double 3", false, 3, 1, std::vector<double>{1, 2, 4}},
                            {"(:,1)", "double 3", false, 3, 1, std::vector<double>{0, 1, 2}}}};
    };
    std::string const text = R"json({ "format": "sivid-mapping-1", "id": "a", "model": "m",
      "parameters": { "k": { "prior": [0, 1] } }, "max_outlier_fraction": 0,
      "scenarios": [ { "name": "one", "file": "frame", "source": { "kind": "matlab" },
                       "time": { "column": "(:,1)", "unit": "s", "offset": 0 },
                       "channels": { "h": { "column": "y (m)", "error": 0.1 } } } ] })json";
    auto const r = import_dataset(import_mapping_from_text(text, "Data"), tools);
    CHECK(r.data.scenarios.at(0).stated.at(2).value == dec("4"));
    CHECK_THROWS_WITH(import_mapping_from_text("{}", "Data"), ContainsSubstring("Data: "));
}
