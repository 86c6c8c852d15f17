// SPDX-License-Identifier: MIT
// Tubes against reference trajectories of random members of the boxes.
#include <sivid/enclosure/tube.hpp>
#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"
#include "support/sampling.hpp"
#include "support/systems.hpp"

#include <cmath>
#include <limits>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::part_of;

namespace {

enclosure_options coarse(std::size_t order, std::size_t variational, double tolerance) {
    enclosure_options o;
    o.order = order;
    o.variational_order = variational;
    o.tolerance = tolerance;
    return o;
}

/// All systems with given options: complete where asked for, sampled over whatever was proved.
/// @returns how many tubes did not get beyond the first step
int sweep(std::uint64_t seed, enclosure_options const& options, double share, int members,
          bool complete) {
    draws d(seed);
    int none = 0;
    auto const check = [&](auto system, bool rough) {
        system.initial = part_of(d, system.initial, share);
        system.parameters = part_of(d, system.parameters, share);
        CAPTURE(system.name);
        auto const tube = integrate<interval>(system.flow(), system.initial, system.parameters, 0,
                                              system.horizon, options);
        if (complete) CHECK(tube.complete());
        none += tube.end_time() > 0 ? 0 : 1;
        support::check_tube(system, tube, d, members, 12, rough);
    };
    support::for_each_rough_system([&](auto const& system) { check(system, true); });
    support::for_each_smooth_system([&](auto const& system) { check(system, false); });
    return none;
}

} // namespace

TEST_CASE("the reference agrees with closed forms to its stated error") {
    auto const logistic = [](auto const&, auto const& x, auto const&, auto const&) {
        return support::extended_state{x[0] * (1 - x[0])};
    };
    auto const x = support::reference_states(logistic, {0.125L}, {}, 0, {1, 4});
    for (int k = 0; k < 2; ++k) {
        extended const t = k == 0 ? 1 : 4;
        extended const exact = 0.125L * std::exp(t) / (1 + 0.125L * (std::exp(t) - 1));
        CHECK(std::fabs(x[static_cast<std::size_t>(k)][0] - exact) < support::reference_error / 10);
    }
    auto const turn = [](auto const&, auto const& s, auto const&, auto const&) {
        return support::extended_state{s[1], -s[0]};
    };
    auto const y = support::reference_states(turn, {1, 0}, {}, 0, {10});
    CHECK(std::fabs(y[0][0] - std::cos(10.0L)) < support::reference_error / 10);
}

TEST_CASE("tubes of points contain the trajectory and are thin") {
    draws d(201);
    support::for_each_smooth_system([&](auto system) {
        system.initial = point_box(d.in(system.initial));
        system.parameters = point_box(d.in(system.parameters));
        CAPTURE(system.name);
        auto const tube = integrate<interval>(system.flow(), system.initial, system.parameters, 0,
                                              system.horizon);
        CHECK(tube.complete());
        CHECK(width(tube.at(system.horizon)) < (system.name == "Lorenz" ? 1e-7 : 1e-9));
        support::check_tube(system, tube, d, 1, 30);
    });
}

TEST_CASE("tubes of boxes contain the trajectories of their members") {
    CHECK(sweep(202, {}, 0.3, 6, true) == 0);
    CHECK(sweep(203, {}, 1, 6, false) == 0);
}

TEST_CASE("low orders and long steps: the Lagrange terms alone") {
    CHECK(sweep(204, coarse(2, 0, 1e-3), 0.2, 4, false) == 0);
    CHECK(sweep(205, coarse(3, 1, 1e-2), 0.2, 4, false) == 0);
    CHECK(sweep(206, coarse(1, 0, 1e-2), 0.2, 4, false) == 0);
    CHECK(sweep(207, coarse(4, 2, 1e-1), 0, 4, false) == 0);
    CHECK(sweep(208, coarse(14, 1, 1e-6), 0.5, 4, false) == 0);
}

