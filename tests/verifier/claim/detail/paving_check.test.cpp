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

TEST_CASE("slivers that are much together are claims") {
    box const whole{interval(1.0, 1.0 + 0x1p-30)};
    std::vector<box> few, many;
    for (int k = 0; k < 1000; ++k) {
        double const at = 1.0 + k * 0x1p-50;
        (k == 0 ? few : many).push_back({interval(at, at + 0x1p-50)});
    }
    io_detail::drop_slivers(few, whole);
    CHECK(few.empty());
    io_detail::drop_slivers(many, whole);
    CHECK(many.size() == 999);
    std::vector<box> all{box{interval(1.0, 1.0 + 0x1p-51)}};
    io_detail::drop_slivers(all, box{interval(1.0, 1.0 + 0x1p-51)});
    CHECK(all.size() == 1);
}

TEST_CASE(
    "boxes proved but for their rims are counted apart, and nothing is said of thinner ones") {
    auto const problem = io_support::one_rate_problem();
    // x = 2 exp(-a t / 2) is too high for smaller rates than this.
    double least = 0;
    for (auto const& m : problem.experiments[0].measurements) {
        least = std::max(least, -2 / m.time * std::log(m.bound.upper() / 2));
    }
    identification_check_options options;
    options.all = true;
    options.seconds = 60;
    double const rim = options.rim * width(problem.prior[0]);
    auto const outside = [&](double from, double to) { // is said to be infeasible
        std::vector<paved_box> rows{{box{interval(to, 2.0)}, box_verdict::undecided}};
        if (from > 0.5) rows.push_back({box{interval(0.5, from)}, box_verdict::undecided});
        paving_check<interval> check(problem, {"a"}, rows, {}, options);
        CHECK(check.covering("cover").found == outcome::verified);
        return check.outside("outside");
    };
    auto const whole = outside(0.5, least - 3 * rim);
    CHECK(whole.found == outcome::verified);
    CHECK_THAT(whole.detail, StartsWith("1 of 1 proved, "));
    CHECK_THAT(whole.detail, !ContainsSubstring("rim"));
    // It ends at the feasible ones, as contraction leaves it.
    auto const close = outside(0.5, least);
    CHECK(close.found == outcome::sampled); // the rim is not proved
    CHECK_THAT(close.detail, StartsWith("0 of 1 proved, 1 more but for a rim of 1e-06"));
    auto const thin = outside(least - 0.1 * rim, least);
    CHECK(thin.found == outcome::sampled);
    CHECK_THAT(thin.detail, ContainsSubstring("1 thinner than 1e-06 of the prior not examined"));
    // More than a rim of what is said to be excluded is feasible.
    auto const altered = outside(0.5, least + 3 * rim);
    CHECK(altered.found != outcome::verified);
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
