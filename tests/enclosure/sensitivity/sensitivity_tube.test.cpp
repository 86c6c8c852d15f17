// SPDX-License-Identifier: MIT
// Certified sensitivities of tubes: closed forms, and the variational equation in extended
// precision for random members of the boxes.
#include <sivid/enclosure/sensitivity/sensitivity_tube.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/systems.hpp"
#include "support/variational_reference.hpp"

#include <sivid/enclosure/runge_kutta/implicit_tableau.hpp>
#if defined(SIVID_HAS_MPFI)
#include <sivid/number/mp_functions.hpp>
#endif

#include <cmath>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::part_of;

namespace {

enclosure_options sharp(std::size_t order) {
    enclosure_options o;
    o.order = o.variational_order = order;
    return o;
}

double widest(interval_matrix<interval> const& a) {
    double w = 0;
    for (std::size_t i = 0; i < a.rows(); ++i) {
        for (std::size_t c = 0; c < a.cols(); ++c) w = std::max(w, width(a(i, c)));
    }
    return w;
}

/// Random members, at random times and over random spans.
template <class System>
void check(System const& system, sensitivity_tube<interval> const& tube, draws& d, int members,
           double error, bool kinks = false) {
    double const end = tube.states().end_time();
    for (int member = 0; member < members; ++member) {
        auto const x0 = support::extend(d.in(system.initial));
        auto const p = support::extend(d.in(system.parameters));
        std::vector<double> times{0, d.uniform(0, end), d.uniform(0, end), end};
        if (!tube.states().steps().empty()) times.push_back(tube.states().steps().front().to);
        std::sort(times.begin(), times.end());
        auto const exact = support::reference_sensitivities(system.rate, x0, p, 0, times,
                                                            system.inputs, error * 1e-3L, kinks);
        auto const a = d.below(times.size());
        auto const b = a + d.below(times.size() - a);
        auto const over = tube.over(times[a], times[b]);
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const at = tube.at(times[k]);
            auto const seen = tube.observe_at(times[k]);
            for (std::size_t i = 0; i < at.rows(); ++i) {
                for (std::size_t c = 0; c < at.cols(); ++c) {
                    CAPTURE(system.name, times[k], i, c, static_cast<double>(exact[k].s[i][c]),
                            at(i, c).lower(), at(i, c).upper());
                    REQUIRE(support::encloses_reference(at(i, c), exact[k].s[i][c], error));
                    // Every state is a channel here.
                    REQUIRE(support::encloses_reference(seen(i, c), exact[k].s[i][c], error));
                    if (k >= a && k <= b)
                        REQUIRE(support::encloses_reference(over(i, c), exact[k].s[i][c], error));
                }
            }
        }
    }
}

void sweep_smooth(std::uint64_t seed, enclosure_options const& options, double share, int members) {
    draws d(seed);
    int stuck = 0;
    support::for_each_smooth_system([&](auto system) {
        system.initial = part_of(d, system.initial, share);
        system.parameters = part_of(d, system.parameters, share);
        auto const tube = integrate_with_sensitivities<interval>(
            system.flow(), system.initial, system.parameters, 0, system.horizon, options);
        if (tube.states().end_time() == 0) {
            ++stuck; // low orders cannot enclose every one of them
            return;
        }
        check(system, tube, d, members, 1e-13);
    });
    CHECK(stuck <= 1);
}

} // namespace

TEST_CASE("growth and oscillation by closed forms") {
    // x' = p x: dx/dx0 = e^(pt), dx/dp = x0 t e^(pt).
    auto const growth = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0]};
        }));
    auto const tube = integrate_with_sensitivities<interval>(growth, box{interval(1.5)},
                                                             box{interval(0.75)}, 0, 2, sharp(14));
    REQUIRE(tube.states().complete());
    for (double const t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
        auto const s = tube.at(t);
        extended const e = std::exp(0.75L * t);
        CHECK(support::encloses_reference(s(0, 0), e, 1e-17));
        CHECK(support::encloses_reference(s(0, 1), 1.5L * t * e, 1e-17));
        CHECK(widest(s) < 5e-12);
    }
    // x'' = -w^2 x as x' = w y, y' = -w x: a rotation by w t.
    auto const turn = support::flow_of(
        support::model_of({2, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[1], -(p[0] * x[0])};
        }));
    auto const spin = integrate_with_sensitivities<interval>(
        turn, box{interval(1.0), interval(0.0)}, box{interval(2.0)}, 0, 10, sharp(16));
    auto const s = spin.at(10);
    extended const c = std::cos(20.0L), z = std::sin(20.0L);
    CHECK(support::encloses_reference(s(0, 0), c, 1e-17));
    CHECK(support::encloses_reference(s(0, 1), z, 1e-17));
    CHECK(support::encloses_reference(s(1, 0), -z, 1e-17));
    CHECK(support::encloses_reference(s(0, 2), -10 * z, 1e-17));
    CHECK(support::encloses_reference(s(1, 2), -10 * c, 1e-17));
    CHECK(widest(s) < 1e-10);
}

TEST_CASE("points: the sensitivities are thin, and right at small orders too") {
    draws d(301);
    support::for_each_smooth_system([&](auto system) {
        system.initial = point_box(d.in(system.initial));
        system.parameters = point_box(d.in(system.parameters));
        CAPTURE(system.name);
        auto const tube = integrate_with_sensitivities<interval>(
            system.flow(), system.initial, system.parameters, 0, system.horizon, sharp(14));
        REQUIRE(tube.states().complete());
        auto const s = tube.at(system.horizon);
        double size = 1;
        for (std::size_t i = 0; i < s.rows(); ++i) {
            for (std::size_t c = 0; c < s.cols(); ++c) size = std::max(size, mag(s(i, c)));
        }
        CHECK(widest(s) < 1e-8 * size);
        check(system, tube, d, 1, 1e-13);
    });
}

