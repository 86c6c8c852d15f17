// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/law.hpp>

#include "../../../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;

TEST_CASE("the library speaks of the model's own quantities") {
    auto const model = record_model(hovercraft{});
    law_roles const roles(model);
    CHECK(roles.moving == std::vector<std::size_t>{0, 1, 2});
    CHECK(roles.angles == std::vector<std::size_t>{5});
    knot_trace t;
    t.times = {0, 1};
    t.states = {{1, 0.5, -0.2, 0, 0, 0.3}, {2, 0, 0.4, 1, 1, 0.1}};
    t.inputs = {{80, 0.1}, {90, -0.3}};
    t.input_slopes = {{10, -0.4}, {10, -0.4}};
    t.by_input.assign(2, std::vector<double>(12, 1.0));
    std::vector<knot_trace> const traces{t};
    law_library const library(model, traces);
    auto const laws = library.for_rates();
    auto const named = [&](std::string const& text) {
        auto const at =
            std::find_if(laws.begin(), laws.end(), [&](law const& l) { return l.text == text; });
        REQUIRE(at != laws.end());
        return at->functions.front().front();
    };
    CHECK(named("1") == std::vector<double>{1, 1});
    CHECK_THAT(named("abs(r)*r")[0], WithinAbs(-0.04, 1e-15));
    CHECK_THAT(named("W^2*t")[1], WithinAbs(8100, 1e-9));
    CHECK_THAT(named("W^2*d(delta)/dt")[0], WithinAbs(-2560, 1e-9));
    CHECK_THAT(named("u*v")[0], WithinAbs(0.5, 1e-15));
    CHECK_THAT(named("cos(psi), sin(psi)")[1], WithinAbs(std::cos(0.1), 1e-15));
    CHECK_THAT(named("speed*u")[1], WithinAbs(4, 1e-12));
    CHECK_THAT(named("exp(-t/0.25)")[1], WithinAbs(std::exp(-4.0), 1e-12));
    auto const inputs = library.for_input(1);
    CHECK(inputs.front().text == "1");
    auto const hinge = std::find_if(inputs.begin(), inputs.end(),
                                    [](law const& l) { return l.regime == "abs(delta) > 0.15"; });
    REQUIRE(hinge != inputs.end());
    CHECK_THAT(hinge->functions[0][0][1], WithinAbs(-0.15, 1e-12));
    CHECK(hinge->functions[0][0][0] == 0);
}

TEST_CASE("thresholds are those of states that keep their sign") {
    auto const model = record_model(hovercraft{});
    knot_trace t;
    t.times = {0, 1, 2};
    t.states = {{1, 0.5, -0.2, 0, 0, 0.3}, {2, -0.1, 0.4, 1, 1, 0.1}, {3, 0, 0, 1, 1, 0}};
    t.inputs = {{80, 0.1}, {90, -0.3}, {90, 0}};
    t.input_slopes = {{10, -0.4}, {10, -0.4}, {0, 0}};
    t.by_input.assign(3, std::vector<double>(12, 1.0));
    std::vector<knot_trace> const traces{t};
    auto const laws = law_library(model, traces).beyond_levels();
    REQUIRE_FALSE(laws.empty());
    for (auto const& l : laws) CHECK(l.regime.rfind("u > ", 0) == 0); // v and r change theirs
    auto const at =
        std::find_if(laws.begin(), laws.end(), [](law const& l) { return l.regime == "u > 2"; });
    REQUIRE(at != laws.end());
    CHECK_THAT(at->functions[0][0][2], WithinAbs(1, 1e-12));
    CHECK(at->functions[0][0][1] == 0);
}
