// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/law.hpp>

#include "../../../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"

#include <sivid/model/named_effects.hpp>

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
    CHECK_THAT(named("u^2*v")[0], WithinAbs(0.5, 1e-15));
    CHECK_THAT(named("u*v*r")[0], WithinAbs(-0.1, 1e-15));
    CHECK_THAT(named("delta*u^2")[1], WithinAbs(-1.2, 1e-12));
    CHECK_THAT(named("W*delta*u")[0], WithinAbs(8, 1e-12));
    for (std::size_t k = 0; k < laws.size(); ++k) {
        auto const same = std::count_if(laws.begin(), laws.end(),
                                        [&](law const& l) { return l.text == laws[k].text; });
        CHECK(same == 1); // each shape once
    }
    CHECK_THAT(named("exp(-t/0.5)")[1], WithinAbs(std::exp(-2.0), 1e-12)); // half a step
    auto const inputs = library.for_input(1);
    CHECK(inputs.front().text == "1");
    auto const hinge = std::find_if(inputs.begin(), inputs.end(),
                                    [](law const& l) { return l.regime == "abs(delta) > 0.15"; });
    REQUIRE(hinge != inputs.end());
    CHECK_THAT(hinge->functions[0][0][1], WithinAbs(-0.15, 1e-12));
    CHECK(hinge->functions[0][0][0] == 0);
}

TEST_CASE("formulas of laws are read as terms, and are these laws") {
    auto const model = record_model(hovercraft{});
    knot_trace t;
    t.times = {0, 1.5, 3};
    t.states = {{1, 0.5, -0.2, 0, 0, 0.3}, {2, -0.7, 0.4, 1, 1, 0.1}, {-3, 0.1, 0.3, 1, 1, 0}};
    t.inputs = {{250, 0.1}, {90, -0.3}, {-160, 0}}; // thresholds of more digits than are written
    t.input_slopes = {{10, -0.4}, {10, -0.4}, {0, 0}};
    t.by_input.assign(3, std::vector<double>(12, 1.0));
    std::vector<knot_trace> const traces{t};
    law_library const library(model, traces);
    auto laws = library.for_rates();
    for (auto& more : library.waves()) laws.push_back(std::move(more));
    auto const zero = [](graph& to) { return to.constant(0.0); };
    std::size_t read = 0;
    for (auto const& l : laws) {
        if (l.formula.empty()) continue;
        ++read;
        CAPTURE(l.text, l.formula);
        // The equation of x with the term, less that without, the first or second unknown at 1.
        auto const m = with(model, std::vector<effect>{missing_term("x'~1*" + l.formula)});
        auto const own = model.about.constants.size();
        for (std::size_t f = 0; f < l.functions.size(); ++f) {
            for (std::size_t k = 0; k < t.times.size(); ++k) {
                auto const value = [&](bool on) {
                    graph g;
                    auto const image =
                        copy_into(g, m.g, {m.rate[3]}, [&](node const& n, graph& to) {
                            auto const i = static_cast<std::size_t>(n.index);
                            bool const frequency = i == own + 2;
                            switch (n.op) {
                            case operation::time:
                                return to.constant(t.times[k]);
                            case operation::state:
                                return to.constant(t.states[k][i]);
                            case operation::input:
                                return to.constant(t.inputs[k][i]);
                            default:
                                return i < own
                                           ? zero(to)
                                           : to.constant(frequency || (on && i == own + f) ? 1 : 0);
                            }
                        });
                    return g.value(g[image.front()]).nearest;
                };
                double const difference = value(true) - value(false);
                CHECK(std::abs(difference - l.functions[f][0][k]) < 1e-12 * l.reach() + 1e-15);
            }
        }
    }
    CHECK(read > 80);
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
