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
            declare_variations(b.bound, {find_rate_scales(b.bound, b.prior, e, channels)});
        auto const motion = observe_motion(b.bound, b.prior, e, channels, {law.front(), {}, {}}, 4);
        auto const windows = weak->over(motion, 0, {.shortest_gaps = 5});
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
}