TEST_CASE("Runge-Kutta methods") {
    for (auto const& method : {heun(), rk4()}) {
        auto options = coarse(14, 0, method.order == 2 ? 1e-5 : 1e-8);
        options.method = method;
        CHECK(sweep(209, options, 0.2, 3, false) == 0);
        options.order = 2; // below the method's own: for the other series only
        CHECK(sweep(210, options, 0, 2, false) == 0);
    }
}

TEST_CASE("tubes against samples, longer", "[.long]") {
    int none = 0; // the shortest step is too long for some orders and tolerances
    for (std::uint64_t seed = 2000; seed < 2030; ++seed) {
        draws d(seed);
        enclosure_options o = coarse(1 + d.below(16), d.below(5), std::pow(10, -d.uniform(1, 13)));
        o.relative_tolerance = std::pow(10, -d.uniform(1, 6));
        if (d.below(4) == 0) o.method = d.coin() ? heun() : rk4();
        none += sweep(seed, o, d.uniform(0, 1), 30, false);
    }
    CHECK(none < 10);
}

TEST_CASE("the derivative's remainder is not short: x' = a x at its ends") {
    // The centre's series is exact to 1e-13; with variational order 1 the set at the end rests on
    // J = 1 + h a W alone. Without the factor W the ends of the box would be lost.
    for (std::size_t const order : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
        for (double const a : {1.0, -1.0, 2.0}) {
            auto const f = support::flow_of(
                support::model_of({1, 0}, [a](auto const&, auto const& x, auto const&,
                                              auto const&) { return std::vector{a * x[0]}; }));
            auto options = coarse(16, order, 1e-13);
            options.maximum_step = 0.25;
            auto const tube = integrate<interval>(f, box{between(-1, 3)}, box{}, 0, 1, options);
            REQUIRE(tube.complete());
            CAPTURE(order, a);
            for (double const t : {0.1, 0.25, 0.3, 0.7, 1.0}) {
                extended const growth = std::exp(static_cast<extended>(a) * t);
                CHECK(support::encloses_reference(tube.at(t)[0], -growth));
                CHECK(support::encloses_reference(tube.at(t)[0], 3 * growth));
            }
        }
    }
    // The same for a parameter: x' = p, x' = p x.
    auto const f = support::flow_of(
        support::model_of({2, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] + 0 * x[0], p[0] * x[1]};
        }));
    auto options = coarse(16, 1, 1e-13);
    options.maximum_step = 0.25;
    auto const tube = integrate<interval>(f, box{interval(0.0), interval(1.0)}, box{between(-1, 1)},
                                          0, 1, options);
    REQUIRE(tube.complete());
    for (double const t : {0.2, 0.25, 0.9, 1.0}) {
        for (extended const p : {-1.0L, 1.0L}) {
            CHECK(support::encloses_reference(tube.at(t)[0], p * t));
            CHECK(support::encloses_reference(tube.at(t)[1], std::exp(p * t)));
        }
    }
}

TEST_CASE("dry friction: a mass comes to rest and stays there") {
    // x' = -p sign(x) + 1/4: slides to 0 in finite time, then rests (Filippov).
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{0.25 - p[0] * sign(x[0])};
        }));
    enclosure_options options;
    options.tolerance = 1e-4;
    options.minimum_step = 1e-4;
    for (double const start : {1.0, -1.0}) {
        auto const tube = integrate<interval>(f, box{support::around(start, 0.01)},
                                              box{between(0.99, 1.01)}, 0, 2, options);
        REQUIRE(tube.complete());
        for (double const p : {0.99, 1.0, 1.01}) {
            for (double const x0 : {start - 0.01, start, start + 0.01}) {
                for (double const t : {0.3, 0.7, 1.0, 1.25, 1.5, 2.0}) {
                    double const speed = start > 0 ? 0.25 - p : 0.25 + p;
                    double x = x0 + speed * t;
                    if (x * start < 0) x = 0;
                    CAPTURE(start, p, x0, t);
                    CHECK(support::encloses_reference(tube.at(t)[0], x, 1e-12));
                }
            }
        }
    }
}

