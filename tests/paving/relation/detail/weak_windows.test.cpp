// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/declared_variation.hpp>
#include <sivid/paving/relation/detail/weak_windows.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

using namespace diagnosis_support;

TEST_CASE("the bump and its derivatives") {
    CHECK(equal(bump::value(between(0, 1)), between(0, 1)));
    CHECK(contains(bump::value(between(0.5, 0.5)), 1));
    CHECK(contains(bump::slope(between(0, 0)), 0));
    CHECK(contains(bump::slope(between(1, 1)), 0));
    CHECK(contains(bump::curvature(between(0, 0)), 32));
    CHECK(contains(bump::integral(between(0, 0)), 0));
    CHECK_THAT(mid(bump::integral(between(1, 1))), WithinAbs(8.0 / 15, 1e-12));
    double const s = 0.3, h = 1e-6;
    auto const w = [](double t) { return 16 * t * t * (1 - t) * (1 - t); };
    CHECK_THAT(mid(bump::value(between(s, s))), WithinAbs(w(s), 1e-12));
    CHECK_THAT(mid(bump::integral(between(s + h, s + h)) - bump::integral(between(s, s))) / h,
               WithinAbs(w(s), 1e-5));
    CHECK_THAT(mid(bump::slope(between(s, s))), WithinAbs((w(s + h) - w(s - h)) / (2 * h), 1e-6));
    CHECK_THAT(mid(bump::curvature(between(s, s))),
               WithinAbs((w(s + h) - 2 * w(s) + w(s - h)) / (h * h), 1e-2));
}

TEST_CASE("the ramp and its derivative") {
    CHECK(contains(ramp::value(between(0.3, 0.3)), 0.7));
    CHECK(equal(ramp::slope(between(0, 1)), between(-1, -1)));
    CHECK(equal(ramp::curvature(between(0, 1)), between(0, 0)));
    CHECK(contains(ramp::integral(between(0.3, 0.3)), 0.3 - 0.045));
    CHECK(equal(ramp::integral(between(1, 1)), ramp::whole()));
}

TEST_CASE("what is open on the average may lie where the weight is largest") {
    // The weight is -2 for a hundredth of the cell and 1 else; what is off by 1 in the mean is all
    // in that hundredth, the rest lies at 3 everywhere.
    weak_windows::straight line;
    line.beside = between(0, 3);
    line.off = 1;
    double const mean = 0.01 * -2 * (3 - 100) + 0.99 * 1 * 3;
    CHECK(mean > 4.9); // 4 is the greatest product of the ranges of weight and sum
    CHECK(contains(line.times(between(-2, 1)), mean));
    line.off = HUGE_VAL;
    CHECK_FALSE(is_bounded(line.times(between(-2, 1))));
}

namespace {

/// A linear pendulum whose rate x1 is not measured.
struct bench {
    recorded_model model = support::model_of(
        {2, 2, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[1], u[0] - p[0] * sin(x[0]) - p[1] * x[1] - 0.5 * x[1]};
        });
    bound_model bound =
        bind(model, {{"p0", "p1"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    box prior{between(0, 10), between(0, 1)};
    relation_row row = make_relation_row(bound.g, bound.rate[1], 1, prior);
    integrand_set set = integrand_set::of(bound.g, row.functions, 2, 0);
};

} // namespace

TEST_CASE("windows under a bump contain the truth without the rate's measurements") {
    draws d(22);
    bench b;
    auto const weak = weak_windows::of(b.bound.g, b.set, {1, 0});
    REQUIRE(weak);
    for (int n = 0; n < 20; ++n) {
        std::vector<double> const p{d.uniform(1, 9), d.uniform(0, 1)};
        std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), 2, 4)};
        auto const truth = simulate(b.model, p, inputs, {d.uniform(-1, 1), 0}, 4);
        auto const e = measured(d, "S", truth, inputs, {0}, 0.02, static_cast<noise>(n % 4));
        auto const channels = measured_states(b.bound, {&e});
        auto const law =
            declare_variations(b.bound, {find_rate_scales(b.bound, b.prior, e, channels)}, {});
        auto const motion = observe_motion(b.bound, b.prior, e, channels, {law.front(), {}, {}}, 4);
        auto const windows = weak->over(motion, 0, 0.5, 4);
        CHECK(windows.size() > 20);
        for (auto const& w : windows) {
            auto sum = w.a.back();
            for (std::size_t j = 0; j < 2; ++j) {
                bool const first = b.row.theta[j] ==
                                   parameter_product{{b.bound.g.leaf(operation::constant, 0), 1}};
                sum = sum + w.a[j] * (first ? p[0] : p[1]);
            }
            CHECK_FALSE(disjoint(sum, w.difference));
            CHECK(contains(missing_rate_in(b.row, w), 0));
            CHECK_THAT(mid(w.length), WithinAbs(8.0 / 15 * (w.to - w.from), 1e-9));
        }
        // A rate that was left out shows: demand 1 more than there is.
        bool shows = false;
        for (auto const& w : windows) {
            auto sum = w.a.back() + w.length;
            for (std::size_t j = 0; j < 2; ++j) {
                bool const first = b.row.theta[j] ==
                                   parameter_product{{b.bound.g.leaf(operation::constant, 0), 1}};
                sum = sum + w.a[j] * (first ? p[0] : p[1]);
            }
            shows = shows || disjoint(sum, w.difference);
        }
        CHECK(shows);
    }
}

