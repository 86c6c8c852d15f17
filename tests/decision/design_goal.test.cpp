// SPDX-License-Identifier: MIT
#include <sivid/decision/design_goal.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"

#include <sivid/decision/requirement.hpp>

#include <string>
#include <vector>

using namespace decision_support;

TEST_CASE("what the equations hide is said before anything is tried") {
    auto p = driven_cart(4);
    std::vector<std::string> const all{"p0", "p1", "p2"};
    auto const hidden = sivid::hidden_behind(p.model, all, sivid::parse_goal("p1", p.model));
    REQUIRE(hidden.has_value());
    REQUIRE(hidden->size() == 1);
    CHECK(hidden->front() == "p1*p2");
    auto const tells = [&](char const* text, std::vector<std::string> const& unknown) {
        return !sivid::hidden_behind(p.model, unknown, sivid::parse_goal(text, p.model));
    };
    CHECK(tells("p0", all));
    CHECK(tells("p1 * p2", all));
    CHECK(tells("(p1 * p2)^2 / p0", all));
    CHECK(!tells("p1 / p2", all));
    CHECK(!tells("sqrt(p2)", all));
    CHECK(tells("p1", {"p0", "p1"})); // the other one is known
}

TEST_CASE("goals that are no expression of constants are refused") {
    auto p = driven_cart(4);
    for (auto const* text : {"", "x0", "p0 + u0", "t", "p9", "p0 p1", "3", "p0 - p0", "p0 < 1"})
        CHECK_THROWS_AS(sivid::parse_goal(text, p.model), sivid::requirement_error);
}