TEST_CASE("a parameter on a jump of the equations") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{sign(p[0]) + 0 * x[0]};
        }));
    auto const tube = integrate<interval>(f, box{interval(0.0)}, box{between(-1, 2)}, 0, 1);
    for (double const t : {0.1, 0.5, 1.0}) {
        if (t > tube.end_time()) break;
        CHECK(contains(tube.at(t)[0], t));
        CHECK(contains(tube.at(t)[0], -t));
    }
}

TEST_CASE("outputs at a time: smooth, kinked, jumping, fed through, undefined") {
    draws d(211);
    auto const model = support::model_of(
        {2, 1, 1},
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * x[1] + 0 * u[0], -x[0]};
        },
        [](auto const& t, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[0] * x[1] + p[0], abs(x[0]) * t, sign(x[1]), u[0] + x[0],
                               max(x[0], x[1])};
        });
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        return support::extended_state{p[0] * x[1], -x[0]};
    };
    sampled_signal const input({0, 0.5, 1}, {1, -2, 3}, interpolation::hold);
    auto const f = support::flow_of(model, {input});
    box const start{between(0.9, 1.1), between(-0.1, 0.1)};
    box const p{between(0.9, 1.1)};
    auto const tube = integrate<interval>(f, start, p, 0, 2);
    REQUIRE(tube.complete());
    for (int member = 0; member < 40; ++member) {
        auto const x0 = d.in(start);
        auto const q = d.in(p);
        std::vector<double> times{0, 0.5, 1, d.uniform(1, 2), 2};
        auto const states =
            support::reference_states(rate, support::extend(x0), support::extend(q), 0, times);
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const y = tube.observe_at(times[k]);
            auto const& x = states[k];
            CAPTURE(member, times[k]);
            CHECK(support::encloses_reference(y[0], x[0] * x[1] + q[0]));
            CHECK(support::encloses_reference(y[1], std::fabs(x[0]) * times[k]));
            CHECK(support::encloses_reference(y[2], x[1] > 0 ? 1 : x[1] < 0 ? -1 : 0));
            // At a knot the sample itself is the input.
            CHECK(support::encloses_reference(y[3], input.approximate(times[k]) + x[0]));
            CHECK(support::encloses_reference(y[4], std::max(x[0], x[1])));
        }
    }
    auto const partial = support::flow_of(support::model_of(
        {1, 0},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{0 * x[0]}; },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{log(x[0])};
        }));
    auto const still = integrate<interval>(partial, box{between(-1, 1)}, box{}, 0, 1);
    CHECK(width(still.observe_at(1)[0]) == HUGE_VAL); // nothing is claimed
}

TEST_CASE("tubes refuse questions they cannot answer") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0])};
        }));
    box const one{interval(1.0)};
    auto const tube = integrate<interval>(f, one, one, 0, 1);
    CHECK(tube.begin_time() == 0);
    CHECK(tube.end_time() == 1);
    CHECK_THROWS_AS(tube.at(-0.1), std::out_of_range);
    CHECK_THROWS_AS(tube.at(1.1), std::out_of_range);
    CHECK_THROWS_AS(tube.at(std::numeric_limits<double>::quiet_NaN()), std::out_of_range);
    CHECK_THROWS_AS(tube.over(0.5, 1.5), std::out_of_range);
    CHECK_THROWS_AS(tube.over(1, 0), std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, one, one, 1, 0), std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, box{}, one, 0, 1), std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, one, box{interval(1.0), interval(1.0)}, 0, 1),
                    std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, box{interval_traits<interval>::empty()}, one, 0, 1),
                    std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, box{interval_traits<interval>::entire()}, one, 0, 1),
                    std::invalid_argument);
    CHECK_THROWS_AS(integrate<interval>(f, one, box{between(0, HUGE_VAL)}, 0, 1),
                    std::invalid_argument);
    enclosure_options none;
    none.order = 0;
    CHECK_THROWS_AS(integrate<interval>(f, one, one, 0, 1, none), std::invalid_argument);
    auto const empty = integrate<interval>(f, one, one, 1, 1);
    CHECK(empty.at(1)[0].lower() == 1);
    CHECK(empty.steps().empty());
}
