// SPDX-License-Identifier: MIT
#include <sivid/decision/motion/detail/cell_bounds.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace decision_support;
using sivid::interval;

TEST_CASE("outputs between two instants: contained, and close in the second order") {
    auto const p = oscillator(between(1.5, 1.6), 2);
    sivid::flow const f(p.model, p.choice, p.inputs);
    sivid::cell_bounds cells(f);
    cells.set_parameters(p.sets[0]);
    support::draws d{5};
    double excess[2];
    for (int n = 0; n < 2; ++n) {
        double const from = 0.7, h = n == 0 ? 0.1 : 0.05, to = from + h;
        auto const at = [](double t) {
            return sivid::box{between(std::cos(1.6 * t), std::cos(1.5 * t)),
                              between(-1.6 * std::sin(1.6 * t), -1.5 * std::sin(1.5 * t))};
        };
        auto const courses = cells(from, to, at(from), at(to));
        REQUIRE(courses.has_value());
        auto const range =
            sivid::cell_bounds::between((*courses)[0], from, to, at(from)[0], at(to)[0]);
        for (int k = 0; k < 500; ++k) {
            double const w = d.in(between(1.5, 1.6)), t = d.uniform(from, to);
            CHECK(contains(range, std::cos(w * t)));
        }
        excess[n] = range.upper() - at(from)[0].upper() + at(to)[0].lower() - range.lower();
    }
    CHECK(excess[0] < 0.01);
    CHECK(excess[1] < 0.35 * excess[0] + 1e-12);
}

TEST_CASE("outputs at one instant are those of the states, exactly where these are") {
    auto const p = oscillator(between(1.5, 1.6), 2);
    sivid::flow const f(p.model, p.choice, p.inputs);
    sivid::cell_bounds cells(f);
    cells.set_parameters(p.sets[0]);
    auto const y = cells.at(0, {interval(1.0), between(0, 0.25)});
    REQUIRE(y.size() == f.channels());
    CHECK(y[0].lower() == 1);
    CHECK(y[0].upper() == 1);
    if (y.size() > 1) CHECK(y[1].upper() == 0.25);
}

TEST_CASE("a single motion that turns within the cell") {
    auto const p = oscillator(interval(2.0), 2);
    sivid::flow const f(p.model, p.choice, p.inputs);
    sivid::cell_bounds cells(f);
    cells.set_parameters(p.sets[0]);
    double const from = 1.5, to = 1.65; // least at pi / 2
    auto const at = [](double t) {
        return sivid::box{support::around(std::cos(2 * t), 1e-15),
                          support::around(-2 * std::sin(2 * t), 1e-15)};
    };
    auto const courses = cells(from, to, at(from), at(to));
    REQUIRE(courses.has_value());
    auto const range = sivid::cell_bounds::between((*courses)[0], from, to, at(from)[0], at(to)[0]);
    CHECK(range.lower() <= -1);
    CHECK(range.lower() > -1.02);
}

TEST_CASE("kinks and jumps leave what holds without derivatives") {
    auto const m = support::model_of(
        {.states = 1},
        [](auto const&, auto const&, auto const&, auto const&) {
            return std::vector{sivid::expression(1.0)};
        },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{abs(x[0]), sign(x[0]), x[0] * x[0]};
        });
    sivid::flow const f(m, {}, {});
    sivid::cell_bounds cells(f);
    cells.set_parameters(sivid::box{});
    auto const courses = cells(0, 0.2, sivid::box{interval(-0.1)}, sivid::box{interval(0.1)});
    REQUIRE(courses.has_value());
    auto const over = [&](std::size_t y, double a, double b) {
        return sivid::cell_bounds::between((*courses)[y], 0, 0.2, interval(a), interval(b));
    };
    CHECK(over(0, 0.1, 0.1).lower() <= 0);
    CHECK(over(0, 0.1, 0.1).upper() >= 0.1);
    CHECK(over(1, -1, 1).lower() <= -1);
    CHECK(over(1, -1, 1).upper() >= 1);
    CHECK(over(2, 0.01, 0.01).lower() <= 0);
}

TEST_CASE("a held input that changes at the end of the cell does not bind what comes before") {
    auto const m = support::model_of(
        {.states = 1, .inputs = 1},
        [](auto const&, auto const&, auto const&, auto const& u) { return std::vector{u[0]}; },
        [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{x[0], u[0]};
        });
    sivid::flow const f(m, {}, {sivid::sampled_signal({0, 1}, {1, 5}, sivid::interpolation::hold)});
    sivid::cell_bounds cells(f);
    cells.set_parameters(sivid::box{});
    auto const courses = cells(0, 1, sivid::box{interval(0.0)}, sivid::box{interval(1.0)});
    REQUIRE(courses.has_value());
    CHECK_FALSE((*courses)[0].jumps_at_end);
    REQUIRE((*courses)[1].jumps_at_end);
    auto const u = sivid::cell_bounds::between((*courses)[1], 0, 1, interval(1.0), interval(5.0));
    CHECK(u.lower() == 1);
    CHECK(u.upper() == 1);
}

TEST_CASE("a cell that is too long is said to be") {
    auto const p = explosion(between(0.9, 1.1), 2);
    sivid::flow const f(p.model, p.choice, p.inputs);
    sivid::cell_bounds cells(f);
    cells.set_parameters(p.sets[0]);
    CHECK_FALSE(cells(0, 2, sivid::box{interval(1.0)}, sivid::box{interval(1.0)}).has_value());
    CHECK(cells(0, 0.1, sivid::box{interval(1.0)}, sivid::box{between(1.09, 1.13)}).has_value());
}

TEST_CASE("uncertain inputs widen what lies between") {
    auto const m = support::model_of(
        {.states = 1, .inputs = 1},
        [](auto const&, auto const&, auto const&, auto const& u) { return std::vector{u[0]}; },
        [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{x[0], u[0]};
        });
    sivid::flow const f(
        m, {}, {sivid::sampled_signal({0, 1}, {1, 1}, sivid::interpolation::linear, {0.5, 0.5})});
    sivid::cell_bounds cells(f);
    cells.set_parameters(sivid::box{});
    auto const courses = cells(0, 1, sivid::box{interval(0.0)}, sivid::box{between(0.5, 1.5)});
    REQUIRE(courses.has_value());
    CHECK((*courses)[0].direct.upper() >= 1.5);
    CHECK((*courses)[1].direct.lower() <= 0.5);
    CHECK((*courses)[1].direct.upper() >= 1.5);
}
