// SPDX-License-Identifier: MIT
#include <sivid/model/named_effects.hpp>

#include "model/cart.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>
#include <sivid/model/model.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;
using namespace model_support;

namespace {

/// What the term adds to x' = 2 u, at u = 1.5 (see `at`), with its parameters.
double added(std::string const& name, std::vector<double> const& parameters) {
    auto const m = with(cart{}, missing_term(name));
    return at(m, m.rate[0], 1.5, parameters) - 3;
}

} // namespace

TEST_CASE("a term is read from its name") {
    auto const is = [](std::string const& name, double value) {
        INFO(name);
        CHECK(std::abs(added(name, {0.5}) - 0.5 * value) < 1e-14);
    };
    is("x'~4", 4);
    is("x'~0.25*abs(x)*x", -0.0625);
    is("x'~4e+02*x", -200);
    is("x'~5e-1*beyond(u:1e+00)", 0.25);
    is("x'~2*x^3*w", -0.5);
    is("x'~2*u*w/c", 3);
    is("x'~1*sgn(x:0.5)", -std::sqrt(0.5));
    is("x'~3*beyond(u:0.5)", 3);
    is("x'~3*beyond(x:0.75)", 0);
    is("x'~1*exp(-t/0.5)", std::exp(-6.0));
    is("x'~1*sqrt(x^2+w^2)*w", 2 * std::sqrt(4.25));
    is("x'~2*abs(u-2*(x+w))", 3);
    auto const turn = added("x'~2*turn(w)", {0.5, -0.25});
    CHECK(std::abs(turn - 2 * (0.5 * std::cos(2.0) - 0.25 * std::sin(2.0))) < 1e-14);
    auto const wave = added("x'~2*wave(1.5*t)*x", {0.5, -0.25, 1.1});
    CHECK(std::abs(wave + (0.5 * std::cos(4.95) - 0.25 * std::sin(4.95))) < 1e-14);
    auto const e = missing_term("x'~2*wave(1.5*t)");
    CHECK(e.parameters.size() == 3);
    CHECK(e.name == "x'~2*wave(1.5*t)");
}

TEST_CASE("a term sees what the model sees") {
    auto const trim = effects::input_trim("trim", "u", "N", {-1_dec, 1_dec});
    auto const both = with(cart{}, trim, missing_term("x'~1*u"));
    auto const plain = with(cart{}, trim);
    CHECK(both.rate[0] != plain.rate[0]);
    auto const used = operands_of(both.g, {both.rate[0]});
    std::size_t constants = 0;
    for (std::size_t k = 0; k < used.size(); ++k)
        constants += used[k] && both.g.nodes()[k].op == operation::constant ? 1 : 0;
    CHECK(constants == 3); // c, the trim, and k
}

TEST_CASE("terms are named like effects of a catalogue") {
    auto const found = effects_named({}, {"x'~0.5*x", "x'~0.5*x@S1+S2", "x'~0.5*x_wider"});
    REQUIRE(found.size() == 3);
    CHECK(found[1].only_in == std::vector<std::string>{"S1", "S2"});
    CHECK(found[2].parameters[0].widened == 4);
    CHECK_THROWS_AS(effects_named({}, {"drag"}), std::invalid_argument);
}

TEST_CASE("what is no term says where and why") {
    auto const says = [](std::string const& name, std::string const& what) {
        INFO(name);
        CHECK_THROWS_WITH(with(cart{}, missing_term(name)), ContainsSubstring(what));
    };
    says("x'=2", "names no term");
    says("'~2", "names no term");
    says("x'~", "something is missing");
    says("x'~2*", "something is missing");
    says("x'~2**x", "this cannot begin an expression");
    says("x'~2*x)", "'*' or '/' is needed");
    says("x'~2*abs(x", "')' is missing");
    says("x'~2*sgn(x)", "':' is missing");
    says("x'~2*lift(x)", "is no function");
    says("x'~2*x^1", "a whole number from 2 to 9");
    says("x'~1.2.3*x", "is no number");
    says("x'~2exp(x)", "is no number");
    says("x'~2e", "is no number");
    says("x'~2e+", "is no number");
    says("x'~2*turn(x)*turn(w)", "stand once");
    says("x'~2*abs(turn(x))", "stand once");
    says("x'~2/turn(x)", "stand once");
    says("x'~2*speed", "the model has no 'speed'; known: t, x, w, u, c");
    says("z'~2*x", "z");
    says("x'~2*" + std::string(20, '(') + "x", "nested too deep");
    std::string deep = "x";
    for (int k = 0; k < 20; ++k) deep = "abs(" + deep + ")";
    says("x'~2*" + deep, "nested too deep");
}

