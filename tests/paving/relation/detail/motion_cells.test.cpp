// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/motion_cells.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

using namespace diagnosis_support;

namespace {

using list = std::vector<expression>;

bound_model open_model(recorded_model const& m, std::size_t constants) {
    return bind(m, {support::all_constants(constants), {}},
                {sampled_signal({0.0}, {0.0}, interpolation::linear)});
}
sampled_signal waves(draws& d, interpolation kind) {
    std::vector<double> t, v;
    double const pace = d.uniform(0.5, 6);
    for (int k = 0; k < 42; ++k) {
        t.push_back(k * 0.05);
        v.push_back(2 * std::sin(pace * t.back()));
    }
    return {t, v, kind};
}

} // namespace

TEST_CASE("motions lie in the cells, seen or not, whatever is believed of their ranges") {
    draws d(720);
    auto const m = support::model_of(
        {3, 3, 1}, [](expression const&, list const& x, list const& p, list const& u) {
            return list{p[0] * x[1] - p[1] * x[0] - 0.2 * x[0] / sqrt(sqr(x[0]) + 0.0001),
                        (u[0] - x[1]) / p[2], x[0]};
        });
    auto const model = open_model(m, 3);
    box const prior{between(0.5, 1.5), between(0.5, 2), between(0.1, 0.3)};
    double widest = 0;
    auto const count = support::swept(40, 1000);
    for (int n = 0; n < count; ++n) {
        std::vector<sampled_signal> const inputs{
            waves(d, d.coin() ? interpolation::linear : interpolation::hold)};
        auto const truth = simulate(m, d.in(prior), inputs, {d.uniform(-1, 1), 0, 0}, 2, 0.0025);
        auto const e = measured(d, "S", truth, inputs, {0, 2}, 0.02, noise::at_the_bounds);
        motion_cells const cells(model, prior, e, {{0}, std::nullopt, {2}}, d.coin());
        auto const reach = cells.enclosures();
        for (std::size_t k = 0; k < truth.states.size(); k += 7) {
            double const t = static_cast<double>(k) * truth.step;
            for (std::size_t i = 0; i < 3; ++i) {
                auto const x = cells.over(reach, i, t, t);
                CHECK(x.lower() - 1e-9 <= truth.states[k][i]);
                CHECK(truth.states[k][i] <= x.upper() + 1e-9);
                widest = std::max(widest, width(x));
            }
        }
        CHECK_FALSE(is_bounded(cells.over(reach, 0, 1, 3)));
    }
    CHECK(widest < 5); // the unseen state does not spread, though its equation is stiff
}

TEST_CASE("what does not settle is nothing but the state's own range") {
    auto const m = support::model_of({1, 1, 1, 7},
                                     [](expression const&, list const& x, list const& p,
                                        list const& u) { return list{p[0] * sqr(x[0]) + u[0]}; });
    auto const model = open_model(m, 1);
    std::vector<sampled_signal> const inputs{
        sampled_signal({0, 10}, {0, 0}, interpolation::linear)};
    experiment e{
        "S", {inputs[0]}, 0, box{between(1, 1)}, {{3, 0, interval_traits<interval>::entire()}}, 0};
    for (bool const believed : {true, false}) {
        motion_cells const cells(model, box{between(0, 1)}, e, {{0}}, believed);
        auto const x = cells.over(cells.enclosures(), 0, 1.6, 1.7);
        CHECK(is_bounded(x) == believed);
        if (believed) CHECK(x.upper() == 7);
    }
}

TEST_CASE("a motion that its equation does not determine is not lost") {
    // x' = sqrt(|x|) from 0: it may stay, or leave at any time.
    auto const m = support::model_of({1, 0, 1}, [](expression const&, list const& x, list const&,
                                                   list const&) { return list{sqrt(abs(x[0]))}; });
    auto const model = bind(m, {}, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    std::vector<sampled_signal> const inputs{
        sampled_signal({0, 10}, {0, 0}, interpolation::linear)};
    experiment e{"S", {inputs[0]}, 0, box{between(0, 0)}, {{1, 0, between(-1, 1)}}, 0};
    motion_cells const cells(model, box{}, e, {{0}}, false);
    auto const x = cells.over(cells.enclosures(), 0, 0.99, 1);
    CHECK(x.lower() <= 0);
    CHECK(x.upper() >= 0.25);
}

TEST_CASE("readings that are close together do not cut the whole record as finely") {
    auto const m = support::model_of({1, 1, 0}, [](expression const&, list const& x, list const& p,
                                                   list const&) { return list{p[0] * x[0]}; });
    experiment e{"S", {}, 0, box{between(-1, 1)}, {}, 0};
    for (int k = 1; k <= 40; ++k)
        for (int n = 0; n < 3; ++n) e.measurements.push_back({k + 1e-6 * n, 0, between(-1, 1)});
    auto const model = bind(m, {support::all_constants(1), {}}, {});
    motion_cells const cells(model, box{between(-1, 0)}, e, {{0}}, true);
    CHECK(cells.size() < 20 * e.measurements.size());
    CHECK(cells.size() > 4 * e.measurements.size() / 3);
}
