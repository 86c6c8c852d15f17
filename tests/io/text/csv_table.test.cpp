// SPDX-License-Identifier: MIT
#include <sivid/io/text/csv_table.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;

namespace {

std::vector<std::string> cells_of(csv_table const& table, std::size_t row) {
    auto const& cells = table.rows()[row].cells;
    return {cells.begin(), cells.end()};
}

} // namespace

TEST_CASE("comments, blank lines, CRLF, spaces and a missing last line end are accepted") {
    csv_table const table{
        "a.csv",
        "# made by hand\r\nt, u ,u_err\r\n\r\n0,1,0.1\r\n# between\r\n 1 ,, \t\r\n2,3,0.1"};
    CHECK(table.headings() == std::vector<std::string>{"t", "u", "u_err"});
    CHECK(table.heading_line() == 2);
    REQUIRE(table.rows().size() == 3);
    CHECK(table.rows()[0].line == 4);
    CHECK(table.rows()[1].line == 6);
    CHECK(cells_of(table, 1) == std::vector<std::string>{"1", "", ""});
    CHECK(cells_of(table, 2) == std::vector<std::string>{"2", "3", "0.1"});
    CHECK(table.number(table.rows()[2], 2) == *exact_decimal::parse("0.1"));
    CHECK(table.column("u_err") == 2u);
    CHECK_FALSE(table.column("v"));
}

TEST_CASE("a table may have no rows") { CHECK(csv_table{"a.csv", "t,u"}.rows().empty()); }

TEST_CASE("a byte-order mark is accepted in a file") {
    io_support::temporary_folder const folder;
    folder.write("a.csv", "\xEF\xBB\xBFt,u\n0,1\n");
    CHECK(csv_table::read(folder.path() / "a.csv").headings().front() == "t");
}

TEST_CASE("every defect of a table is one error with line and column") {
    struct defect {
        std::string text;
        std::size_t line, column;
        std::string message;
    };
    for (auto const& d :
         std::vector<defect>{{"", 0, 0, "the file is empty: no heading line"},
                             {"# only a comment\n\n", 0, 0, "no heading line"},
                             {"t,u,u\n", 1, 3, "appears twice"},
                             {"t,,u\n", 1, 2, "without a heading"},
                             {"t,u\n0,1\n1\n", 3, 2, "1 cells in a table of 2 columns"},
                             {"t,u\n0,1,2\n", 2, 3, "3 cells in a table of 2 columns"},
                             {"t,u\n0,\"1\"\n", 2, 2, "quotation mark"}}) {
        CAPTURE(d.text);
        try {
            csv_table const table{"a.csv", d.text};
            FAIL_CHECK("was accepted");
        } catch (input_error const& e) {
            CHECK(e.place().file == "a.csv");
            CHECK(e.place().line == d.line);
            CHECK(e.place().column == d.column);
            CHECK_THAT(e.what(), ContainsSubstring(d.message));
        }
    }
}

TEST_CASE("a heading of many columns takes no longer than its length") {
    std::string text = "t";
    for (int i = 0; i < 100'000; ++i) text += ",c" + std::to_string(i);
    CHECK(csv_table("a.csv", text).headings().size() == 100'001);
    CHECK_THROWS_AS(csv_table("a.csv", text + ",c5"), input_error);
}

TEST_CASE("a cell that is no finite number is an error") {
    for (auto const& cell : {"", "x", "nan", "NaN", "inf", "-inf", "infinity", "0x10", "1;5",
                             "1.5.2", "1e", "1e999", "-1e400", "1e999999999999"}) {
        CAPTURE(cell);
        csv_table const table{"a.csv", "t,u\n0," + std::string{cell} + "\n"};
        try {
            (void)table.number(table.rows()[0], 1);
            FAIL_CHECK("was accepted");
        } catch (input_error const& e) {
            CHECK(e.place().line == 2);
            CHECK(e.place().column == 2);
            CHECK(e.place().heading == "u");
        }
    }
}

TEST_CASE("a column that is missing is named beside those there are") {
    csv_table const table{"a.csv", "# log\nt,u\n0,1\n"};
    CHECK(table.required_column("u") == 1);
    CHECK_THROWS_WITH(table.required_column("y"),
                      ContainsSubstring("a.csv: line 2: no column 'y'; it has: 't', 'u'"));
    csv_table const semicolons{"a.csv", "t;y\n0;1\n"};
    CHECK_THROWS_WITH(semicolons.required_column("y"), ContainsSubstring("separated by commas"));
}

TEST_CASE("a copy keeps its cells when the table it was copied from is gone") {
    auto table = std::make_unique<csv_table>("f", "t,x\n1,2\n");
    auto const copy = *table;
    auto const moved = std::move(*table);
    table.reset();
    for (auto const* of : {&copy, &moved}) {
        CHECK(cells_of(*of, 0) == std::vector<std::string>{"1", "2"});
        CHECK(of->number(of->rows()[0], 1) == *exact_decimal::parse("2"));
    }
}
