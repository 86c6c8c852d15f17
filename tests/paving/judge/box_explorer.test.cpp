// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/box_explorer.hpp>

#include "support/catch.hpp"
#include "support/inflations.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;

namespace {
bool always() { return true; }
} // namespace

TEST_CASE("a box of which nothing is known is integrated in parts that cover it") {
    // No parameter explains this: without a limit all is reached nevertheless.
    auto const problem = support::decay(between(0.25, 3), 50, -50, 0.5);
    box_explorer explorer(problem, {});
    std::vector<explored_box> boxes{explorer.unknown<explored_box>(problem.prior)};
    CHECK(boxes[0].is_blind());
    CHECK_FALSE(boxes[0].is_complete());
    explorer.learn(boxes, always);
    CHECK(boxes.size() == explorer.at_once());
    CHECK(explorer.integrations() == boxes.size());
    std::sort(boxes.begin(), boxes.end(),
              [](auto const& a, auto const& b) { return a.set[0].lower() < b.set[0].lower(); });
    double reached = 0.25;
    for (auto const& b : boxes) {
        CHECK(b.set[0].lower() == reached);
        reached = b.set[0].upper();
        CHECK(b.is_complete());
        CHECK_FALSE(b.is_blind());
    }
    CHECK(reached == 3);
    // Parts know what the whole knew, and are blind where that is stale.
    auto parts = explorer.halves(boxes[3]);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].known == boxes[3].known);
    CHECK(parts[0].is_blind());
    parts[0].stale.assign(1, false);
    CHECK_FALSE(parts[0].is_blind());
}

TEST_CASE("what cannot be split is integrated as it is") {
    auto const problem = support::decay(interval(1.0), 0.5, 0.25, 0.5);
    box_explorer explorer(problem, {});
    std::vector<explored_box> boxes{explorer.unknown<explored_box>(problem.prior)};
    CHECK(explorer.halves(boxes[0]).empty());
    explorer.learn(boxes, always);
    REQUIRE(boxes.size() == 1);
    CHECK(boxes[0].is_complete());
}

TEST_CASE("an interrupted look leaves boxes that are not fresh") {
    auto const problem = support::decay(between(0.25, 3), 0.5, 0.25, 0.5);
    box_explorer explorer(problem, {});
    std::vector<explored_box> boxes{explorer.unknown<explored_box>(problem.prior)};
    explorer.learn(boxes, [] { return false; });
    CHECK(explorer.integrations() == 0);
    for (auto const& b : boxes) CHECK(b.is_blind());
    boxes.clear();
    CHECK_NOTHROW(explorer.learn(boxes, always));
}

TEST_CASE("the smear chooses the side, and falls where a box is split") {
    auto problem = support::decay(between(0.25, 3), 0.5, 0.25, 0.5);
    problem.model =
        support::model_of({1, 2}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[1] - p[0] * x[0]};
        });
    problem.choice.unknown = support::all_constants(2);
    problem.prior = box{between(0, 1), between(0, 1)};
    box_explorer explorer(problem, {});
    auto b = explorer.unknown<explored_box>(problem.prior);
    b.smear = {1, 2};
    auto const parts = explorer.halves(b);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].set[1].upper() == 0.5);
    CHECK(parts[1].set[1].lower() == 0.5);
    CHECK(parts[0].set[0].upper() == 1);
    CHECK(parts[0].smear == std::vector<double>{1, 0.5});
}
