// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/approximate_simulator.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

namespace {

/// A damped swing with an input, a late channel and a late input.
struct swing {
    recorded_model model = [] {
        auto m = support::model_of(
            {2, 4, 1},
            [](auto const&, auto const& x, auto const& p, auto const& u) {
                return std::vector{x[1],
                                   -(p[0] * sin(x[0])) - p[1] * abs(x[1]) * x[1] + u[0] * u[0]};
            },
            [](auto const& t, auto const& x, auto const&, auto const& u) {
                return std::vector{x[0], x[0] * x[1] + 0.1 * t * u[0]};
            });
        m.input_memory = {{0, 2}};
        m.channel_delays = {{0, 3}};
        return m;
    }();
    std::vector<output_request> requests;
    sensitivity_layout layout;
    std::vector<double> knots{0, 0.4, 1, 3};

    explicit swing(memory_kind kind = memory_kind::delay) {
        model.input_memory[0].kind = kind;
        if (kind == memory_kind::drift) model.channel_delays[0].kind = kind;
        for (int k = 1; k <= 20; ++k) {
            requests.push_back({0.15 * k, 0});
            requests.push_back({0.15 * k, 1});
        }
        layout.parameter_column = {0, 1, 2, 3};
        layout.start_column = {4, 5};
        layout.disturbed = {1};
        layout.first_disturbance = 6;
        layout.columns = 6 + knots.size();
    }
    [[nodiscard]] approximate_simulator simulator(signal const& u) const {
        parameter_choice choice;
        choice.unknown = {"p0", "p1", "p2", "p3"};
        auto const plain = std::make_shared<approximate_model const>(model, choice, std::vector{u});
        return {plain, {u}, 0, requests, {1e-7, 1e-7}, knots};
    }
};

void check_against_differences(signal const& u, double tolerance,
                               memory_kind kind = memory_kind::delay) {
    swing const s(kind);
    auto run = s.simulator(u);
    run.set_accuracy(1e-3);
    std::vector<double> p{2, 0.3, 0.33, 0.21}, x0{0.7, -0.2}, d{0.1, -0.2, 0.3, 0.1};
    simulated_outputs out;
    REQUIRE(run(x0, p, d, s.layout, true, out));
    auto const shifted = [&](std::size_t c, double h) {
        auto q = p, x = x0, e = d;
        (c < 4 ? q[c] : c < 6 ? x[c - 4] : e[c - 6]) += h;
        simulated_outputs y;
        REQUIRE(run(x, q, e, s.layout, false, y));
        return y.values;
    };
    for (std::size_t c = 0; c < s.layout.columns; ++c) {
        double const h = 1e-4;
        auto const up = shifted(c, h);
        auto const down = shifted(c, -h);
        for (std::size_t k = 0; k < up.size(); ++k) {
            CAPTURE(c, k);
            double const difference = (up[k] - down[k]) / (2 * h);
            CHECK(std::abs(out.jacobian[k * s.layout.columns + c] - difference) < tolerance);
        }
    }
}

} // namespace

TEST_CASE("plain simulations follow the reference, over knots of inputs too") {
    draws d(261);
    support::for_each_system([&](auto const& system) {
        std::vector<signal> const inputs(system.inputs.begin(), system.inputs.end());
        parameter_choice choice;
        choice.unknown = support::all_constants(system.sizes.constants);
        auto const plain = std::make_shared<approximate_model const>(
            support::model_of(system.sizes, system.rate), choice, inputs);
        auto const x0 = d.in(system.initial);
        auto const p = d.in(system.parameters);
        std::vector<double> times;
        std::vector<output_request> requests;
        for (int k = 1; k <= 6; ++k) {
            times.push_back(system.horizon * k / 6);
            for (std::size_t i = 0; i < x0.size(); ++i) requests.push_back({times.back(), i});
        }
        sensitivity_layout layout;
        layout.parameter_column.assign(p.size(), sensitivity_layout::none);
        layout.start_column.assign(x0.size(), sensitivity_layout::none);
        approximate_simulator run(plain, inputs, 0, requests, std::vector<double>(x0.size(), 1e-6));
        simulated_outputs out;
        REQUIRE(run(x0, p, {}, layout, false, out));
        auto const exact = support::reference_states(system.rate, support::extend(x0),
                                                     support::extend(p), 0, times, system.inputs);
        CAPTURE(system.name);
        for (std::size_t k = 0; k < requests.size(); ++k) {
            auto const y = exact[k / x0.size()][k % x0.size()];
            CHECK(std::fabs(out.values[k] - y) < 1e-4 * (1 + std::fabs(y)));
        }
    });
}

TEST_CASE("sensitivities agree with differences: parameters, delays, starts, disturbances") {
    sampled_signal const linear({0, 0.5, 1, 2, 3}, {0.2, 1, 0.4, 0.9, 0.1}, interpolation::linear);
    check_against_differences(linear, 2e-4);
    check_against_differences(analytic_signal::from([](auto const& t) { return 0.5 + sin(2 * t); }),
                              2e-2);
    // No gap closes just when an output is looked at: there its slope jumps.
    sampled_signal const falling({0, 0.5, 1, 2, 3}, {0.2, 1, 0.4, 0.9, 0}, interpolation::linear);
    check_against_differences(falling, 2e-4, memory_kind::play);
    check_against_differences(linear, 4e-4, memory_kind::drift);
    // Behind at first, met in the midst of a piece, left behind again.
    check_against_differences(falling, 2e-4, memory_kind::rate_limit);
}

TEST_CASE("a late hold input moves its jumps") {
    sampled_signal const held({0, 0.5, 1, 2}, {0.2, 1, 0.4, 0.9}, interpolation::hold);
    check_against_differences(held, 2e-3);
    check_against_differences(held, 2e-3, memory_kind::play);
    check_against_differences(held, 4e-3, memory_kind::drift);
    check_against_differences(held, 2e-4, memory_kind::rate_limit);
}

TEST_CASE("a stiff phase is stepped stably and a blow-up is reported") {
    auto const stiff =
        support::model_of({1, 1}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * (cos(t) - x[0])};
        });
    parameter_choice choice;
    choice.unknown = {"p0"};
    sensitivity_layout layout;
    layout.parameter_column = {0};
    layout.start_column = {sensitivity_layout::none};
    layout.columns = 1;
    simulated_outputs out;
    approximate_simulator run(
        std::make_shared<approximate_model const>(stiff, choice, std::vector<signal>{}), {}, 0,
        {{1, 0}}, {1e-5});
    REQUIRE(run({0}, {2000}, {}, layout, true, out));
    CHECK_THAT(out.values[0], WithinAbs(std::cos(1.0), 1e-3));
    CHECK(std::abs(out.jacobian[0]) < 1e-3);
    auto const blow =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]};
        });
    approximate_simulator burst(
        std::make_shared<approximate_model const>(blow, choice, std::vector<signal>{}), {}, 0,
        {{1, 0}}, {1e-5});
    CHECK_FALSE(burst({1}, {5}, {}, layout, true, out));
}
