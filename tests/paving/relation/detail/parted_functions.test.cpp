// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/parted_functions.hpp>

#include <sivid/paving/relation/detail/stated_equation.hpp>

#include "paving/relation/two_links.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace diagnosis_support;

namespace {

/// x0' = x1, x1' = p0 u - p1 x1, seen by x0.
struct parted_bench {
    recorded_model model = support::model_of(
        {2, 2, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[1], p[0] * u[0] - p[1] * x[1]};
        });
    bound_model bound =
        bind(model, {{"p0", "p1"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    box prior{between(0.5, 1.5), between(0.2, 0.4)};
    relation_row plain = make_relation_row(bound.g, stated_equation(bound, 1), 1, prior);
    relation_row middle = plain;
    integrand_set set;

    parted_bench() {
        combine(bound.g, middle, 0);
        auto functions = plain.functions;
        functions.push_back(middle.functions.back());
        set = integrand_set::of(bound.g, functions, 2, 3);
    }
    observed_motion motion_of(experiment const& e) const {
        return proved_motion(bound, prior, e, measured_states(bound, {&e}), 4, {});
    }
    parted_functions parted(observed_motion const& motion) const {
        return {set, middle.centre, motion, rates_along(bound, motion), 0, {{1, 0}}};
    }
};

} // namespace

TEST_CASE("rates stand in the part that is linear between samples, with nothing left over") {
    draws d(51);
    parted_bench b;
    std::vector<sampled_signal> const inputs{sine_input(2, 3, 2)};
    auto const truth = simulate(b.model, {1, 0.3}, inputs, {0.2, 0}, 2, 0.001);
    auto const e = measured(d, "S", truth, inputs, {0}, 0.001, noise::uniform);
    auto const motion = b.motion_of(e);
    auto const f = b.parted(motion);
    REQUIRE(f.times().size() == 21);
    REQUIRE(f.functions() == 4); // p0, p1, what has none, the sum
    std::vector<std::size_t> orders;
    for (auto const& p : f.parts()) orders.push_back(p.order);
    CHECK(orders == std::vector<std::size_t>{1, 2});
    double_rates rate(b.model);
    for (std::size_t j = 0; j < f.functions(); ++j) {
        graph_range function(b.bound.g, {b.set.functions[j]});
        // The function less its factors times the leaves, along the truth.
        auto const left = [&](std::vector<double> const& x, double t, auto const& factor) {
            double const u = inputs[0].approximate(t);
            std::vector<double> const rates = rate(t, x, {1, 0.3}, {u});
            leaf_ranges const at{interval(t), box{interval(x[0]), interval(x[1])}, b.prior,
                                 box{interval(u), interval(rates[0]), interval(rates[1])}};
            function.evaluate(at);
            double const leaves[] = {x[1], rates[1]};
            double value = mid(function.value(b.set.functions[j]));
            for (std::size_t p = 0; p < 2; ++p) value -= factor(p) * leaves[p];
            return value;
        };
        for (std::size_t g = 0; g + 1 < f.times().size(); ++g) {
            double const t0 = f.times()[g], t1 = f.times()[g + 1];
            auto const place = [&](double t) { return (t - t0) / (t1 - t0); };
            double const even = integral(truth, t0, t1, [&](auto const& x, double t) {
                return left(x, t, [&](std::size_t p) {
                    double const s = place(t);
                    return (1 - s) * f.factor(j, p, g) + s * f.factor(j, p, g + 1);
                });
            });
            double const rising = integral(truth, t0, t1, [&](auto const& x, double t) {
                return place(t) * left(x, t, [&](std::size_t p) { return f.factor(j, p, g + 1); });
            });
            INFO("function " << j << ", gap " << g);
            CHECK(contains(hull(f.rest(j, g)[0] - 1e-5, f.rest(j, g)[0] + 1e-5), even));
            CHECK(contains(hull(f.rest(j, g)[1] - 1e-5, f.rest(j, g)[1] + 1e-5), rising));
            CHECK(width(f.rest(j, g)[0]) < 2e-3);
        }
    }
    for (std::size_t k = 0; k < f.times().size(); ++k) {
        CHECK(contains(f.sample(0, k), truth.at(f.times()[k])[0]));
        CHECK(width(f.sample(0, k)) < 0.0021);
    }
}

TEST_CASE("without samples, or beside cells that do not end at them, nothing is known") {
    draws d(52);
    parted_bench b;
    std::vector<sampled_signal> const inputs{sine_input(2, 3, 1)};
    auto const truth = simulate(b.model, {1, 0.3}, inputs, {0.2, 0}, 1, 0.001);
    auto const e = measured(d, "S", truth, inputs, {0}, 0.001, noise::uniform);
    auto motion = b.motion_of(e);
    CHECK_FALSE(b.parted(motion).times().empty());
    auto coarse = motion; // a cell on both sides of a sample
    auto const at = coarse.boundary_at(0.5);
    coarse.boundaries.erase(coarse.boundaries.begin() + static_cast<std::ptrdiff_t>(at));
    coarse.cells[at - 1].to = coarse.cells[at].to;
    coarse.cells.erase(coarse.cells.begin() + static_cast<std::ptrdiff_t>(at));
    CHECK(b.parted(coarse).times().empty());
    motion.tubes[0].reset();
    CHECK(b.parted(motion).times().empty());
}
