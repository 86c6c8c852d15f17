// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_CANDIDATE_FIT_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_CANDIDATE_FIT_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/prior_end.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// The problem with priors of effects that keep a little away from 0: a lag of no time is a limit.
/// @param first  side of the first effect
[[nodiscard]] inline identification_problem away_from_zero(identification_problem problem,
                                                           std::size_t first) {
    for (std::size_t j = first; j < problem.prior.size(); ++j) {
        auto& side = problem.prior[j];
        if (side.lower() == 0)
            side = interval_traits<interval>::bounds(0.005 * side.upper(), side.upper());
    }
    return problem;
}

/// Which unknowns are widths of plays.
[[nodiscard]] inline std::vector<std::size_t> widths_of_plays(identification_problem const& p) {
    std::vector<std::size_t> result;
    for (auto const& m : p.model.input_memory) {
        auto const& name = p.model.about.constants[m.constant].name;
        auto const at = std::find(p.choice.unknown.begin(), p.choice.unknown.end(), name);
        if (m.kind == memory_kind::play && at != p.choice.unknown.end())
            result.push_back(static_cast<std::size_t>(at - p.choice.unknown.begin()));
    }
    return result;
}

/// Descents end in the corners that a play has by its width: others begin beside them, until one
/// explains.
/// @param descend  an approximate_fitter of the problem
inline void leave_corners(identification_problem const& problem, approximate_fitter& descend,
                          approximate_fit& found) {
    for (auto const j : widths_of_plays(problem)) {
        auto const& side = problem.prior[j];
        for (double const share : {-0.05, 0.05, -0.025, 0.025}) {
            if (found.inflation <= 1) return;
            auto beside = found.parameters;
            beside[j] = std::clamp(beside[j] + share * (side.upper() - side.lower()), side.lower(),
                                   side.upper());
            auto other = descend({beside});
            if (other.inflation < found.inflation) found = std::move(other);
        }
    }
}

/// Fits a candidate from the best of a grid over the parameters of its last effect, the others as
/// a part of the candidate was fitted. An effect that sleeps (a saturation that is never
/// reached, say) has no slope to follow: where the best of the grid sleeps, which it may while
/// the others have not yielded, the best that does not is descended from, too. A play that comes
/// close is tried again beside the width that was found.
/// Many measurements are thinned first.
/// @param base   the problem without effects
/// @param known  the likeliest part of the candidate that was fitted; nothing: the model itself
/// @param effects  how many they are
/// @param silent  receives whether the effect sleeps on all of the grid
[[nodiscard]] inline approximate_fit fit_candidate(identification_problem const& problem,
                                                   identification_problem const& base,
                                                   screened const* known, std::size_t effects,
                                                   std::function<bool()> const& go_on,
                                                   bool& silent) {
    auto const full = away_from_zero(problem, base.prior.size());
    if (known == nullptr) return approximate_fitter(full, go_on)();
    bool const many = measurement_count(problem) > 2 * many_measurements;
    auto const narrowed = many ? thinned(full, many_measurements) : full;
    auto const reference =
        many ? thinned(known->fit.residuals, thinned_indices(full, many_measurements))
             : known->fit.residuals;
    approximate_fitter descend(narrowed, go_on);
    std::vector<std::vector<double>> starts = known->fit.starts;
    auto const first = base.prior.size();
    approximate_fit best;
    std::vector<double> from, awake;
    double least_awake = detail::infinity;
    std::vector<double> parameters(narrowed.prior.size());
    std::copy(known->fit.parameters.begin(),
              known->fit.parameters.begin() + static_cast<std::ptrdiff_t>(first),
              parameters.begin());
    for (std::size_t e = 0; e < starts.size(); ++e) {
        auto const& initial = narrowed.experiments[e].initial;
        starts[e] = mid(initial);
        for (std::size_t i = 0; i < base.experiments[e].initial.size(); ++i) {
            starts[e][i] = known->fit.starts[e][i];
        }
    }
    // Which parameters stand as they were fitted, and which are open.
    std::vector<std::size_t> open;
    for (std::size_t j = first; j < narrowed.prior.size(); ++j) {
        auto const& name = narrowed.choice.unknown[j];
        auto const& others = known->problem.choice.unknown;
        auto const f = std::find(others.begin(), others.end(), name);
        if (f == others.end()) {
            open.push_back(j);
        } else {
            auto const k = static_cast<std::size_t>(f - others.begin());
            parameters[j] = known->fit.parameters[k];
        }
    }
    constexpr double roughly = 0.05; // of the bounds: what rough simulations may miss
    std::size_t const steps = open.size() == 1 ? 9 : 4;
    std::size_t count = 1;
    for (std::size_t k = 0; k < open.size(); ++k) count *= steps;
    auto const go_to = [&](std::size_t code) { // of the grid
        for (auto const j : open) {
            double const share =
                (static_cast<double>(code % steps) + 0.5) / static_cast<double>(steps);
            code /= steps;
            auto const& side = narrowed.prior[j];
            parameters[j] = side.lower() + share * (side.upper() - side.lower());
        }
    };
    for (std::size_t n = 0; n < count; ++n) {
        go_to(n);
        auto const here = descend.roughly_at(parameters, starts);
        bool const sleeps = alike(here.residuals, reference, roughly) &&
                            alike(descend.at(parameters, starts).residuals, reference);
        silent = (n == 0 || silent) && sleeps;
        if (!sleeps && here.inflation < least_awake) {
            least_awake = here.inflation;
            awake = parameters;
        }
        if (from.empty() || here.inflation < best.inflation) {
            best = here;
            from = parameters;
        }
    }
    if (many && silent) { // the measurements that are left out may hear it
        approximate_fitter all(full, go_on);
        for (std::size_t n = 0; n < count && silent; ++n) {
            go_to(n);
            silent = alike(all.at(parameters, starts).residuals, known->fit.residuals);
        }
    }
    auto found = descend({from});
    if (!awake.empty() && awake != from) {
        auto other = descend({awake});
        if (other.inflation < found.inflation) found = std::move(other);
    }
    constexpr double promising = 3; // of more effects than one
    if (found.inflation > 1 && (effects == 1 || found.inflation < promising)) {
        // What sits at the end of its prior may be stuck there.
        auto const freed = away_from_ends(problem.prior, found.parameters);
        if (freed != found.parameters) {
            auto other = descend({freed});
            if (other.inflation < found.inflation) found = std::move(other);
        }
        leave_corners(narrowed, descend, found);
    }
    if (!(found.inflation < best.inflation)) {
        auto const squares = found.squares; // the descent's, whose least inflation is no better
        found = descend.at(from, starts);
        found.squares = squares;
    }
    return many && !found.parameters.empty()
               ? approximate_fitter(full, go_on)({found.parameters, {}})
               : found;
}

} // namespace sivid

#endif
