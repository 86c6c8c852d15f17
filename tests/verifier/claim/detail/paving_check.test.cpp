// SPDX-License-Identifier: MIT
// What it finds false is tested with whole results in identification_check.test.cpp.
#include <sivid/verifier/claim/detail/paving_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;
using outcome = check_finding::outcome;

TEST_CASE("a paving is verified box by box, a hole in it is not") {
    auto const problem = io_support::one_rate_problem();
    auto const stored = io_support::stored_result(problem).read();
    identification_check_options options;
    options.all = true;
    options.seconds = 60;
    paving_check<interval> check(problem, {"a"}, stored.rows, {}, options);
    CHECK(check.covering("cover").found == outcome::verified);
    CHECK(check.inside("inside").found == outcome::verified);
    CHECK(check.outside("outside").found == outcome::verified);
    auto const holed = std::vector<paved_box>{stored.rows[0]};
    paving_check<interval> other(problem, {"a"}, holed, {}, options);
    CHECK(other.covering("cover").found == outcome::verified); // the hole counts as excluded
    auto const refuted = other.outside("outside");
    CHECK(refuted.found == outcome::refuted);
    CHECK_THAT(refuted.detail, ContainsSubstring("the contrary holds at a="));
}

TEST_CASE("what is not confirmed is counted, and verifies nothing") {
    auto const problem = io_support::one_rate_problem();
    auto const stored = io_support::stored_result(problem).read();
    identification_check_options options;
    options.all = true;
    options.seconds = -1;
    paving_check<interval> check(problem, {"a"}, stored.rows, {}, options);
    auto const inside = static_cast<std::size_t>(
        std::count_if(stored.rows.begin(), stored.rows.end(),
                      [](paved_box const& row) { return row.verdict == box_verdict::inside; }));
    auto const found = check.inside("inside");
    CHECK(found.found == outcome::undecided);
    CHECK_THAT(found.detail, ContainsSubstring(std::to_string(inside) + " not confirmed"));
    options.seconds = 60;
    CHECK_THAT(check.inside("inside").detail, !ContainsSubstring("not confirmed"));
}

TEST_CASE("rows that share a face leave nothing between them, a gap is a claim") {
    auto const problem = io_support::one_rate_problem();
    identification_check_options options;
    options.all = true;
    options.seconds = 60;
    auto const outside = [&](double gap) { // all of it feasible
        std::vector<paved_box> const rows{{box{interval(0.5, 1.0)}, box_verdict::undecided},
                                          {box{interval(1.0 + gap, 2.0)}, box_verdict::undecided}};
        paving_check<interval> check(problem, {"a"}, rows, {}, options);
        CHECK(check.covering("cover").found == outcome::verified);
        return check.outside("outside").found;
    };
    CHECK(outside(0) == outcome::nothing);
    CHECK(outside(0x1p-30) == outcome::refuted);
}

TEST_CASE("a prior that is one float wide in a side excludes nothing by being thin") {
    auto problem = io_support::two_rates_problem();
    problem.prior[1] = interval(0.5, std::nextafter(0.5, 1.0)); // the truth, as a decimal
    identification_check_options options;
    options.all = true;
    options.seconds = 60;
    auto const outside = [&](std::vector<interval> const& left) {
        std::vector<paved_box> rows;
        for (auto const& a : left)
            rows.push_back({box{a, problem.prior[1]}, box_verdict::undecided});
        paving_check<interval> check(problem, {"a", "b"}, rows, {}, options);
        CHECK(check.covering("cover").found == outcome::verified);
        return check.outside("outside").found;
    };
    CHECK(outside({}) == outcome::refuted);
    CHECK(outside({interval(1.5, 2.0)}) == outcome::refuted);
    CHECK(outside({interval(0.5, 0.75), interval(0.75, 2.0)}) == outcome::nothing);
    std::vector<interval> many; // more than are subtracted one by one
    for (double a = 0.5; a < 2; a += 0.125) many.push_back(interval(a, a + 0.125));
    CHECK(outside(many) == outcome::nothing);
    many.erase(many.begin() + 4); // where the truth begins
    CHECK(outside(many) == outcome::refuted);
}

TEST_CASE("what was not examined is not verified, and an inside row beside the prior is refuted") {
    auto const problem = io_support::one_rate_problem();
    auto stored = io_support::stored_result(problem).read();
    identification_check_options options;
    options.sample = 0;
    options.seconds = 60;
    paving_check<interval> check(problem, {"a"}, stored.rows, {}, options);
    CHECK(check.covering("cover").found == outcome::verified);
    CHECK(check.inside("inside").found == outcome::undecided);
    CHECK(check.outside("outside").found == outcome::undecided);
    CHECK_THAT(check.outside("outside").detail, ContainsSubstring("none of"));
    stored.rows.push_back({box{interval(2 + 0x1p-51, 2 + 0x1p-50)}, box_verdict::inside});
    for (bool const all : {false, true}) {
        options.all = all;
        options.sample = 1;
        paving_check<interval> other(problem, {"a"}, stored.rows, {}, options);
        CHECK(other.inside("inside").found == outcome::refuted);
    }
}
