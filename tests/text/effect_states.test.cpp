// SPDX-License-Identifier: MIT
// States that effects of a text add, by equations of their own.
#include "support/catch.hpp"
#include "text/texts.hpp"
#include "text/values.hpp"

#include <sivid/model/affected_problem.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/text/read_model.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using texts::same_equations;

namespace {

text_model motor_with(std::string const& effect) {
    return model_from_text(texts::motor + effect, "motor.toml");
}

std::string const driver_lag = R"toml([effect.driver]
constants.tau = "[0, 0.1] s"
states.f = { range = "24 V", start = "u" }
inputs = "f' = (u - f)/tau; u = f"
)toml";

/// What lags behind the speed is d.
std::string const filter = R"toml([effect.filter]
constants.tau = "[0, 0.1] s"
states.d = "800 rad/s"
equations = "d' = w' - d/tau"
outputs = "speed -= d"
)toml";

/// Where an error of this effect stands, from its own first line on, and what it says.
void refuses(std::string const& part, std::string const& by, std::size_t line, std::size_t column,
             std::string const& what, std::string const& effect = driver_lag) {
    INFO(by);
    try {
        (void)motor_with(texts::with(effect, part, by));
        FAIL("it was read");
    } catch (model_text_error const& error) {
        INFO(error.what());
        CHECK(error.place().line == 42 + line);
        CHECK(error.place().column == column);
        CHECK_THAT(std::string(error.what()), ContainsSubstring(what));
    }
}

} // namespace

TEST_CASE("a lag of an input as text is the one of C++") {
    auto const text = motor_with(driver_lag);
    auto const joined = with(text.model, {text.effects.back()});
    auto const same =
        with(text.model, {effects::input_lag("driver", "u", "V", {0_dec, 0.1_dec}, 24)});
    CHECK(same_equations(joined, same));
    // Its state is called by the effect in C++ by what lags, in a text as the text says.
    REQUIRE(joined.about.states.size() == 4);
    CHECK(joined.about.states[3].name == "driver.f");
    CHECK(joined.about.states[3].unit == "V");
    CHECK(joined.about.states[3].limit.upper == 24);
    REQUIRE(joined.added_states.size() == 1);
    CHECK(joined.g[joined.added_states[0].at_begin].op == operation::input);
}

TEST_CASE("a filter behind a sensor as text is the one of C++") {
    auto const text = motor_with(
        texts::with(filter, "outputs = \"speed -= d\"", "outputs = \"i -= d*1 [A s/rad]\""));
    auto const currents = texts::with(
        texts::with(texts::with(filter, "800 rad/s", "40 A"), "w' - d/tau", "i' - d/tau"),
        "speed -= d", "i -= d");
    auto const joined = with(text.model, {motor_with(currents).effects.back()});
    auto const same = with(text.model, {effects::sensor_lag("filter", {"i"}, {0_dec, 0.1_dec})});
    CHECK(same_equations(joined, same));
    CHECK(same.about.states[3].limit.upper == joined.about.states[3].limit.upper);
    CHECK(joined.g.is(joined.added_states[0].at_begin, 0));
}

TEST_CASE("bristles as text are those of C++") {
    auto const text = motor_with(R"toml([effect.bristles]
constants = { k = "[0, 50] rad/s^2", r = [0, 1] }
states.z = 2
equations = """
g = 1 + r*exp(-sqr(w/(2 [rad/s])))
z' = (w - abs(w)*z/g)/(0.5 [rad])
w' -= k*(z + 0.1 [s]*z')
"""
)toml");
    auto const made = effects::lugre_friction("bristles", "w", "rad/s^2", {0_dec, 50_dec},
                                              {0_dec, 1_dec}, 2_dec, 0.5_dec, 0.1_dec);
    std::vector<double> const x{3, 1, 2, 0.5}, u{12};
    auto const at = [&](effect const& e) {
        auto m = with(text.model, {e});
        for (auto const* name : {"bristles.k", "bristles.r"})
            m.about.constants[index_of(m.about.constants, name, "constant")].nominal = {
                interval(0.5), 0.5};
        return texts::values(m, x, u);
    };
    auto const a = at(text.effects.back()), b = at(made);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(texts::is_near(a[k], b[k]));
}

TEST_CASE("data behind a filter, simulated apart, never exclude the truth") {
    auto const text = model_from_text(R"toml(format = "sivid-model-1"
name = "wheel"
equations = "w' = (T - b*w)/J"
[states]
w = "100 rad/s"
[inputs]
T = "N m"
[constants]
b = "[0.03, 0.1] N m s"
J = "0.02 kg m^2"
[outputs]
w = "w"
[effect.filter]
constants = { k = [0, 1], tau = { prior = "[0.1, 0.5] s", neutral = "0.1 s" } }
states.d = "100 rad/s"
equations = "d' = w' - d/tau"
outputs = "w -= k*d"
)toml",
                                      "wheel.toml");
    // By Runge and Kutta in plain doubles, with the filtered speed itself as a state.
    double const b = 0.05, J = 0.02, tau = 0.2, h = 1e-3;
    struct state {
        double w, f;
    };
    auto const rate = [&](state const& s) -> state {
        return {(1 - b * s.w) / J, (s.w - s.f) / tau};
    };
    auto const moved = [](state const& s, state const& d, double by) -> state {
        return {s.w + by * d.w, s.f + by * d.f};
    };
    experiment e;
    e.name = "step";
    e.initial = box({interval(0.0)});
    e.inputs = {analytic_signal::from([](auto const&) { return expression(1.0); })};
    state s{0, 0};
    for (int n = 1; n <= 1000; ++n) {
        auto const k1 = rate(s), k2 = rate(moved(s, k1, h / 2)), k3 = rate(moved(s, k2, h / 2)),
                   k4 = rate(moved(s, k3, h));
        for (auto const& [k, share] : {std::pair{k1, 1.0}, {k2, 2.0}, {k3, 2.0}, {k4, 1.0}})
            s = moved(s, k, share * h / 6);
        if (n % 100 == 0) e.measurements.push_back({n * h, 0, interval(s.f - 0.02, s.f + 0.02)});
    }
    identify_options options;
    options.search.seconds = 1e6;
    options.search.boxes = 100;
    identification_problem const plain{text.model, text.parameters(), text.prior, {e}};
    CHECK(identify(plain, options).verdict == verdict::inconsistent);
    auto const problem = affected(plain, text.effects);
    REQUIRE(problem.choice.unknown == std::vector<std::string>{"b", "filter.k", "filter.tau"});
    auto const found = identify(problem, options);
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull[0], b));
    CHECK(contains(found.hull[1], 1));
    CHECK(contains(found.hull[2], tau));
}

