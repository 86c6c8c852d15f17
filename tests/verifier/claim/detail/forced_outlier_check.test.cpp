// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/witness_checks.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

outcome check(stored_identification const& stored, std::vector<std::vector<bool>> const& hits = {},
              double seconds = 10) {
    return check_forced<interval>(plain_problem::make(1, 1), stored, hits, {}, seconds).found;
}

} // namespace

TEST_CASE("forced outliers are proved over all boxes, or not believed") {
    stored_identification stored;
    stored.rows = {{box{interval(0.45, 0.5)}, box_verdict::inside},
                   {box{interval(0.5, 0.55)}, box_verdict::undecided}};
    CHECK(check(stored) == outcome::nothing);
    stored.forced = {{"run", 0.5, "x"}};
    CHECK(check(stored) == outcome::verified);
    CHECK(check(stored, {{true}}) == outcome::refuted);
    stored.forced.push_back({"run", 1.0, "x"}); // which the boxes meet
    CHECK(check(stored, {}, 0.2) == outcome::undecided);
    for (auto const& bad : {stored_identification::outlier{"run", 0.7, "x"},
                            stored_identification::outlier{"run", 0.5, "y"},
                            stored_identification::outlier{"walk", 0.5, "x"}}) {
        stored.forced = {bad};
        CHECK(check(stored) == outcome::refuted);
    }
}

TEST_CASE("of two readings of one instant the one that is violated is the outlier") {
    auto problem = plain_problem::make(1, 1);
    auto& readings = problem.experiments[0].measurements;
    readings.push_back({1.0, 0, interval(5.0, 6.0)}); // beside one that all meet
    stored_identification stored;
    stored.rows = {{box{interval(0.48, 0.52)}, box_verdict::undecided}};
    auto const found = [&](std::vector<std::vector<bool>> const& hits = {}) {
        return check_forced<interval>(problem, stored, hits, {}, 10).found;
    };
    stored.forced = {{"run", 1.0, "x"}};
    CHECK(found() == outcome::verified);
    CHECK(found({{false, true, false}}) == outcome::verified);
    CHECK(found({{false, true, true}}) == outcome::refuted);
    stored.forced = {{"run", 1.0, "x"}, {"run", 1.0, "x"}}; // both are said to be
    CHECK(found() == outcome::undecided);
    CHECK(found({{false, true, false}}) == outcome::refuted);
    readings[1].bound = interval(4.0, 4.5);
    CHECK(found() == outcome::verified);
    stored.forced.push_back(stored.forced[0]); // three of two
    CHECK(found() == outcome::refuted);
    // One parameter violates the one, another the other: neither is forced.
    stored.rows = {{box{interval(0.4, 0.6)}, box_verdict::undecided}};
    double const middle = 2 * std::exp(-0.5);
    readings[1].bound = interval(middle + 0.001, 3.0);
    readings.back().bound = interval(0.0, middle - 0.001);
    stored.forced = {{"run", 1.0, "x"}};
    CHECK(found() == outcome::undecided);
}
