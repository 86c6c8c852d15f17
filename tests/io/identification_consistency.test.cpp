// SPDX-License-Identifier: MIT
#include <sivid/io/identification_consistency.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

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

std::size_t first(stored_identification const& stored, box_verdict v) {
    std::size_t k = 0;
    while (stored.rows[k].verdict != v) ++k;
    return k;
}
box_cover covered(identification_problem const& problem, stored_identification const& stored) {
    std::vector<box> rows;
    for (auto const& row : stored.rows) rows.push_back(row.set);
    return cover(problem.prior, rows);
}

} // namespace

TEST_CASE("a result agrees with itself; each tampering is seen by the check it concerns") {
    auto const problem = io_support::two_rates_problem();
    auto const good = io_support::stored_result(problem).read();
    CHECK_NOTHROW(require_same_problem(problem, good, "result.json"));
    CHECK(check_hull(problem, good).found == outcome::verified);
    CHECK(check_volumes(problem, good).found != outcome::refuted);
    CHECK(check_verdict(good).found == outcome::verified);
    CHECK(check_combinations<exact>(problem, good).found != outcome::refuted);
    CHECK(check_cover(problem, good, covered(problem, good)).found == outcome::verified);

    SECTION("another problem") {
        auto bad = good;
        bad.parameters[0].name = "c";
        CHECK_THROWS_AS(require_same_problem(problem, bad, "result.json"), input_error);
        bad = good;
        bad.budget.clear();
        CHECK_THROWS_AS(require_same_problem(problem, bad, "result.json"), input_error);
    }
    SECTION("hull narrowed or widened") {
        auto bad = good;
        auto& range = bad.parameters[1].range;
        range = interval(range.lower() + 1e-9, range.upper());
        CHECK(check_hull(problem, bad).found == outcome::refuted);
        bad = good;
        bad.parameters[0].range = interval(0.4, 2.0);
        CHECK(check_hull(problem, bad).found == outcome::refuted);
    }
    SECTION("a box moved out of the prior") {
        auto bad = good;
        bad.rows[0].set[0] = interval(2.5, 2.6);
        CHECK(check_hull(problem, bad).found == outcome::refuted);
    }
    SECTION("a box removed") {
        auto bad = good;
        bad.rows.erase(bad.rows.begin() + 3);
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
        bad.stated_rows.clear();
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
    }
    SECTION("a box relabelled") {
        auto bad = good;
        auto const other = std::find_if(bad.rows.begin(), bad.rows.end(), [](auto const& row) {
            return row.verdict != box_verdict::inside;
        });
        REQUIRE(other != bad.rows.end());
        other->verdict = box_verdict::inside;
        CHECK(check_volumes(problem, bad).found == outcome::refuted);
    }
    SECTION("a box doubled") {
        auto bad = good;
        bad.rows.push_back(bad.rows[first(bad, box_verdict::inside)]);
        CHECK(check_cover(problem, bad, covered(problem, bad)).found == outcome::refuted);
    }
    SECTION("verdict flipped") {
        auto bad = good;
        bad.verdict = verdict::inconsistent;
        CHECK(check_verdict(bad).found == outcome::refuted);
        bad.verdict = verdict::undecided;
        CHECK(check_verdict(bad).found == outcome::refuted);
    }
    SECTION("a combination narrowed or of nothing") {
        auto bad = good;
        auto& c = bad.combinations[0];
        auto const whole = c.range;
        c.range = interval(whole.lower(), whole.lower() + 1e-9); // the witness is elsewhere
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
        c.range = interval(whole.lower(), whole.upper() + 0.5);
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
        c.name = "a*c";
        CHECK(check_combinations<exact>(problem, bad).found == outcome::refuted);
    }
}

TEST_CASE("an empty result is consistent with the verdict inconsistent only") {
    auto const problem = io_support::impossible_problem();
    auto stored = io_support::stored_result(problem).read();
    CHECK(check_verdict(stored).found == outcome::verified);
    CHECK(check_hull(problem, stored).found == outcome::verified);
    CHECK(check_volumes(problem, stored).found == outcome::verified);
    CHECK(check_combinations<exact>(problem, stored).found == outcome::nothing);
    auto const whole = covered(problem, stored);
    CHECK(whole.gaps.size() == 1);
    CHECK(check_cover(problem, stored, whole).found == outcome::verified);
    stored.verdict = verdict::undecided;
    CHECK(check_verdict(stored).found == outcome::refuted);
    CHECK(to_string(outcome::refuted) == "REFUTED");
}
