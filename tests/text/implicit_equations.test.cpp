// SPDX-License-Identifier: MIT
// Equations of a text in which rates stand on both sides, or times a factor.
#include "support/catch.hpp"
#include "text/texts.hpp"
#include "text/values.hpp"

#include <sivid/model/implicit_model.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/text/read_model.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using texts::same_equations;
using texts::values;

namespace {

/// A model of these equations and outputs; x, y, z are positions and v, w, q their speeds.
text_model model_of(std::string const& equations, std::string const& states,
                    std::string const& outputs) {
    std::string text = "format = \"sivid-model-1\"\nname = \"m\"\nequations = \"\"\"\n" +
                       equations + "\n\"\"\"\n[states]\n";
    for (char const s : states)
        text += std::string{s} + " = \"10 " + (s < 'v' || s > 'w' ? "m" : "m/s") + "\"\n";
    text += "[inputs]\nF = \"N\"\n[constants]\nm = \"[1, 3] kg\"\nM = \"4 kg\"\nb = \"[0.1, 1] "
            "kg/s\"\n[outputs]\n" +
            outputs;
    return model_from_text(text, "m.toml");
}

/// A cart with a pendulum: two rates in two equations.
struct cart {
    static constexpr auto name = "cart";
    static constexpr auto states =
        sivid::states({{"x", "m", 5}, {"a", "rad", 2}, {"v", "m/s", 5}, {"r", "rad/s", 9}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}, {"a", "rad"}});
    static constexpr auto constants = sivid::constants(
        {{"M", "kg", 2_dec}, {"m", "kg", 1_dec}, {"l", "m", 0.5_dec}, {"g", "m/s^2", 9.81_dec}});

    template <class T>
    matrix_of<cart, T> mass(T const&, states_of<cart, T> const& s, constants_of<cart, T> const& c,
                            inputs_of<cart, T> const&) const {
        auto const& [M, m, l, g] = c;
        auto const k = cos(s[1]);
        return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, M + m, m * l * k}, {0, 0, k, l}}};
    }
    template <class T>
    equations_of<cart, T> force(T const&, states_of<cart, T> const& s,
                                constants_of<cart, T> const& c, inputs_of<cart, T> const& u) const {
        auto const& [M, m, l, g] = c;
        return {s[2], s[3], u[0] + m * l * sin(s[1]) * sqr(s[3]), -g * sin(s[1])};
    }
    template <class T>
    channels_of<cart, T> observe(T const&, states_of<cart, T> const& s,
                                 constants_of<cart, T> const&, inputs_of<cart, T> const&) const {
        return {s[0], s[1]};
    }
};

std::string const cart_text = texts::of_file("tests/text/cart.toml");

/// Where an error of equations of two speeds stands, and what it says.
void refuses(std::string const& equations, std::size_t line, std::size_t column,
             std::string const& what) {
    INFO(equations);
    try {
        (void)model_of(equations, "vw", "v = \"v\"\nu = \"w*M/b + F*m/b^2\"\n");
        FAIL("it was read");
    } catch (model_text_error const& error) {
        INFO(error.what());
        CHECK(error.place().line == line);
        CHECK(error.place().column == column);
        CHECK_THAT(std::string(error.what()), ContainsSubstring(what));
    }
}

} // namespace

TEST_CASE("a rate on both sides is solved for as by hand") {
    auto const outputs = "v = \"v\"\n";
    auto const by_hand = model_of("v' = (F - b*v*abs(v)/(1 [m/s]))/(M + m)", "v", outputs).model;
    for (std::string const equation :
         {"M*v' = F - b*v*abs(v)/(1 [m/s]) - m*v'", "M*v' + m*v' = F - b*v*abs(v)/(1 [m/s])",
          "(M + m)*v' = F - b*v*abs(v)/(1 [m/s])",
          "inertia = m*v'\nM*v' = F - b*v*abs(v)/(1 [m/s]) - inertia"}) {
        INFO(equation);
        auto const text = model_of(equation, "v", outputs);
        CHECK(same_equations(text.model, by_hand));
        CHECK(text.model.stated);
    }
    // On its own on the left it is divided through.
    auto const divided = model_of("v' = (F - b*v - m*v')/M", "v", outputs).model;
    CHECK(std::abs(values(divided, {2}, {9})[0] - (9 - 0.55 * 2) / 6) < 1e-15);
    // And what has no rate on the right is as it is.
    CHECK_FALSE(model_of("v' = (F - b*v)/(M + m)", "v", outputs).model.stated);
}

