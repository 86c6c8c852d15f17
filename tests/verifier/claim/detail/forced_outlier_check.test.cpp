// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/identification_check_work.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

/// By what is violated over this box.
outcome check(identification_problem const& problem, stored_identification const& stored,
              box const& left, std::vector<bool> const& violated = {},
              std::size_t* marked = nullptr) {
    feasibility_test test(problem, {});
    verified_witness witness;
    witness.violated = {violated};
    std::vector<forced_outlier> found;
    auto const says =
        io_detail::check_forced(problem, stored, paving_detail::find_forced(test, problem, left),
                                violated.empty() ? nullptr : &witness, found);
    if (marked != nullptr) *marked = found.size();
    return says.found;
}

} // namespace

TEST_CASE("forced outliers are proved over all that is left, or not believed") {
    auto const problem = plain_problem::make(1, 1);
    box const left{interval(0.45, 0.55)};
    auto const n = problem.experiments[0].measurements.size();
    stored_identification stored;
    CHECK(check(problem, stored, left) == outcome::nothing);
    stored.forced = {{"run", 0.5, "x"}};
    std::size_t marked = 0;
    CHECK(check(problem, stored, left, {}, &marked) == outcome::verified);
    CHECK(marked == 1);
    CHECK(check(problem, stored, left, std::vector<bool>(n, false)) == outcome::refuted);
    stored.forced.push_back({"run", 1.0, "x"}); // which some meet
    CHECK(check(problem, stored, left) == outcome::undecided);
    for (auto const& bad : {stored_identification::outlier{"run", 0.7, "x"},
                            stored_identification::outlier{"run", 0.5, "y"},
                            stored_identification::outlier{"walk", 0.5, "x"}}) {
        stored.forced = {bad};
        CHECK(check(problem, stored, left) == outcome::refuted);
    }
}

TEST_CASE("of two readings of one instant the one that is violated is the outlier") {
    auto problem = plain_problem::make(1, 1);
    auto& readings = problem.experiments[0].measurements;
    readings.push_back({1.0, 0, interval(5.0, 6.0)}); // beside one that all meet
    stored_identification stored;
    box left{interval(0.48, 0.52)};
    auto const n = readings.size();
    auto const found = [&](std::vector<std::size_t> const& missed = {}) {
        std::vector<bool> violated(missed.empty() ? 0 : n, false);
        for (auto const k : missed) violated[k] = true;
        return check(problem, stored, left, violated);
    };
    stored.forced = {{"run", 1.0, "x"}};
    CHECK(found() == outcome::verified);
    CHECK(found({0, 2}) == outcome::verified);
    CHECK(found({0}) == outcome::refuted);                  // the witness meets both
    stored.forced = {{"run", 1.0, "x"}, {"run", 1.0, "x"}}; // both are said to be
    CHECK(found() == outcome::undecided);
    CHECK(found({0, 2}) == outcome::refuted);
    readings[1].bound = interval(4.0, 4.5);
    CHECK(found() == outcome::verified);
    stored.forced.push_back(stored.forced[0]); // three of two
    CHECK(found() == outcome::refuted);
    // One parameter violates the one, another the other: neither is forced.
    left = box{interval(0.4, 0.6)};
    double const middle = 2 * std::exp(-0.5);
    readings[1].bound = interval(middle + 0.001, 3.0);
    readings.back().bound = interval(0.0, middle - 0.001);
    stored.forced = {{"run", 1.0, "x"}};
    CHECK(found() == outcome::undecided);
}
