// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/simulate.hpp>

#include <sivid/approximate/simulate/odeint_stepping.hpp>

#include "support/catch.hpp"
#include "support/flow_simulation.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

TEST_CASE("simulations follow the reference, over knots of inputs too") {
    draws d(261);
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        support::flow_simulation const simulate(*f);
        auto const x0 = d.in(system.initial);
        auto const p = d.in(system.parameters);
        std::vector<double> times{0};
        for (int k = 1; k <= 6; ++k) times.push_back(system.horizon * k / 6);
        auto const found = simulate(x0, p, 0, times);
        auto const exact = support::reference_states(system.rate, support::extend(x0),
                                                     support::extend(p), 0, times, system.inputs);
        CAPTURE(system.name);
        CHECK(found.times == times);
        REQUIRE(found.states.size() == times.size());
        for (std::size_t k = 0; k < times.size(); ++k) {
            for (std::size_t i = 0; i < x0.size(); ++i) {
                CHECK(std::fabs(found.states[k][i] - exact[k][i]) <
                      2e-6 * (1 + std::fabs(exact[k][i])));
                CHECK(found.outputs[k][i] == found.states[k][i]);
            }
        }
    });
}

TEST_CASE("a held input has its new value at a knot") {
    auto const model = support::model_of(
        {1, 0, 1},
        [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{u[0] + 0 * x[0]};
        },
        [](auto const&, auto const&, auto const&, auto const& u) { return std::vector{u[0]}; });
    auto const f =
        support::flow_of(model, {sampled_signal({0, 1, 2}, {1, -2, 5}, interpolation::hold)});
    support::flow_simulation const simulate(*f);
    auto const found = simulate({0}, {}, 0, {0, 0.5, 1, 2, 3});
    double const outputs[] = {1, 1, -2, 5, 5};
    double const states[] = {0, 0.5, 1, -1, 4};
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(found.outputs[k][0] == outputs[k]);
        CHECK(std::abs(found.states[k][0] - states[k]) < 1e-8);
    }
}

TEST_CASE("a simulation that blows up ends") {
    auto const f = support::flow_of(
        support::model_of({1, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0])};
        }));
    support::flow_simulation const simulate(*f);
    double last = 0;
    try {
        last = simulate({1}, {}, 0, {0.5, 2}).states.back()[0];
    } catch (std::exception const&) {
        last = std::nan("");
    }
    CHECK_FALSE(std::isfinite(last));
}

TEST_CASE("a simulation that is told to stop says so") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 2}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{-x[0]};
        }));
    int asked = 0;
    auto const told = [&asked] { return ++asked < 100; };
    CHECK_THROWS_WITH(simulate(std::make_shared<approximate_model const>(f->model()), {}, {1}, {},
                               0, {1e6}, {1e-12, told}),
                      ContainsSubstring("told to stop"));
    CHECK(asked == 100);
}

TEST_CASE("a channel that is late is looked at where it left the model") {
    auto model = support::model_of({1, 1, 0}, [](auto const&, auto const& x, auto const&,
                                                 auto const&) { return std::vector{-x[0]}; });
    model.channel_delays = {{0, 0}};
    parameter_choice choice;
    choice.unknown = {"p0"};
    auto const found =
        simulate(std::make_shared<approximate_model const>(model, choice, std::vector<signal>{}),
                 {}, {1}, {0.25}, 0, {0.1, 1, 2});
    CHECK_THAT(found.outputs[0][0], WithinAbs(1, 1e-8)); // nothing is older than the start
    for (std::size_t k : {1u, 2u}) {
        CHECK_THAT(found.states[k][0], WithinAbs(std::exp(-found.times[k]), 1e-8));
        CHECK_THAT(found.outputs[k][0], WithinAbs(std::exp(0.25 - found.times[k]), 1e-8));
    }
}