TEST_CASE("functions that are not affine in the rate have no weak form") {
    auto const m = support::model_of({2, 1, 0, 20},
                                     [](auto const&, auto const& x, auto const& p, auto const&) {
                                         return std::vector{x[1], -(p[0] * abs(x[1]) * x[1])};
                                     });
    auto bound = bind(m, {{"p0"}, {}}, {});
    auto const row = make_relation_row(bound.g, bound.rate[1], 1, box{between(0, 1)});
    auto const set = integrand_set::of(bound.g, row.functions, 2, 0);
    CHECK_FALSE(weak_windows::of(bound.g, set, {1, 0}));
    CHECK(weak_windows::of(bound.g, set, {1, 0}, {}, true)); // unless it is known otherwise
}

TEST_CASE("windows from a known start contain the truth, whatever the rate stands in") {
    // x1' = p0 u - p1 x1 - p2 |x1| - p3 x1/sqrt(x1^2 + 0.05^2) - p4 max(x1, 0.3)
    auto const m = support::model_of(
        {2, 5, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            auto const direction = x[1] / sqrt(sqr(x[1]) + sqr(expression(0.05)));
            return std::vector{x[1], p[0] * u[0] - p[1] * x[1] - p[2] * abs(x[1]) -
                                         p[3] * direction - p[4] * max(x[1], 0.3)};
        });
    auto bound = bind(m, {support::all_constants(5), {}},
                      {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    box const prior{between(0.5, 2), between(0, 1), between(-0.4, 0.4), between(0, 0.5),
                    between(-0.3, 0.3)};
    auto const row = make_relation_row(bound.g, bound.rate[1], 1, prior);
    auto const set = integrand_set::of(bound.g, row.functions, 2, 1);
    auto const weak = weak_windows::of(bound.g, set, {1, 0}, {{1, 0}}, true);
    REQUIRE(weak);
    draws d(24);
    std::size_t sharp = 0, all = 0;
    auto const count = support::swept(std::size_t{24}, std::size_t{2000});
    for (std::size_t n = 0; n < count; ++n) {
        auto const p = d.in(prior);
        std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), d.uniform(1, 5), 2)};
        std::vector<double> const start{d.uniform(-1, 1), d.uniform(-1, 1)};
        auto const truth = simulate(m, p, inputs, start, 2, 0.001);
        double const error = d.coin() ? 0.001 : 0.02;
        auto e = measured(d, "S", truth, inputs, {0}, error, static_cast<noise>(n % 4));
        for (std::size_t i = 0; d.coin() && i < 2; ++i)
            e.initial[i] = around(start[i] + d.uniform(-0.009, 0.009), 0.01);
        auto const channels = measured_states(bound, {&e});
        auto const motion = proved_motion(bound, prior, e, channels, 4);
        auto const windows = weak->over(motion, 0, 0.5, 2);
        for (auto const& w : windows) {
            auto sum = w.a.back();
            double open = 0;
            for (std::size_t j = 0; j < row.theta.size(); ++j) {
                double v = 1;
                for (auto const& [node, power] : row.theta[j])
                    v *= std::pow(p[static_cast<std::size_t>(bound.g[node].index)], power);
                sum = sum + w.a[j] * v;
                open += width(w.a[j]) * std::abs(v);
            }
            INFO(n << ": " << w.from << " to " << w.to);
            CHECK_FALSE(disjoint(sum, w.difference));
            bool const begins = w.from == 0 && std::abs(mid(w.length) - w.to / 2) < 1e-9;
            if (!begins || error > 0.01) continue;
            ++all;
            if (width(w.difference) + open < 0.2 * mid(w.length)) ++sharp;
        }
    }
    CHECK(all > 0);
    CHECK(2 * sharp > all);
}

