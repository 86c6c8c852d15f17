// SPDX-License-Identifier: MIT
// What it finds false is tested with whole results in identification_check.test.cpp.
#include <sivid/io/paving_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

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

TEST_CASE("a few floats between inside rows are no claim, a gap that is wider is one") {
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
    CHECK(outside(0x1p-52) == outcome::nothing);
    CHECK(outside(0x1p-30) == outcome::refuted);
}
