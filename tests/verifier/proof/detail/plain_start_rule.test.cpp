// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#ifdef SIVID_HAS_MPFI
#include <sivid/number/mp_interval.hpp>
#endif

using namespace sivid;

namespace {

/// Whether x' = -a x from x0 meets all measurements but q.
bool explains(record const& samples, double a, double x0, std::size_t q) {
    std::size_t failed = 0;
    for (auto const& m : samples) {
        double const x = x0 * std::exp(-a * m.time);
        failed += m.bound.lower() - 1e-9 <= x && x <= m.bound.upper() + 1e-9 ? 0 : 1;
    }
    return failed <= q;
}

template <class I>
void check_rules() {
    support::draws d(31);
    int proved = 0;
    for (int trial = 0; trial < 60; ++trial) {
        auto const spoilt = d.below(2);
        auto const problem = plain_problem::make(spoilt, spoilt, interval(1.8, 2.2));
        auto const& e = problem.experiments[0];
        plain_run<I> run(problem.model, problem.choice, e, {});
        double const at = d.uniform(0.4, 0.6), reach = d.uniform(1e-3, 0.02);
        box const region{interval(at - reach, at + reach)};
        auto const wide = run(e.initial, region);
        plain_start_rule<I> const guess(wide, run.samples(), e.initial, region);
        auto const about = guess.search(spoilt, false);
        if (!about) continue;
        auto const starts = guess.around(*about, e.initial);
        CHECK(interior(starts[0], e.initial[0]));
        auto const known = run(starts, region);
        plain_start_rule<I> const found(known, run.samples(), starts, region);
        auto const rule = found.search(spoilt, true);
        if (!rule || !found.proves(*rule, spoilt)) continue;
        ++proved;
        for (double const a : {at - reach, at, at + reach, at + 0.3 * reach}) {
            double const share = (a - mid(region[0])) / rad(region[0]);
            double const x0 =
                mid(starts[0]) + rad(starts[0]) * (rule->middle[0] + rule->slope[0] * share);
            CHECK(contains(e.initial[0], x0));
            CHECK(explains(run.samples(), a, x0, spoilt));
        }
        // Other rules are refused as long as they explain too little or leave the starts.
        auto wrong = *rule;
        wrong.middle[0] = 1.5;
        CHECK_FALSE(found.proves(wrong, spoilt));
        CHECK_FALSE(guess.proves({{0.99}, {0.0}}, 0));
    }
    CHECK(proved > 15);
}

} // namespace

TEST_CASE("rules that are proved explain the measurements from starts in the box") {
    check_rules<interval>();
#ifdef SIVID_HAS_MPFI
    check_rules<proven_interval>();
#endif
}

TEST_CASE("no rule where there is nothing to choose") {
    auto const problem = plain_problem::make();
    auto const& e = problem.experiments[0];
    plain_run<interval> run(problem.model, problem.choice, e, {});
    box const region{interval(0.49, 0.51)};
    auto const known = run(e.initial, region);
    plain_start_rule<interval> const none(known, run.samples(), e.initial, region);
    CHECK_FALSE(none.search(0, true));
}