TEST_CASE("a state of an effect whose start is unknown has one of its own in each experiment") {
    auto const written = [](std::string const& start) {
        std::string text = R"toml(format = "sivid-model-1"
name = "cart"
equations = "x' = v; v' = -k*x"
states = { x = "3 m", v = "5 m/s" }
constants.k = "[1, 3] 1/s^2"
outputs.x = "x"
[effect.hanging_mass]
constants.c = "[0, 1] 1/s^2"
states = { z = { range = "1 m"START }, u = { range = "3 m/s"START } }
equations = """
v' += c*(z - x)
z' = u
u' = -4 [1/s^2]*(z - x)
"""
)toml";
        for (auto at = text.find("START"); at != text.npos; at = text.find("START"))
            text.replace(at, 5, start);
        return model_from_text(text, "cart.toml");
    };
    double const k = 2, c = 0.5, h = 1e-3;
    using state = std::array<double, 4>;
    auto const rate = [&](state const& s) -> state {
        return {s[1], -k * s[0] + c * (s[2] - s[0]), s[3], -4 * (s[2] - s[0])};
    };
    auto const moved = [](state s, state const& d, double by) {
        for (std::size_t i = 0; i < 4; ++i) s[i] += by * d[i];
        return s;
    };
    std::vector<experiment> all;
    for (state s : {state{1, 0, 0.7, -0.4}, state{0, 1, -0.6, 0.9}}) { // by Runge and Kutta
        auto& e = all.emplace_back();
        e.name = "swing" + std::to_string(all.size());
        e.initial = {interval(s[0]), interval(s[1])};
        for (int n = 1; n <= 3000; ++n) {
            auto const k1 = rate(s), k2 = rate(moved(s, k1, h / 2)), k3 = rate(moved(s, k2, h / 2)),
                       k4 = rate(moved(s, k3, h));
            for (auto const& [d, share] : {std::pair{k1, 1.0}, {k2, 2.0}, {k3, 2.0}, {k4, 1.0}})
                s = moved(s, d, share * h / 6);
            if (n % 100 == 0)
                e.measurements.push_back({n * h, 0, interval(s[0] - 0.01, s[0] + 0.01)});
        }
    }
    auto const posed = [&](std::string const& start) {
        auto const text = written(start);
        return affected({text.model, text.parameters(), text.prior, all}, text.effects);
    };
    identify_options options;
    options.search.seconds = 1e6;
    options.search.boxes = 200;
    CHECK(identify(posed(""), options).verdict == verdict::inconsistent); // both begin at 0
    auto const problem = posed(", start = \"unknown\"");
    CHECK(problem.experiments[1].initial[2].upper() == 1);
    CHECK_FALSE(starts_follow_parameters(problem));
    auto const found = identify(problem, options);
    CHECK(found.verdict == verdict::consistent);
    CHECK(contains(found.hull[0], k));
    CHECK(contains(found.hull[1], c));
    CHECK(width(found.hull[0]) < 1);
}

TEST_CASE("states of effects that are wrong are told") {
    refuses("range = \"24 V\", ", "", 3, 12, "has no range");
    refuses("f' = (u - f)/tau; ", "", 3, 8, "the state 'f' has no equation");
    refuses("(u - f)/tau; ", "(u - f)/tau; f' = 0; ", 4, 29, "a second equation for f'");
    refuses("f' = (", "f' += (", 4, 11, "a second equation for f'");
    refuses("(u - f)/tau", "(u - f - f'*tau)/tau", 4, 25, "the rate f' is not known here");
    refuses("(u - f)/tau", "(u - f)", 4, 16, "this has the unit V, and f' has V/s");
    refuses("(u - f)/tau; u = f", "u/tau", 3, 8, "'f' stands in no formula");
    refuses("start = \"u\"", "start = \"w\"", 3, 39, "let it be the difference");
    refuses("start = \"u\"", "start = \"f\"", 3, 39, "let it be the difference");
    refuses("start = \"u\"", "start = \"u*t\"", 3, 41, "not at 't'");
    refuses("start = \"u\"", "start = \"i*R\"", 3, 39, "not at 'i'");
    refuses("start = \"u\"", "start = \"kt\"", 3, 39, "and 'f' has V");
    refuses("states.f", "states.i", 3, 8, "the model has a 'i', too");
    refuses("states.f", "states.tau", 3, 8, "the effect has a constant 'tau', too");
    refuses("states.f", "states.sin", 3, 8, "'sin' has a meaning of its own");
    refuses("u = f", "u = f; tau = 3", 4, 36, "no input and no constant");
    refuses("u = f", "J*w' = f", 4, 29, "no equations between formulas");
    refuses("u = f", "w' = f", 4, 29, "a rate is changed in the equations");
    refuses("start", "begin", 3, 30, "unknown key 'begin'");
}