TEST_CASE("signs, quotients, units and cases of rates are those of the formula") {
    auto const rate = [](std::string const& equation) {
        return values(model_of(equation, "v", "v = \"v*M/m + v\"\n").model, {3}, {10})[0];
    };
    CHECK(
        texts::is_near(rate("-(-M*v') = F - b/b*F + b*v - F*(m/m - 1) + F"), (10 + 0.55 * 3) / 4));
    CHECK(texts::is_near(rate("M*v' = F - v'*m*2/2 - b*v"), (10 - 0.55 * 3) / 6));
    CHECK(texts::is_near(rate("M*v' - F = 3000 [g]*v' - 0*v' - b*v"), (10 - 0.55 * 3) / 1));
    CHECK(
        texts::is_near(rate("M*v' = if(v > 1 [m/s], F - m*v', F - M*v') - b*v"), (10 - 1.65) / 6));
    CHECK(
        texts::is_near(rate("M*v' = if(v > 5 [m/s], F - m*v', F - M*v') - b*v"), (10 - 1.65) / 8));
    CHECK(texts::is_near(rate("v'*(M + m)/(2*M) = F/(2*M) - b*v/(2*M)"), (10 - 1.65) / 6));
}

TEST_CASE("coupled rates are solved for as those of an implicit functor") {
    auto const text = model_from_text(cart_text, "cart.toml").model;
    auto const functor = record_model(cart{});
    CHECK(same_equations(text, functor));
    REQUIRE(text.stated);
    CHECK(text.stated->mass.size() == 4);
    // And they hold: x, a, v, r.
    double const a = 0.7, r = 1.5, F = 3;
    auto const rate = values(text, {1, a, -2, r}, {F});
    CHECK(texts::is_near(3 * rate[2] + 0.5 * std::cos(a) * rate[3], F + 0.5 * std::sin(a) * r * r));
    CHECK(texts::is_near(std::cos(a) * rate[2] + 0.5 * rate[3], -9.81 * std::sin(a)));
}

TEST_CASE("four coupled rates satisfy their equations") {
    auto const text = model_from_text(R"toml(format = "sivid-model-1"
name = "chain"
equations = """
4*a' + b' = d'/2 - a*k
3*b' = c' - a' - b*k
5*c' + d' - b' = k*sin(c)
d' + c'/4 + a' = -k*d
"""
[states]
a = 1
b = 1
c = 1
d = 1
[constants]
k = "[1, 2] 1/s"
[outputs]
jerk = "a'^2/(1 [1/s]) + d'"
)toml",
                                      "chain.toml");
    std::array<double, 4> const x{0.3, -0.4, 0.9, 0.2};
    auto const y = values(text.model, {x.begin(), x.end()}, {});
    double const k = 1.5;
    CHECK(texts::is_near(4 * y[0] + y[1], y[3] / 2 - x[0] * k));
    CHECK(texts::is_near(3 * y[1], y[2] - y[0] - x[1] * k));
    CHECK(texts::is_near(5 * y[2] + y[3] - y[1], k * std::sin(x[2])));
    CHECK(texts::is_near(y[3] + y[2] / 4 + y[0], -k * x[3]));
    CHECK(texts::is_near(y[4], y[0] * y[0] + y[3])); // outputs see rates, in any formula
}