namespace {

/// What channel y of the cart (x = -0.5, w = 2, a state of the fault 0.25) shows with a fault.
double shown(std::string const& name, std::size_t y, std::vector<double> const& parameters) {
    auto const m = with(cart{}, sensor_fault(name));
    return at(m, m.observe[y], 1.5, parameters);
}

} // namespace

TEST_CASE("a fault of an instrument is read from its name") {
    CHECK(shown("sensor_bias(y)~0.5", 0, {0.25}) == -0.25);
    CHECK(shown("sensor_bias(y:z)~0.5", 0, {0.25, 1}) == -0.25);
    CHECK(shown("sensor_bias(y:z)~0.5", 1, {0.25, 1}) == 3);
    CHECK(shown("sensor_drift(z)~0.5", 1, {0.25}) == 2.75); // t = 3
    CHECK(shown("sensor_drift(z:y)~0.5", 0, {0, 0.5}) == 1);
    CHECK(shown("sensor_scale(y:z)~3", 0, {-2}) == 0.5);
    CHECK(shown("sensor_scale(y:z)~3", 1, {-2}) == -2);
    CHECK(shown("sensor_saturation(z)~3", 1, {1.5}) == 1.5);
    CHECK(shown("sensor_swap(y:z)~1.2", 0, {1}) == 2);
    CHECK(shown("sensor_swap(y:z)~1.2", 1, {1}) == -0.5);
    CHECK(std::abs(shown("sensor_rotation(y:z)~0.5", 0, {0.5}) -
                   (-0.5 * std::cos(0.5) - 2 * std::sin(0.5))) < 1e-15);
    CHECK(std::abs(shown("sensor_lever_arm(y:z:w)~2", 1, {0.5, 1}) -
                   (2 + 0.5 * std::sin(2.0) + std::cos(2.0))) < 1e-15);
    CHECK(shown("sensor_velocity_arm(y:z:w)~2", 0, {0.5, 1}) == -2.5);
    CHECK(shown("sensor_velocity_arm(y:z:w)~2", 1, {0.5, 1}) == 3);
    auto const late = with(cart{}, sensor_fault("sensor_latency(y:z)~0.5"));
    REQUIRE(late.channel_delays.size() == 2);
    CHECK(late.channel_delays[1].index == 1);
    CHECK(late.channel_delays[0].constant == late.channel_delays[1].constant);

    auto const m = with(cart{}, sensor_fault("sensor_lag(y)~0.5"));
    REQUIRE(m.rate.size() == 3);
    CHECK(m.about.states[2].name == "sensor_lag(y)~0.5.y");
    CHECK(m.about.states[2].limit == 10); // twice that of x
    CHECK(at(m, m.observe[0], 1.5, {0.5}) == -0.75);
    CHECK(at(m, m.rate[2], 1.5, {0.5}) == 2.5); // 2 u - w/tau
    CHECK(at(m, m.added_states[0].at_begin, 1.5, {0.5}) == 0);
}

