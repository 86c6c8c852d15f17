// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stored_claims.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <cmath>

#ifdef SIVID_HAS_MPFI
#include <sivid/number/mp_interval.hpp>
#endif

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

#ifdef SIVID_HAS_MPFI
using exact = mp_interval;
#else
using exact = interval;
#endif

box_cover covered(identification_problem const& problem, stored_identification const& stored) {
    std::vector<box> rows;
    for (auto const& row : stored.rows) rows.push_back(row.set);
    return cover(problem.prior, rows);
}

} // namespace

TEST_CASE("a result agrees with itself, and each tampering is seen by the check it concerns") {
    auto const problem = io_support::one_rate_problem();
    auto good = io_support::stored_result(problem).read();
    good.combinations = {{"a", good.parameters[0].range, "1/s"}};
    CHECK(check_hull(problem, good).found == outcome::verified);
    CHECK(check_volumes(problem, good).found == outcome::verified);
    CHECK(check_verdict(good).found == outcome::verified);
    CHECK(check_combinations<exact>(problem, good).found == outcome::verified);
    CHECK(check_cover("cover", problem, good.rows, covered(problem, good)).found ==
          outcome::verified);

    SECTION("hull narrowed or widened") {
        auto bad = good;
        auto& range = bad.parameters[0].range;
        range = interval(range.lower() + 1e-9, range.upper());
        CHECK(check_hull(problem, bad).found == outcome::refuted);
        bad = good;
        bad.parameters[0].range = interval(0.4, 2.0);
        CHECK(check_hull(problem, bad).found == outcome::refuted);
    }
    SECTION("a bound at one end only, which excludes what the boxes leave") {
        auto bad = good;
        bad.parameters[0].range = interval_traits<interval>::bounds(1.9, HUGE_VAL);
        CHECK(check_hull(problem, bad).found == outcome::refuted);
        bad.combinations[0].range = bad.parameters[0].range;
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
    }
    SECTION("a box moved out of the prior, or next to it") {
        auto bad = good;
        for (double const off : {0.5, 0x1p-51}) {
            auto const beside = interval(2 + off, 2 + 1.5 * off);
            bad.rows = {{box{beside}, box_verdict::inside}};
            bad.parameters[0].range = beside;
            CHECK(check_hull(problem, bad).found == outcome::refuted);
            bad.stated_rows.clear();
            CHECK(check_rows(problem, bad).found == outcome::refuted);
        }
    }
    SECTION("a box removed") {
        auto bad = good;
        bad.rows.erase(bad.rows.begin() + static_cast<std::ptrdiff_t>(io_support::first_row(
                                              bad.rows, box_verdict::inside)));
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
        bad.stated_rows.clear();
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
    }
    SECTION("something inside where no box is") {
        auto bad = good;
        for (auto& row : bad.rows) row.verdict = box_verdict::pending;
        bad.stated_rows.clear();
        for (double const much : {0.1, 1e-10, 1e-14, 1e-300}) {
            bad.inner = interval(much);
            CHECK(check_volumes(problem, bad).found == outcome::refuted);
        }
        bad.inner = interval(0.0);
        CHECK(check_volumes(problem, bad).found == outcome::verified);
    }
    SECTION("a box relabelled") {
        auto bad = good;
        bad.rows[io_support::first_row(bad.rows, box_verdict::inside)].verdict =
            box_verdict::undecided;
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
    }
    SECTION("a box doubled") {
        auto bad = good;
        bad.rows.push_back(bad.rows[io_support::first_row(bad.rows, box_verdict::inside)]);
        CHECK(check_cover("cover", problem, bad.rows, covered(problem, bad)).found ==
              outcome::refuted);
    }
    SECTION("verdict flipped") {
        auto bad = good;
        bad.verdict = verdict::inconsistent;
        CHECK(check_verdict(bad).found == outcome::refuted);
        bad.verdict = verdict::undecided;
        CHECK(check_verdict(bad).found == outcome::refuted);
    }
    SECTION("a problem that is not stated") {
        auto bad = good;
        CHECK(check_problem(problem, bad).found == outcome::verified);
        bad.problem.clear();
        CHECK(check_problem(problem, bad).found == outcome::undecided);
        bad.problem = "another";
        CHECK(check_problem(problem, bad).found == outcome::refuted);
    }
    SECTION("a combination narrowed or of nothing") {
        auto bad = good;
        auto& c = bad.combinations[0];
        auto const whole = c.range;
        c.range = interval(whole.lower(), whole.upper() - 1e-9);
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
        c.range = interval(whole.lower(), whole.upper() + 0.5);
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
        c.name = "a*c";
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
    }
}

TEST_CASE("rows are counted and lie in the prior") {
    auto const problem = io_support::two_rates_problem();
    auto const good = io_support::stored_result(problem).read();
    REQUIRE(good.products);
    CHECK(check_rows(problem, good).found == outcome::verified);
    auto bad = good;
    bad.rows.pop_back();
    CHECK(check_rows(problem, bad).found == outcome::refuted);
    bad = good;
    bad.rows[0].set[1] = interval(0.9, 1.1);
    CHECK(check_rows(problem, bad).found == outcome::refuted);
}

TEST_CASE("an empty result is consistent with the verdict inconsistent only") {
    auto const problem = io_support::one_rate(io_support::impossible_problem());
    auto stored = io_support::stored_result(problem).read();
    CHECK(check_verdict(stored).found == outcome::verified);
    CHECK(check_hull(problem, stored).found == outcome::verified);
    CHECK(check_volumes(problem, stored).found == outcome::verified);
    CHECK(check_combinations<exact>(problem, stored).found == outcome::nothing);
    auto const whole = covered(problem, stored);
    CHECK(whole.gaps.size() == 1);
    CHECK(check_cover("cover", problem, stored.rows, whole).found == outcome::verified);
    stored.verdict = verdict::undecided;
    CHECK(check_verdict(stored).found == outcome::refuted);
    CHECK(to_string(outcome::refuted) == "REFUTED");
}

TEST_CASE("a combination without a bound is stated as one") {
    auto const problem = io_support::two_rates_problem();
    stored_identification stored;
    stored.rows = {{box{interval(1.0, 2.0), interval(-1.0, 1.0)}, box_verdict::undecided}};
    stored.combinations = {{"a/b", interval_traits<interval>::entire()}};
    CHECK(check_combinations<exact>(problem, stored).found == outcome::verified);
    for (auto const& bad : {interval(3.0, 4.0), interval_traits<interval>::bounds(3, HUGE_VAL)}) {
        stored.combinations[0].range = bad;
        CHECK(check_combinations<exact>(problem, stored).found == outcome::refuted);
    }
}
