// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/recorded_table.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using namespace io_support;

namespace {

scenario_mapping mapped(std::string_view mapping) {
    temporary_folder const folder;
    folder.write("mapping.json", mapping);
    return read_import_mapping(folder.path() / "mapping.json").scenarios.at(0);
}
recorded_table read(std::string_view mapping, std::string_view text, import_protocol& protocol) {
    return read_recorded_table(mapped(mapping), text, protocol);
}
std::string refused(std::string_view mapping, std::string_view text) {
    import_protocol protocol;
    try {
        (void)read(mapping, text, protocol);
    } catch (input_error const& e) {
        CHECK_FALSE(e.remedy().empty());
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a table gives the columns that are mapped") {
    import_protocol protocol;
    auto const with_bound = replaced(csv_mapping, "\"error\": 0.02", "\"error\": {\"column\": 4}");
    auto const table = read(with_bound, small_table, protocol);
    CHECK(columns_of(mapped(with_bound)).size() == 3);
    REQUIRE(table.rows.size() == 4);
    CHECK(table.first_line == 2);
    CHECK(table.last_line == 5);
    CHECK(table.rows[1].line == 3);
    CHECK(table.rows[1].time == dec("0.1"));
    CHECK(*table.rows[1].cells.at(0) == dec("1.5"));
    CHECK(*table.rows[1].cells.at(1) == dec("101"));
    CHECK(*table.rows[1].cells.at(2) == dec("2"));
    CHECK_FALSE(table.rows[2].cells.at(1));
    CHECK(protocol.notes().empty());
}

TEST_CASE("any separator, decimal comma, preamble, units line, quotes, text in other columns") {
    import_protocol protocol;
    auto const mapping = replaced(
        csv_mapping, R"({ "kind": "csv" })",
        R"({ "kind": "csv", "separator": ";", "decimal": ",", "missing": ["---"], "skip_lines": 1, "skip_after_heading": 1 })");
    auto const table =
        read(mapping,
             "Logger; 4\r\n\"time\";level;pump;note\r\n[ms];[cm];[V];\r\n"
             "# comment\r\n\r\n0;1,5;2,25;\"started; at noon\"\r\n0,5;---;1e-1;ok\r\n",
             protocol);
    REQUIRE(table.rows.size() == 2);
    CHECK(*table.rows[0].cells[0] == dec("2.25"));
    CHECK(*table.rows[0].cells[1] == dec("1.5"));
    CHECK(table.rows[1].time == dec("0.0005"));
    CHECK_FALSE(table.rows[1].cells[1]);
    CHECK(noted(protocol, "skipped") == std::vector<std::size_t>{1, 3});
}

TEST_CASE("tabs and blanks") {
    import_protocol protocol;
    auto const tabs = replaced(csv_mapping, R"("csv" })", R"("csv", "separator": "\t" })");
    CHECK(read(tabs, "time\tpump\tlevel\n0\t1\t\n1\t2\t3\n", protocol).rows.size() == 2);
    auto const blanks = replaced(csv_mapping, R"("csv" })", R"("csv", "separator": " " })");
    CHECK(read(blanks, "time pump   level\n  0  1 2\n  1\t2 3\n", protocol).rows.size() == 2);
}

TEST_CASE("a defect in a table is named with file, line, column and remedy") {
    auto const has = [](std::string_view text, std::string const& message) {
        CAPTURE(text);
        CHECK_THAT(refused(csv_mapping, text), ContainsSubstring(message));
    };
    has("", "no heading line");
    has("time,level\n", "/scenarios/0/inputs/u/column: ");
    has("time,level\n", "has no column 'pump'; it has: 'time', 'level'");
    has("time,pump,level,pump\n", "two columns 'pump'");
    has("time,pump,level\n0,1\n", "a.csv: line 2: 2 cells in a table of 3 columns");
    has("time,pump,level\n0,x,2\n", "a.csv: line 2, column 2 (pump): 'x' is not a finite number");
    has("time,pump,level\n0,1.5,nan\n", "line 2, column 3 (level): 'nan' is not a finite number");
    has("time,pump,level\n0,1e999,2\n", "'1e999' is not a finite number");
    has("time,pump,level\n,1,2\n", "line 2, column 1 (time): the time is missing");
    has("time,pump,level\n0,1,2\n1,1,2\n1,1,2\n",
        "line 4, column 1 (time): the time '1' does not come");
    has("time,pump,level\n5,1,2\n3,1,2\n", "line 3, column 1 (time)");
    has("time,pump,level\n0,\"1,2\n", "a quotation mark out of place");
    CHECK_THAT(refused(replaced(csv_mapping, "\"pump\"", "7"), small_table),
               ContainsSubstring("has 4 columns, not 7"));
    auto const minutes = replaced(csv_mapping, "\"ms\"", "\"min\"");
    CHECK_THAT(refused(minutes, "time,pump,level\n1e308,1,2\n"),
               ContainsSubstring("beyond the range of double"));
}
