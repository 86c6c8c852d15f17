// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_VERIFICATION_HPP
#define SIVID_DIAGNOSIS_VERIFICATION_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/gap/verified_inflation.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/judge/witness.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Encloses the inflation at one point: parameters, delays and plays are those of the guess, so are
/// the starts but for those that follow from the parameters; inputs are those recorded. Where they
/// have error bounds nothing is known from below.
/// @param options  `options.witness` says how the runs are made
/// @guarantee  upper <= 1: the parameters explain the data, under `assumptions`
/// @cost  one validated run per experiment
[[nodiscard]] inline verified_inflation verify_at(identification_problem const& problem,
                                                  approximate_fit const& guess,
                                                  feasibility_test_options const& options = {}) {
    verified_inflation result;
    if (guess.parameters.size() != problem.prior.size()) return result;
    auto at = problem;
    bool uncertain = false;
    for (auto& e : at.experiments) {
        uncertain = uncertain || any_uncertain(e.inputs);
        e.inputs = nominal(std::move(e.inputs)); // of which states that effects added follow, too
    }
    at.prior = point_within(problem.prior, guess.parameters);
    auto const p = mid(at.prior);
    if (remembers_formulas(at) || remembers_nonsense(at, p)) return result; // nothing is known
    start_added_states(at);
    std::vector<box> starts;
    for (std::size_t s = 0; s < at.experiments.size(); ++s) {
        auto const& initial = at.experiments[s].initial;
        starts.push_back(point_within(initial, guess.starts[s]));
        for (auto const& a : at.model.added_states) starts[s][a.state] = initial[a.state];
    }
    auto const& inputs = at.model.input_memory;
    bool const delayed = !at.model.channel_delays.empty() ||
                         std::any_of(inputs.begin(), inputs.end(),
                                     [](signal_memory const& m) { return is_dead_time(m.kind); });
    auto resolved = resolve_memory(at, p);
    if (resolved.problem.prior.size() == 0) {
        // An identification needs an unknown: any constant that is fixed stands in for it.
        auto& fixed = resolved.problem.choice.fixed;
        resolved.problem.prior = box{fixed.begin()->second};
        resolved.problem.choice.unknown.push_back(fixed.begin()->first);
        fixed.erase(fixed.begin());
    }
    auto const everything = box_explorer::without_limit(resolved.problem);
    feasibility_test runs(everything, options);
    verified_witness witness;
    result.range = inflation_at(runs, resolved.problem, resolved.problem.prior, starts, witness);
    if (uncertain) result.range = interval_traits<interval>::bounds(0, result.range.upper());
    witness.parameters = p;
    if (result.range.upper() < detail::infinity) result.witness = std::move(witness);
    if (delayed) result.assumptions.push_back("delayed times are rounded to the nearest double");
    return result;
}

} // namespace sivid

#endif
