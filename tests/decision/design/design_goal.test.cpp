// SPDX-License-Identifier: MIT
#include <sivid/decision/design/design_goal.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"

#include <sivid/decision/requirement.hpp>

#include <stdexcept>
#include <string>
#include <vector>

using namespace decision_support;

TEST_CASE("what the equations hide is said before anything is tried") {
    auto p = driven_cart(4);
    std::vector<std::string> const all{"p0", "p1", "p2"};
    auto const hidden = sivid::hidden_behind(p.model, {all, {}}, sivid::parse_goal("p1", p.model));
    REQUIRE(hidden.has_value());
    REQUIRE(hidden->size() == 1);
    CHECK(hidden->front() == "p1*p2");
    auto const tells = [&](char const* text, std::vector<std::string> const& unknown) {
        return !sivid::hidden_behind(p.model, {unknown, {}}, sivid::parse_goal(text, p.model));
    };
    CHECK(tells("p0", all));
    CHECK(tells("p1 * p2", all));
    CHECK(tells("(p1 * p2)^2 / p0", all));
    CHECK(!tells("p1 / p2", all));
    CHECK(!tells("sqrt(p2)", all));
    CHECK(tells("p1", {"p0", "p1"})); // the other one is known
}

TEST_CASE("a hidden goal keeps what its partners do not bound, and no more is said") {
    // x' = -p1 p2 x: p1 p2 is told. Of (1, 1) the motion goes on with p2 = 1 / p1.
    auto const share = [](sivid::interval const& p1, sivid::interval const& p2) {
        sivid::prediction_problem p;
        p.model = support::model_of(
            {.states = 1, .constants = 3},
            [](auto const&, auto const& x, auto const& c, auto const&) {
                return std::vector{-(c[1] * c[2] * x[0]) - c[0]};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        p.choice.unknown = {"p0", "p1", "p2"};
        p.sets = {{between(0, 1), p1, p2}};
        auto const goal = sivid::parse_goal("p1", p.model);
        CHECK(sivid::hidden_behind(p.model, p.choice, goal));
        CHECK(sivid::untold_share(p, p, {0.5, 1, 1}, sivid::parse_goal("p0", p.model)) == 0);
        return sivid::untold_share(p, p, {0.5, 1, 1}, goal);
    };
    double const all = share(between(0.5, 2), between(0.1, 10));
    CHECK(all <= 1);
    CHECK(all > 0.999);
    double const little = share(between(0.5, 2), between(0.99, 1.01));
    CHECK(little <= (1 / 0.99 - 1 / 1.01) / 1.5);
    CHECK(little > 0.999 * (1 / 0.99 - 1 / 1.01) / 1.5);
    CHECK(share(between(0.5, 2), sivid::interval(1.0)) < 1e-9);
    CHECK(share(between(2, 3), between(0.1, 10)) == 0); // the point is not in the prior
}

TEST_CASE("all goals are what experiments can tell of all parameters") {
    auto p = driven_cart(4);
    auto const texts = [&](std::vector<std::string> const& unknown) {
        std::string all;
        for (auto const& g : sivid::all_goals(p.model, {unknown, {}})) all += g.text + " ";
        return all;
    };
    CHECK(texts({"p0", "p1", "p2"}) == "p0 p1*p2 ");
    CHECK(texts({"p2", "p1"}) == "p2*p1 ");
    CHECK(texts({"p1", "p0"}) == "p1 p0 ");
}

TEST_CASE("a known constant counts with its value, not with the one that the model names") {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 3, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{c[0] * c[1] * u[0] - c[0] * c[2] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    auto const goal = sivid::parse_goal("p0", p.model);
    auto const hidden = [&](sivid::interval const& p2) {
        return sivid::hidden_behind(p.model, {{"p0", "p1"}, {{"p2", p2}}}, goal).has_value();
    };
    CHECK(hidden(sivid::interval(0.0)));
    CHECK_FALSE(hidden(sivid::interval(0.5)));
    CHECK_FALSE(hidden(between(0, 0.5)));
    p.model.about.constants[2].nominal = {sivid::interval(0.0), 0};
    CHECK_FALSE(hidden(sivid::interval(0.5)));
    CHECK_THROWS_AS(sivid::hidden_behind(p.model, {{"p1"}, {}}, goal), std::invalid_argument);
}

TEST_CASE("goals that are no expression of constants are refused") {
    auto p = driven_cart(4);
    for (auto const* text : {"", "x0", "p0 + u0", "t", "p9", "p0 p1", "3", "p0 - p0", "p0 < 1"})
        CHECK_THROWS_AS(sivid::parse_goal(text, p.model), sivid::requirement_error);
}