TEST_CASE("data of coupled rates, simulated apart, never exclude the truth") {
    // By Runge and Kutta in plain doubles, solved by hand.
    double const m = 1.1, l = 0.45, M = 2, g = 9.81, h = 1e-4;
    using state = std::array<double, 4>;
    auto const rate = [&](double t, state const& s) -> state {
        double const F = 2 * std::cos(3 * t), c = std::cos(s[1]), n = std::sin(s[1]);
        double const p = F + m * l * n * s[3] * s[3], q = -g * n;
        double const det = (M + m) * l - m * l * c * c;
        return {s[2], s[3], (p * l - m * l * c * q) / det, ((M + m) * q - c * p) / det};
    };
    auto const moved = [](state s, state const& d, double by) {
        for (std::size_t i = 0; i < 4; ++i) s[i] += by * d[i];
        return s;
    };
    experiment e;
    e.name = "swing";
    state s{0, 0.4, 0, 0};
    e.initial = box({interval(0.0), interval(0.4), interval(0.0), interval(0.0)});
    e.inputs = {analytic_signal::from([](auto const& t) { return 2 * cos(3 * t); })};
    for (int n = 1; n <= 6000; ++n) {
        double const t = (n - 1) * h;
        auto const a = rate(t, s), b = rate(t + h / 2, moved(s, a, h / 2)),
                   c = rate(t + h / 2, moved(s, b, h / 2)), d = rate(t + h, moved(s, c, h));
        for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        if (n % 1000 != 0) continue;
        for (std::size_t y = 0; y < 2; ++y)
            e.measurements.push_back({n * h, y, interval(s[y] - 1e-3, s[y] + 1e-3)});
    }
    auto const text = model_from_text(cart_text, "cart.toml");
    identify_options options;
    options.search.seconds = 1e6;
    options.search.boxes = 60;
    auto const found = identify({text.model, text.parameters(), text.prior, {e}}, options);
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull[0], m));
    CHECK(contains(found.hull[1], l));
    CHECK(width(found.hull[0]) < 0.5 * width(text.prior[0])); // and they say something
}

TEST_CASE("where the factor of a rate may be zero nothing is proved, and that is the reason") {
    auto const text =
        model_from_text(texts::with(texts::with(cart_text, "[0.4, 0.6] m", "[-0.1, 0.6] m"),
                                    "a = \"2 rad\"", "a = \"0.1 rad\""),
                        "cart.toml");
    experiment e;
    e.initial = box({interval(0.0), interval(0.0, 0.1), interval(0.0), interval(0.0)});
    e.inputs = {analytic_signal::from([](auto const&) { return expression(1.0); })};
    e.measurements = {{0.1, 0, interval(-9.0, 9.0)}};
    identification_problem const problem{text.model, text.parameters(), text.prior, {e}};
    auto const divisors = divisors_of(problem);
    REQUIRE_FALSE(divisors.empty());
    CHECK(divisors.front().zeros == zeros::some);
    identify_options options;
    options.search.seconds = 1e6;
    options.search.boxes = 3;
    options.strategy = {};
    CHECK(identify(problem, options).verdict != verdict::inconsistent);
    CHECK(divisors_of({text.model,
                       text.parameters(),
                       box({hull(0.8_dec, 1.25_dec), hull(0.4_dec, 0.6_dec)}),
                       {e}})
              .front()
              .zeros == zeros::none);
}

TEST_CASE("equations that cannot be solved for their rates are told") {
    std::string const other = "\nw' = v/(1 [s])";
    refuses("M*v' = F - b*abs(v')*(1 [s])" + other, 4, 14, "do not stand linearly");
    refuses("M*v' = F - m*v'^2/(1 [m/s^2])" + other, 4, 16, "do not stand linearly");
    refuses("M*v' = F - m*v'*w'/(1 [m/s^2])" + other, 4, 16, "do not stand linearly");
    refuses("v' = F/(M + m*v'/(1 [m/s^2]))" + other, 4, 7, "a with a' = (w' - a)/tau");
    refuses("v' = if(v' > 0, F/M, 0)" + other, 4, 6, "do not stand linearly");
    refuses("M*v' + M*w' = F\n2*M*v' + 2*M*w' = F", 4, 1, "no solution for the rates");
    refuses("M*v' + m*v' = F\nM*v' = F", 4, 1, "singular whatever");
    refuses("M*v' = F", 8, 1, "the state 'w' has no equation");
    refuses("M*v' = F\nm*v' = F" + other, 5, 1, "one equation more than there are states");
    refuses("M*v' = F - b*v'" + other, 4, 10, "the unit on the left is N");
    refuses("M*v' = b" + other, 4, 8, "and what is on the left has");
    refuses("M*v' = F - m*z'" + other, 4, 14, "'z' is no state");
    refuses("M*v = F" + other, 4, 2, "'=' is missing");
    refuses("v' = v'" + other, 4, 1, "singular whatever");
}
