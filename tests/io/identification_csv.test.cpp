// SPDX-License-Identifier: MIT
#include <sivid/io/identification_csv.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <sstream>

using namespace sivid;
using io_support::two_rates_problem;
using io_support::two_rates_result;

namespace {

std::vector<std::vector<std::string>> rows_of(std::string const& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        auto& row = rows.emplace_back(1);
        for (char const c : line) {
            if (c == ',') {
                row.emplace_back();
            } else {
                row.back() += c;
            }
        }
    }
    return rows;
}

} // namespace

TEST_CASE("every box but the outside ones is a row, inside rows are rounded inward") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const rows = rows_of(boxes_csv(problem, found));
    CHECK(rows[0] ==
          std::vector<std::string>{"verdict", "a_lower", "a_upper", "b_lower", "b_upper"});
    std::size_t k = 1;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict == box_verdict::outside) continue;
        REQUIRE(k < rows.size());
        REQUIRE(rows[k].size() == 5);
        CHECK(rows[k][0] == to_string(b.verdict));
        for (std::size_t j = 0; j < 2; ++j) {
            auto const low = parse_decimal(rows[k][1 + 2 * j]).value();
            auto const high = parse_decimal(rows[k][2 + 2 * j]).value();
            if (b.verdict == box_verdict::inside) {
                CHECK(b.set[j].lower() <= low.upper());
                CHECK(high.lower() <= b.set[j].upper());
            } else {
                CHECK(low.lower() <= b.set[j].lower());
                CHECK(b.set[j].upper() <= high.upper());
            }
        }
        ++k;
    }
    CHECK(k == rows.size());
    CHECK(found.paving.count(box_verdict::inside) > 0);
}

TEST_CASE("an inside side of no width is printed exactly") {
    auto const [low, high] = io_detail::side_text(interval(0.1), true);
    CHECK(low == high);
    CHECK(low == "0.1000000000000000055511151231257827021181583404541015625");
    auto const [a, b] = io_detail::side_text(interval(0.1, 0.3), true);
    CHECK(*exact_decimal::parse("0.1") < *exact_decimal::parse(a));
    CHECK(*exact_decimal::parse(b) < *exact_decimal::parse("0.3"));
}

TEST_CASE("outputs are listed with bounds, enclosure and outliers") {
    auto const problem = two_rates_problem(true);
    auto const found = two_rates_result(problem);
    auto const motion = find_explaining_motion(problem, found, 20);
    REQUIRE(motion);
    auto const rows = rows_of(outputs_csv(problem, found, &*motion));
    REQUIRE(rows.size() == 7);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        REQUIRE(rows[i].size() == 9);
        CHECK(rows[i][0] == "run");
        CHECK(rows[i][2] == "x");
        CHECK(rows[i][3] == "m");
        CHECK(rows[i][8] == (i == 3 ? "forced_outlier" : ""));
        if (i == 3) continue;
        CHECK(std::stod(rows[i][4]) <= std::stod(rows[i][6]));
        CHECK(std::stod(rows[i][6]) <= std::stod(rows[i][7]));
        CHECK(std::stod(rows[i][7]) <= std::stod(rows[i][5]));
    }
    auto const bare = rows_of(outputs_csv(problem, found, nullptr));
    CHECK(bare[1][6].empty());
    CHECK(bare[1][7].empty());
}

TEST_CASE("a scenario's name cannot break a row") {
    CHECK(io_detail::cell("plain") == "plain");
    CHECK(io_detail::cell("a,b") == "\"a,b\"");
    CHECK(io_detail::cell("a\"b") == "\"a\"\"b\"");
}