TEST_CASE("a fault has the prior that its name says, and its channel's unit") {
    auto const about = record_model(cart{}).about;
    auto const prior = [&about](std::string const& name, double lower, double upper,
                                std::string const& unit) {
        INFO(name);
        auto const e = sensor_fault(name, &about);
        for (auto const& p : e.parameters) {
            CHECK(p.prior().lower() <= lower);
            CHECK(lower < p.prior().lower() + 1e-12);
            CHECK(p.prior().upper() >= upper);
            CHECK(upper > p.prior().upper() - 1e-12);
            CHECK(p.unit_in(about) == unit);
        }
        CHECK(e.name == name);
    };
    prior("sensor_bias(y)~0.5", -0.5, 0.5, "m/s");
    prior("sensor_drift(z)~20", -20, 20, "m/s");
    prior("sensor_scale(y)~0.6", -0.6, 0.6, "1");
    prior("sensor_latency(y)~.25", 0, 0.25, "s");
    prior("sensor_lag(y)~2", 0.02, 2, "s");
    prior("sensor_saturation(z)~4", 0.4, 4, "m");
    prior("sensor_rotation(y:z)~0.5", -0.5, 0.5, "rad");
    prior("sensor_velocity_arm(y:z:w)~2", -2, 2, "m");
    CHECK(sensor_fault("sensor_drift(y:z)~1").parameters[1].name == "d_z");
    CHECK(sensor_fault("sensor_bias(y)~1").parameters[0].unit.empty()); // nobody says

    auto const found =
        effects_named({}, {"sensor_lag(y)~2@S1+S2", "sensor_bias(y)~0.5_wider"}, &about);
    CHECK(found[0].only_in == std::vector<std::string>{"S1", "S2"});
    CHECK(found[1].parameters[0].widened == 4);
    CHECK(found[1].parameters[0].unit == "m/s");
}

TEST_CASE("a fault says in its name whose it is") {
    using names = std::vector<std::string>;
    CHECK(faulty_channels("sensor_lag(u:v)~0.5") == names{"u", "v"});
    CHECK(faulty_channels("sensor_lever_arm(x:y:psi)~2_wider") == names{"x", "y"});
    CHECK(faulty_channels("sensor_bias(q)~2@S1+S2") == names{"q"});
    CHECK_THROWS_AS(faulty_channels("gyro_bias"), std::invalid_argument);
}

TEST_CASE("a lag in some experiments only leaves no trace in the others") {
    auto const m = with(cart{}, only_within(sensor_fault("sensor_lag(y)~0.5"), {"S1"}));
    // Its switch is the second input, which `at` sets as the first one.
    CHECK(at(m, m.observe[0], 1, {0.5}) == -0.75);
    CHECK(at(m, m.observe[0], 0, {0.5}) == -0.5);
    CHECK(std::isfinite(at(m, m.rate[2], 0, {0.5})));
}

TEST_CASE("what is no fault of an instrument says why") {
    auto const says = [](std::string const& name, std::string const& what) {
        INFO(name);
        CHECK_THROWS_WITH(with(cart{}, sensor_fault(name)), ContainsSubstring(what));
    };
    says("sensor_bias", "no channels in brackets");
    says("sensor_bias(y)", "no size");
    says("sensor_bias)~(y", "no channels in brackets");
    says("sensor_bias()~1", "a name is missing");
    says("sensor_bias(y:)~1", "a name is missing");
    says("sensor_bias(y)~", "no size above 0");
    says("sensor_bias(y)~0", "no size above 0");
    says("sensor_bias(y)~-1", "no size above 0");
    says("sensor_bias(y)~1e400", "no size above 0");
    says("sensor_bias(y)~1.2.3", "no size above 0");
    says("sensor_saturation(y:z)~1", "one channel is needed");
    says("sensor_rotation(y)~1", "2 names are needed");
    says("sensor_lever_arm(y:z)~1", "3 names are needed");
    says("sensor_noise(y)~1", "write one as in sensor_drift(r)~0.1");
    says("sensor_bias(q)~1", "unknown channel 'q'");
    says("sensor_lever_arm(y:z:h)~1", "unknown state 'h'");
    CHECK_THROWS_WITH(with(cart{}, effects::sensor_scale("scale", {"y"}, {-1_dec, 1_dec}),
                           sensor_fault("sensor_lag(y)~1"), sensor_fault("sensor_lag(y)~2")),
                      ContainsSubstring("shows no state as it is"));
    CHECK_THROWS_AS(effects_named({}, {"sensor_bias"}), std::invalid_argument);
}
