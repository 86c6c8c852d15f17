// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/kept_range.hpp>

#include "paving/relation/planted_balances.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

using namespace relation_support;

namespace {

/// What is kept of a problem's first experiment.
box kept_in(identification_problem const& problem) {
    auto model =
        bind(problem.model, problem.choice, {sampled_signal({0.0}, {0.0}, interpolation::linear)});
    auto const n = model.state_count();
    auto const set = integrand_set::of(model.g, model.rate, n, 1);
    return paving_detail::kept_sides(set, n, model, problem.prior, problem.experiments[0])();
}
box kept_of(support::recorded_rate const& rate, box const& starts, double limit = 100) {
    identification_problem problem{support::model_of({starts.size(), 1, 1, limit}, rate),
                                   {support::all_constants(1), {}},
                                   box{between(0, 1)},
                                   {}};
    sampled_signal const u({0, 1}, {0.5, 1}, interpolation::linear);
    problem.experiments.push_back({"S", {u}, 0, starts, {{1, 0, between(-1, 1)}}, 0});
    return kept_in(problem);
}

} // namespace

TEST_CASE("no motion leaves what is kept") {
    draws d(741);
    auto const count = support::swept(20, 200);
    for (auto const& what : all_balanced()) {
        auto const m = support::model_of(what.system.shape, what.system.rate);
        for (int n = 0; n < count; ++n) {
            auto r = record_of(d, what, m);
            r.problem.prior = part_about(d, r.problem.prior, r.truth);
            auto const kept = kept_in(r.problem);
            auto const& e = r.problem.experiments[0];
            // From any start in the box.
            std::vector<sampled_signal> const inputs{
                std::get<sampled_signal>(e.inputs[0]).nominal()};
            auto const motion =
                simulate(m, r.truth, inputs, d.in(e.initial), e.end(), what.system.step);
            INFO(what.system.name << " " << n);
            for (auto const& x : motion.states) {
                if (!std::isfinite(x[0])) break; // it ended: a start below 0 is none of the truth
                for (std::size_t i = 0; i < x.size(); ++i) {
                    CHECK(kept[i].lower() - 1e-9 <= x[i]);
                    CHECK(x[i] <= kept[i].upper() + 1e-9);
                }
            }
        }
    }
}

TEST_CASE("sides are kept alone, together, or not at all") {
    using list = terms const&;
    // Together: a rate law needs both not to be negative; what only falls stays below its start.
    auto const shares = kept_of(
        [](expression const&, list x, list p, list) {
            return terms{-p[0] * x[0] * x[1], 4 * p[0] * x[0] * x[1] - x[1]};
        },
        box{between(0.5, 0.75), between(0.125, 0.25)});
    CHECK((shares[0].lower() == 0 && shares[0].upper() == 0.75));
    CHECK((shares[1].lower() == 0 && shares[1].upper() == HUGE_VAL));
    // Alone: a root that is not Lipschitz at 0.
    auto const level = kept_of([](expression const&, list x, list p,
                                  list u) { return terms{u[0] - p[0] * sqrt(max(x[0], 0))}; },
                               box{between(0.5, 1)});
    CHECK((level[0].lower() == 0 && !is_bounded(level[0])));
    // Not: motions that stop at 0 and go on below are not unique there.
    auto const leaves =
        kept_of([](expression const&, list x, list, list) { return terms{-sqrt(abs(x[0]))}; },
                box{between(0.5, 1)});
    CHECK(leaves[0].lower() == -HUGE_VAL);
    CHECK(leaves[0].upper() == 1);
    // Nor where the rate is not defined, but at the end of the own range behind it.
    auto const jumps =
        kept_of([](expression const&, list x, list, list) { return terms{-x[0] / abs(x[0])}; },
                box{between(0.5, 1)});
    CHECK(jumps[0].lower() == -100);
    // An end of the own range, of both signs.
    auto const saturated =
        kept_of([](expression const&, list x, list p,
                   list u) { return terms{u[0] * (4 - x[0]) * (4 + x[0]) * (p[0] + 1)}; },
                box{between(-1, 1)}, 4);
    CHECK((saturated[0].lower() == -1 && saturated[0].upper() == 4));
}
