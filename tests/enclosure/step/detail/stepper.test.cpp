// SPDX-License-Identifier: MIT
// One proved step, its parts taken one by one: a-priori enclosure, derivative bound, set inside the
// step, with all kinds of orders.
#include <sivid/enclosure/step/detail/stepper.hpp>
#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

TEST_CASE("a proved step holds its trajectories in the tube, in the swept box and at any time") {
    draws d(281);
    int steps = 0;
    for (std::size_t const order :
         {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{6}, std::size_t{14}}) {
        for (std::size_t const variational : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
            support::for_each_system([&](auto const& system) {
                auto const f = system.flow();
                enclosure_options options;
                options.order = order;
                options.variational_order = variational;
                options.tolerance = std::pow(10, -d.uniform(1, 8));
                options.relative_tolerance = 0.1;
                ensemble<interval> const e(system.initial, system.parameters);
                stepper<interval> prover(*f, options);
                prover.set_ensemble(e);
                auto const set = doubleton<interval>::start(0, system.initial, f->parameters());
                enclosure_failure why;
                auto const limit = std::min(system.horizon, f->next_knot(0));
                auto const step = prover.prove(set, limit, why);
                if (!step) {
                    CHECK_FALSE(why.message("x").empty());
                    return;
                }
                ++steps;
                CHECK(step->from == 0);
                CHECK(step->to > 0);
                CHECK(step->to <= limit);
                auto const end = prover.finish(*step);
                CHECK(end.time == step->to);
                double const inside = d.uniform(0, step->to);
                auto const middle = prover.advance(*step, inside);
                CHECK(subset(end.hull, step->tube));
                for (int member = 0; member < 4; ++member) {
                    auto const x0 = d.in(system.initial);
                    auto const p = d.in(system.parameters);
                    std::vector<double> times;
                    for (int k = 0; k <= 8; ++k) times.push_back(step->to * k / 8);
                    auto const dense =
                        support::reference_states(system.rate, support::extend(x0),
                                                  support::extend(p), 0, times, system.inputs);
                    auto const at = support::reference_states(system.rate, support::extend(x0),
                                                              support::extend(p), 0,
                                                              {inside, step->to}, system.inputs);
                    for (std::size_t i = 0; i < x0.size(); ++i) {
                        CAPTURE(system.name, order, variational, i, step->to);
                        for (auto const& x : dense) {
                            CHECK(support::encloses_reference(step->tube[i], x[i]));
                            CHECK(support::encloses_reference(step->swept[i], x[i]));
                        }
                        CHECK(support::encloses_reference(middle.hull[i], at[0][i]));
                        CHECK(support::encloses_reference(end.hull[i], at[1][i]));
                    }
                }
            });
        }
    }
    CHECK(steps > 100);
}

TEST_CASE("advancing to the end is what finishing gave") {
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        ensemble<interval> const e(system.initial, system.parameters);
        stepper<interval> prover(*f, {});
        prover.set_ensemble(e);
        enclosure_failure why;
        auto const set = doubleton<interval>::start(0, system.initial, f->parameters());
        auto const step = prover.prove(set, 0.5, why);
        REQUIRE(step);
        auto const a = prover.finish(*step);
        auto const b = prover.advance(*step, step->to);
        for (std::size_t i = 0; i < a.hull.size(); ++i) {
            CHECK(a.hull[i].lower() == b.hull[i].lower());
            CHECK(a.hull[i].upper() == b.hull[i].upper());
        }
    });
}

TEST_CASE("orders that mean nothing are refused") {
    auto const f =
        support::flow_of(support::model_of({1, 0}, [](auto const&, auto const& x, auto const&,
                                                      auto const&) { return std::vector{x[0]}; }));
    enclosure_options none;
    none.order = 0;
    CHECK_THROWS_AS(stepper<interval>(*f, none), std::invalid_argument);
    enclosure_options low;
    low.order = 2;
    low.method = rk4(); // needs coefficients beyond the stated order
    CHECK_NOTHROW(stepper<interval>(*f, low));
}
