// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_RUNLESS_CONTRACTION_HPP
#define SIVID_PAVING_JUDGE_DETAIL_RUNLESS_CONTRACTION_HPP

#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/observer/observer_contraction.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <vector>

namespace sivid {

/// What the state equations between samples and interval observers, one after the other, leave of
/// a prior until they rest: no trajectory is integrated. Equations see many measurements together,
/// observers see states that no channel shows.
/// @param problem  its model has no delays (checked)
/// @guarantee  no parameter that explains the data is removed; empty: proved, there is none
/// @cost  as both (`contract_by_relations`, `observer_contraction`), some rounds of them
[[nodiscard]] inline box contract_without_runs(identification_problem const& problem,
                                               relation_contraction_options const& options) {
    box rest = problem.prior;
    if (rest.size() == 0) return rest;
    auto const empty = [&] { return empty_box(rest.size()); };
    relation_test const between_samples(problem, options);
    observer_contraction along(problem, {.keep_going = options.keep_going});
    for (bool gains = true; gains && (!options.keep_going || options.keep_going());) {
        auto const found = between_samples(rest);
        if (found.verdict == box_verdict::outside) return empty();
        rest = along(found.rest);
        if (is_empty(rest)) return rest;
        gains = relative_volume(rest, found.rest).upper() < 0.8;
    }
    return rest;
}

} // namespace sivid

#endif
