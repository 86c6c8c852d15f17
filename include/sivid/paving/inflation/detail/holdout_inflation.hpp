// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_DETAIL_HOLDOUT_INFLATION_HPP
#define SIVID_PAVING_INFLATION_DETAIL_HOLDOUT_INFLATION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/inflation.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// What was proved about held-out data.
struct holdout_bound {
    /// Contains the hold-out inflation of every parameter whose fit inflation is at most the upper
    /// bound that was proved for the fit.
    interval over_fits{0.0, detail::infinity};
    /// Contains it at the witness of the fit; everything when there is none.
    interval at_witness{0.0, detail::infinity};
    /// Contains what each held-out experiment's measured outputs are at these parameters, from some
    /// start: by experiment, in the order of time; fewer where their enclosures end early.
    std::vector<std::vector<interval>> outputs;
    std::size_t boxes = 0;
    std::size_t integrations = 0;
    double seconds = 0;
};

/// Bounds the inflation of data that were not used for the fit: over all parameters p whose fit
/// inflation is at most `fitted.value.upper()`, and at the fit's witness. Only the hold-out's own
/// starts, nuisances, are minimised.
/// @param fitted  what was proved about `fit`
/// @param holdout a problem with the same model and parameters
/// @param likely_starts  of the hold-out experiments, about what fits the witness: where starts are
///                uncertain and the bound is far above that of the fit, fewer about these are tried
/// @guarantee  both ranges contain what they say whenever the search ends
[[nodiscard]] SIVID_DECL holdout_bound
holdout_inflation(identification_problem const& fit, inflation_bound const& fitted,
                  identification_problem const& holdout, inflation_options const& options = {},
                  std::vector<std::vector<double>> const& likely_starts = {});

/// Whether an experiment's start is known only within more than what decimals round.
[[nodiscard]] inline bool has_uncertain_starts(identification_problem const& problem) {
    return std::any_of(problem.experiments.begin(), problem.experiments.end(), [](auto const& e) {
        return std::any_of(e.initial.begin(), e.initial.end(),
                           [](interval const& x) { return !(width(x) <= 1e-15 * mag(x)); });
    });
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/inflation/impl/holdout_inflation.ipp>
#endif

#endif
