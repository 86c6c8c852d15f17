// SPDX-License-Identifier: MIT
#include <sivid/model/effect.hpp>

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
    says("x'~", "a factor is needed");
    says("x'~2*", "a factor is needed");
    says("x'~2**x", "a factor is needed");
    says("x'~2*x)", "'*' or '/' is needed");
    says("x'~2*abs(x", "')' is needed");
    says("x'~2*sgn(x)", "':' is needed");
    says("x'~2*lift(x)", "is no function");
    says("x'~2*x^1", "a power from 2 to 9");
    says("x'~1.2.3*x", "is no number");
    says("x'~2exp(x)", "'*' or '/' is needed");
    says("x'~2e", "'*' or '/' is needed");
    says("x'~2e+", "'*' or '/' is needed");
    says("x'~2*turn(x)*turn(w)", "stand once");
    says("x'~2*abs(turn(x))", "stand once");
    says("x'~2*speed", "the model has no 'speed'; known: t, x, w, u, c");
    says("z'~2*x", "z");
    says("x'~2*" + std::string(20, '(') + "x", "too many brackets");
    std::string deep = "x";
    for (int k = 0; k < 20; ++k) deep = "abs(" + deep + ")";
    says("x'~2*" + deep, "too many brackets");
}