TEST_CASE("boxes, at orders from 2 up: every member's sensitivities are enclosed") {
    auto o = sharp(14);
    sweep_smooth(302, o, 0.2, 3);
    // Lagrange terms that matter.
    o.order = 3;
    o.variational_order = 2;
    o.tolerance = 1e-3;
    o.minimum_step = 1e-4;
    sweep_smooth(303, o, 0.1, 3);
    o.order = 2;
    o.variational_order = 1;
    sweep_smooth(304, o, 0, 3);
    sweep_smooth(305, {}, 1, 2);
}

TEST_CASE("Runge-Kutta, explicit and implicit, and steps that are long against time constants") {
    for (auto const& method : {rk4(), radau_iia5()}) {
        enclosure_options o;
        o.method = method;
        o.tolerance = 1e-8;
        sweep_smooth(306, o, 0.05, 2);
    }
}

TEST_CASE("kinks and sampled inputs") {
    draws d(307);
    support::for_each_rough_system([&](auto system) {
        system.initial = part_of(d, system.initial, 0.3);
        system.parameters = part_of(d, system.parameters, 0.3);
        auto const tube = integrate_with_sensitivities<interval>(
            system.flow(), system.initial, system.parameters, 0, system.horizon, sharp(10));
        CAPTURE(system.name);
        REQUIRE(tube.states().end_time() > 0);
        check(system, tube, d, 3, 1e-8, true);
    });
}

TEST_CASE("across a jump there is no derivative, and none is claimed") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * sign(x[0]))};
        }));
    auto const tube =
        integrate_with_sensitivities<interval>(f, box{interval(0.5)}, box{interval(1.0)}, 0, 1);
    CHECK(tube.at(0.25)(0, 0).lower() == 1);
    CHECK(support::encloses_reference(tube.at(0.25)(0, 1), -0.25L));
    REQUIRE(tube.states().end_time() > 0.5);
    CHECK(std::isinf(width(tube.at(tube.states().end_time())(0, 0))));
    CHECK(std::isinf(width(tube.over(0, tube.states().end_time())(0, 1))));
}

TEST_CASE("outputs by states, parameters and inputs") {
    // y0 = p x^2, y1 = |x - 1| + u, y2 = 1/(x - 2)
    auto const m = support::model_of(
        {1, 1, 1},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{x[0]}; },
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * sqr(x[0]), abs(x[0] - 1) + u[0], 1 / (x[0] - 2)};
        });
    auto const f = support::flow_of(m, {sampled_signal({0, 2}, {0, 3}, interpolation::linear)});
    auto options = sharp(12);
    options.relative_tolerance = 0;
    auto const tube = integrate_with_sensitivities<interval>(f, box{between(0.5, 0.625)},
                                                             box{interval(3.0)}, 0, 1, options);
    auto const y = tube.observe_at(1);
    extended const e = std::exp(1.0L);
    for (extended const x0 : {0.5L, 0.6L, 0.625L}) {
        CHECK(support::encloses_reference(y(0, 0), 6 * x0 * e * e));
        CHECK(support::encloses_reference(y(0, 1), x0 * x0 * e * e));
        CHECK(support::encloses_reference(y(1, 0), e));
        CHECK(support::encloses_reference(y(2, 0), -e / ((x0 * e - 2) * (x0 * e - 2))));
    }
    CHECK(width(y(1, 0)) < 1e-9);
    CHECK(mag(y(1, 1)) == 0);
    // x = 1 within the set: Clarke's derivative of the kink; x = 2 outside it.
    auto const kink = tube.observe_at(0.6);
    CHECK(kink(1, 0).lower() <= -std::exp(0.6));
    CHECK(kink(1, 0).upper() >= std::exp(0.6));
}

TEST_CASE("times outside, and a failure on the way") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0])};
        }));
    auto const tube =
        integrate_with_sensitivities<interval>(f, box{interval(1.0)}, box{}, 0, 2, sharp(14));
    REQUIRE_FALSE(tube.states().complete());
    double const end = tube.states().end_time();
    CHECK(end > 0.9);
    CHECK_THROWS_AS(tube.at(1), std::out_of_range);
    CHECK_THROWS_AS(tube.over(0.5, 0.25), std::invalid_argument);
    // x = 1/(1 - t): dx/dx0 = x^2
    auto const t = 0.5 * end;
    CHECK(
        support::encloses_reference(tube.at(t)(0, 0), 1 / ((1 - extended(t)) * (1 - extended(t)))));
}

#if defined(SIVID_HAS_MPFI)
TEST_CASE("the proven type gives the same") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * sin(x[0])};
        }));
    box const x0{between(0.5, 0.51)}, p{between(0.9, 0.91)};
    basic_box<proven_interval> y0(1), q(1);
    y0[0] = interval_traits<proven_interval>::bounds(0.5, 0.51);
    q[0] = interval_traits<proven_interval>::bounds(0.9, 0.91);
    auto const fast = integrate_with_sensitivities<interval>(f, x0, p, 0, 1, sharp(10)).at(0.75);
    auto const proven =
        integrate_with_sensitivities<proven_interval>(f, y0, q, 0, 1, sharp(10)).at(0.75);
    using traits = interval_traits<proven_interval>;
    for (std::size_t c = 0; c < 2; ++c) {
        CHECK_THAT(traits::lower(proven(0, c)), WithinRel(fast(0, c).lower(), 1e-12));
        CHECK_THAT(traits::upper(proven(0, c)), WithinRel(fast(0, c).upper(), 1e-12));
    }
}
#endif