TEST_CASE(
    "rates of other states are integrated by parts, too, where nothing else is known of them") {
    // Two masses on springs with dampers: places x0, x1 are measured, rates x2, x3 are not.
    auto const m = support::model_of(
        {4, 3, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[2], x[3], u[0] - p[0] * x[0] + p[1] * (x[3] - x[2]),
                               p[1] * (x[2] - x[3]) - p[2] * x[1] * (1 + 0.1 * x[1] * x[1])};
        });
    auto bound =
        bind(m, {{"p0", "p1", "p2"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    box const prior{between(2, 9), between(0.2, 1), between(1, 5)};
    draws d(23);
    for (std::size_t equation : {2U, 3U}) {
        auto const row = make_relation_row(bound.g, bound.rate[equation], equation, prior);
        auto const set = integrand_set::of(bound.g, row.functions, 4, 1);
        auto const weak =
            weak_windows::of(bound.g, set, {equation, equation - 2}, {{2, 0}, {3, 1}});
        REQUIRE(weak);
        CHECK(weak->pairs().size() == 2);
        CHECK(weak->pairs()[0].r == equation);
        std::size_t shown = 0;
        for (int n = 0; n < 12; ++n) {
            std::vector<double> const p{d.uniform(2, 9), d.uniform(0.2, 1), d.uniform(1, 5)};
            std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), 2, 4)};
            auto const truth =
                simulate(m, p, inputs, {d.uniform(-1, 1), d.uniform(-1, 1), 0, 0}, 4);
            auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.01, static_cast<noise>(n % 4));
            auto const channels = measured_states(bound, {&e});
            auto const law =
                declare_variations(bound, {find_rate_scales(bound, prior, e, channels)}, {});
            auto const motion = observe_motion(bound, prior, e, channels, {law.front(), {}, {}}, 4);
            auto const windows = weak->over(motion, 0, 0.5, 4);
            CHECK(windows.size() > 20);
            auto const value_of = [&](parameter_product const& theta) {
                double v = 1;
                for (auto const& [node, power] : theta) {
                    v *= std::pow(p[static_cast<std::size_t>(bound.g[node].index)], power);
                }
                return v;
            };
            bool shows = false; // a rate that was left out
            for (auto const& w : windows) {
                auto sum = w.a.back();
                for (std::size_t j = 0; j < row.theta.size(); ++j) {
                    sum = sum + w.a[j] * value_of(row.theta[j]);
                }
                CHECK_FALSE(disjoint(sum, w.difference));
                shows = shows || disjoint(sum + w.length, w.difference);
            }
            shown += shows ? 1U : 0U;
        }
        CHECK(shown > 9);
    }
    // Where another rate does not stand alone it stays, and nothing is known of it.
    auto const square = support::model_of(
        {4, 1, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[2], x[3], -(p[0] * x[2]) - x[3] * x[3], -x[3]};
        });
    auto other = bind(square, {{"p0"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    auto const row = make_relation_row(other.g, other.rate[2], 2, box{between(0, 1)});
    auto const set = integrand_set::of(other.g, row.functions, 4, 1);
    auto const weak = weak_windows::of(other.g, set, {2, 0}, {{2, 0}, {3, 1}});
    REQUIRE(weak);
    CHECK(weak->pairs().size() == 1);
}
