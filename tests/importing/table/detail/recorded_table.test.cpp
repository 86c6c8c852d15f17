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
    CHECK(noted(protocol, "blank or comment") == std::vector<std::size_t>{4, 5});
}

TEST_CASE("tabs and blanks") {
    import_protocol protocol;
    auto const tabs = replaced(csv_mapping, R"("csv" })", R"("csv", "separator": "\t" })");
    CHECK(read(tabs, "time\tpump\tlevel\n0\t1\t\n1\t2\t3\n", protocol).rows.size() == 2);
    auto const blanks = replaced(csv_mapping, R"("csv" })", R"("csv", "separator": " " })");
    CHECK(read(blanks, "time pump   level\n  0  1 2\n  1\t2 3\n", protocol).rows.size() == 2);
}

namespace {

/// The small mapping of a table without times, whose columns may be named by their numbers.
std::string sampled(std::string const& form, bool by_number = false) {
    auto text = replaced(csv_mapping, R"({ "kind": "csv" })", form);
    text = replaced(text, R"({ "column": "time", "unit": "ms", "offset": 0 })",
                    R"({ "sample_time": 1 })");
    if (!by_number) return text;
    return replaced(replaced(text, "\"pump\"", "1"), "\"level\"", "2");
}
std::string const one_column = replaced(sampled("{}"), R"("u": { "column": "pump" })", "");

} // namespace

TEST_CASE("a row of blanks keeps its place") {
    auto const tabs = sampled(R"({ "separator": "\t" })");
    for (auto const& [mapping, text] :
         {std::pair{tabs, "pump\tlevel\n1\t10\n2\t11\n\t\n4\t13\n"},
          {sampled(R"({ "separator": ";" })"), "pump;level\n1;10\n2;11\n;\n4;13\n"},
          {one_column, "level\n10\n11\n\n13\n"},
          {replaced(one_column, "{}", R"({ "separator": " " })"), "level\n10\n11\n  \n13\n"}}) {
        CAPTURE(text);
        import_protocol protocol;
        auto const table = read(mapping, text, protocol);
        REQUIRE(table.rows.size() == 4);
        CHECK_FALSE(table.rows[2].cells.back());
        CHECK(table.rows[3].time == dec("3"));
        CHECK(*table.rows[3].cells.back() == dec("13"));
        CHECK(protocol.notes().empty());
    }
    CHECK_THAT(refused(tabs, "pump\tlevel\n1\t10\n\t\t\n"),
               ContainsSubstring("3 cells in a table of 2"));
    auto const timed = replaced(csv_mapping, R"("csv" })", R"("csv", "separator": "\t" })");
    CHECK_THAT(refused(timed, "time\tpump\tlevel\n0\t1\t2\n\t\t\n"),
               ContainsSubstring("line 3, column 1 (time): the time is missing"));
}

TEST_CASE(
    "lines that are no rows are noted, and refused between rows that only their number times") {
    auto const mapping = sampled("{}");
    for (std::string const line : {"", "  ", "# 2,11", "#N/A,11"}) {
        CAPTURE(line);
        CHECK_THAT(refused(mapping, "pump,level\n1,10\n" + line + "\n3,12\n"),
                   ContainsSubstring("a.csv: line 3: a blank line or a comment above a row"));
        import_protocol protocol;
        auto const text = "# of today\n\npump,level\n1,10\n2,11\n" + line + "\n";
        CHECK(read(mapping, text, protocol).rows.size() == 2);
        CHECK(noted(protocol, "blank or comment") == std::vector<std::size_t>{1, 2, 6});
        auto const timed =
            read(csv_mapping, "time,pump,level\n0,1,2\n" + line + "\n1,1,2\n", protocol);
        CHECK(timed.rows.size() == 2);
    }
    // What says that there is no reading makes no comment of a row.
    import_protocol protocol;
    auto const table =
        read(sampled(R"({ "missing": ["#N/A"] })"), "pump,level\n1,10\n#N/A,11\n3,12\n", protocol);
    CHECK(table.rows.size() == 3);
}

TEST_CASE("a first row of numbers is no heading unless the mapping says so") {
    std::string const text = "1,10\n2,11\n3,12\n";
    auto const doubt =
        "line 1: the line of the headings may be a row: its mapped cells are numbers; "
        "state \"heading\"";
    CHECK_THAT(refused(sampled("{}", true), text), ContainsSubstring(doubt));
    CHECK_THAT(refused(sampled("{}", true), "1,\n2,11\n"), ContainsSubstring(doubt));
    CHECK_THAT(refused(replaced(sampled("{}", true), R"("sample_time": 1)",
                                R"("column": 1, "unit": "s", "offset": "first")"),
                       text),
               ContainsSubstring(doubt));
    import_protocol protocol;
    auto const none = sampled(R"({ "heading": false })", true);
    auto const rows = read(none, "# pump,level\n" + text, protocol).rows;
    REQUIRE(rows.size() == 3);
    CHECK(*rows[0].cells[1] == dec("10"));
    CHECK(noted(protocol, "blank or comment") == std::vector<std::size_t>{1});
    CHECK_THAT(refused(none, "\n" + text), ContainsSubstring("line 1: a blank line"));
    CHECK_THAT(refused(sampled(R"({ "heading": false })"), text),
               ContainsSubstring("has no column 'pump'; it has: '1', '2'"));
    // Numbers may head columns where the mapping says so, by their names too.
    CHECK(read(sampled(R"({ "heading": true })", true), text, protocol).rows.size() == 2);
    auto const named =
        replaced(replaced(sampled("{}"), "\"pump\"", "\"1\""), "\"level\"", "\"10\"");
    CHECK(read(named, text, protocol).rows.size() == 2);
    CHECK(read(sampled("{}", true), "pump,level\n" + text, protocol).rows.size() == 3);
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
    has("time,pump,level\n0,1,2\n1,1,2\n1,1,3\n",
        "line 4, column 1 (time): the time '0.001' s is that of line 3, with other readings");
    has("time,pump,level\n5,1,2\n3,1,2\n", "line 3, column 1 (time)");
    has("time,pump,level\n0,\"1,2\n", "a quotation mark out of place");
    CHECK_THAT(refused(replaced(csv_mapping, "\"pump\"", "7"), small_table),
               ContainsSubstring("has 4 columns, not 7"));
    auto const minutes = replaced(csv_mapping, "\"ms\"", "\"min\"");
    CHECK_THAT(refused(minutes, "time,pump,level\n1e308,1,2\n"),
               ContainsSubstring("beyond the range of double"));
}
