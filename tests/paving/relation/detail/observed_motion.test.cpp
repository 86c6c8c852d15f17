// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/declared_variation.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

#include <set>

using namespace diagnosis_support;

TEST_CASE("the cells contain the motion that was measured, whatever the noise") {
    draws d(11);
    for (int n = 0; n < 24; ++n) {
        auto const m = pendulum(n % 3);
        auto const model = bind(m, {support::all_constants(3), {}},
                                {sampled_signal({0.0}, {0.0}, interpolation::linear)});
        std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), 2, 3)};
        auto const truth = simulate(m, {d.uniform(1, 10), 0.1, 1}, inputs, {0.5, 0}, 3);
        auto const kind = static_cast<noise>(d.below(4));
        auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.03, kind);
        box const prior{between(0, 20), between(0, 1), between(0, 2)};
        auto const channels = measured_states(model, {&e});
        auto const law =
            declare_variations(model, {find_rate_scales(model, prior, e, channels)}).front();
        auto const motion = observe_motion(model, prior, e, channels, {law, {}, {}}, 4);
        REQUIRE(motion.cells.size() + 1 == motion.boundaries.size());
        for (auto const& cell : motion.cells) {
            for (auto k = std::lround(std::ceil(cell.from / truth.step - 1e-9));
                 static_cast<double>(k) * truth.step <= cell.to + 1e-12; ++k) {
                auto const& x = truth.states.at(static_cast<std::size_t>(k));
                for (std::size_t i = 0; i < 2; ++i) {
                    CHECK(cell.at.states[i].lower() - 1e-9 <= x[i]);
                    CHECK(x[i] <= cell.at.states[i].upper() + 1e-9);
                }
                double const u = inputs[0].approximate(static_cast<double>(k) * truth.step);
                CHECK(cell.at.inputs[0].lower() - 1e-9 <= u);
                CHECK(u <= cell.at.inputs[0].upper() + 1e-9);
            }
        }
    }
}

TEST_CASE("the grid has all samples and knots, and ends with the samples") {
    auto const m = pendulum();
    auto const model = bind(m, {{"p0"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    experiment e;
    e.name = "S";
    e.inputs = {sampled_signal({0.0, 0.13, 0.3, 9.0}, {0, 1, 0, 0}, interpolation::linear)};
    e.initial = box{between(0, 0), between(0, 0)};
    e.measurements = {{0.2, 0, between(0, 1)}, {0.45, 0, between(0, 1)}, {0.4, 1, between(0, 1)}};
    auto const motion =
        observe_motion(model, box{between(0, 1)}, e, {{0}, {1}}, {{{0.2, 1}, {0.4, 1}}, {}, {}}, 2);
    std::set<double> const grid(motion.boundaries.begin(), motion.boundaries.end());
    for (double const t : {0.0, 0.13, 0.2, 0.3, 0.4, 0.45}) CHECK(grid.count(t) == 1);
    CHECK(motion.boundaries.back() == 0.45);
    CHECK(motion.boundary_at(0.0) == 0);
    // State 1 ends at 0.4.
    CHECK(is_bounded(motion.cells.front().at.states[1]));
    CHECK(is_entire(motion.cells.back().at.states[1]));
    CHECK(is_entire(motion.state_over(1, 0.41, 0.42)));
    for (auto const& cell : motion.cells) CHECK(cell.to - cell.from <= 0.126);
}

TEST_CASE("without measurements there are no cells") {
    auto const m = pendulum();
    auto const model = bind(m, {{"p0"}, {}}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    experiment e;
    e.inputs = {sampled_signal({0.0}, {0.0}, interpolation::hold)};
    e.initial = box{between(0, 0), between(0, 0)};
    auto const motion = observe_motion(model, box{between(0, 1)}, e, {{0}, std::nullopt},
                                       {{{1, 1}, {1, 1}}, {}, {}}, 4);
    CHECK(motion.cells.empty());
}

TEST_CASE("the model alone encloses the motion, and the middles of the lines that stand for it") {
    draws d(603);
    auto const m = support::model_of(
        {2, 2, 1}, [](expression const&, std::vector<expression> const& x,
                      std::vector<expression> const& p, std::vector<expression> const& u) {
            return std::vector<expression>{
                u[0] - p[0] * x[0] - p[1] * x[0] / sqrt(sqr(x[0]) + 0.0001), x[0]};
        });
    auto const model = bind(m, {support::all_constants(2), {}},
                            {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    for (int n = 0; n < 40; ++n) {
        std::vector<sampled_signal> const inputs{sampled_signal(
            {0, 1, 2, 3}, {0, n % 2 == 0 ? 0 : d.uniform(-2, 2), d.uniform(-2, 2), 0},
            interpolation::linear)};
        box const prior{between(0.5, 1), between(0.1, 0.3)};
        // From rest, known exactly: the motion is told far more narrowly than by its samples.
        auto const truth = simulate(m, d.in(prior), inputs, {0, 0}, 3, 0.0005);
        auto const shown =
            n % 3 == 0 ? std::vector<std::size_t>{1} : std::vector<std::size_t>{0, 1};
        auto const e = measured(d, "S", truth, inputs, shown, 0.05, noise::at_the_bounds);
        auto const motion = proved_motion(model, prior, e, measured_states(model, {&e}), 6, {});
        REQUIRE_FALSE(motion.cells.empty());
        for (auto const& cell : motion.cells) {
            for (std::size_t i = 0; i < 2; ++i) {
                CHECK(contains(cell.at.states[i], cell.lines[i].centre));
                for (double const t : {cell.from, cell.to}) {
                    double const x = truth.at(t)[i];
                    auto const k = static_cast<std::size_t>(std::lround(t / truth.step));
                    if (std::abs(static_cast<double>(k) * truth.step - t) > 1e-9) continue;
                    CHECK(cell.at.states[i].lower() - 1e-8 <= x);
                    CHECK(x <= cell.at.states[i].upper() + 1e-8);
                }
            }
        }
    }
}

TEST_CASE("the damping of a state is the median of its own slope, never below 0") {
    using list = std::vector<expression>;
    auto const m =
        support::model_of({2, 1}, [](expression const&, list const& x, list const& p, list const&) {
            return list{-p[0] * x[0] - 1000 * max(x[0] - 10, 0.0), x[1]};
        });
    auto model = bind(m, {support::all_constants(1), {}}, {});
    experiment e{"S", {}, 0, box{between(1, 1), between(1, 1)}, {}, 0};
    for (int k = 1; k <= 10; ++k) {
        e.measurements.push_back({0.1 * k, 0, between(0, 1)});
        e.measurements.push_back({0.1 * k, 1, between(0, 3)});
    }
    box const prior{between(1, 5)};
    auto const motion =
        observe_motion(model, prior, e, {{0}, {1}}, {{{0.1, 5}, {0.1, 5}}, {}, {}}, 4);
    CHECK_THAT(damping_of(model, 0, {motion}), WithinAbs(3, 1e-9));
    CHECK(damping_of(model, 1, {motion}) == 0);
    CHECK(damping_of(model, 0, {}) == 0);
}
