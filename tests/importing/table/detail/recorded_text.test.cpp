// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/recorded_text.hpp>

#include "io/import_support.hpp"

using namespace sivid;
using io_support::dec;
using cells = std::vector<std::string>;

TEST_CASE("lines keep their numbers, and whether they are ended") {
    auto const lines = lines_of("a\r\n\nb\rc\nlast");
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].text == "a");
    CHECK(lines[1].text.empty());
    CHECK(lines[2].text == "b\rc");
    CHECK(lines[2].ended);
    CHECK(lines[3].text == "last");
    CHECK(lines[3].number == 4);
    CHECK_FALSE(lines[3].ended);
    CHECK(lines_of("").empty());
    CHECK(lines_of("\n").size() == 1);
}

TEST_CASE("lines are split at any separator") {
    CHECK(split_cells("a, b ,,c", ',') == cells{"a", "b", "", "c"});
    CHECK(split_cells("1,5;2", ';') == cells{"1,5", "2"});
    CHECK(split_cells("a\t\tb\t", '\t') == cells{"a", "", "b", ""});
    CHECK(split_cells("  1.5   2 \t 3 ", ' ') == cells{"1.5", "2", "3"});
    CHECK(split_cells("", ',') == cells{""});
    CHECK(split_cells("", ' ') == cells{});
}

TEST_CASE("quoted cells") {
    CHECK(split_cells(R"("a, b","say ""x""" ,c)", ',') == cells{"a, b", "say \"x\"", "c"});
    CHECK(split_cells(R"(x,"")", ',') == cells{"x", ""});
    CHECK_FALSE(split_cells(R"("a)", ','));
    CHECK_FALSE(split_cells(R"("a"b,c)", ','));
    CHECK_FALSE(split_cells(R"(a"b,c)", ','));
    CHECK_FALSE(split_cells(R"(")", ','));
}

TEST_CASE("readings") {
    CHECK(parse_reading("1.5", '.') == dec("1.5"));
    CHECK(parse_reading("-1,5e-3", ',') == dec("-0.0015"));
    CHECK_FALSE(parse_reading("1.5", ','));
    CHECK_FALSE(parse_reading("1,5", '.'));
    CHECK_FALSE(parse_reading("1,000,5", ','));
    for (auto const* bad :
         {"", "nan", "inf", "1e999", "0x10", "1 2", "--1", "1e99999999999999999999"})
        CHECK_FALSE(parse_reading(bad, '.'));
    CHECK(parse_reading(std::string(400, '0'), '.'));
    CHECK_FALSE(parse_reading(std::string(401, '0'), '.'));
    CHECK_FALSE(parse_reading(std::string(400, '9'), '.'));
}
