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

inline void keep_better(approximate_fit& found, approximate_fit other) {
    if (other.inflation < found.inflation) found = std::move(other);
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
            keep_better(found, descend({beside}));
        }
    }
}

/// Where a fit of one candidate may begin that was found for another one.
struct taken_over {
    std::vector<double> parameters;
    std::vector<std::vector<double>> starts;
    std::vector<std::size_t> open; ///< parameters that the other candidate does not have; 0

    /// @param base  the problem without effects
    taken_over(identification_problem const& problem, identification_problem const& base,
               screened const& other)
        : parameters(problem.prior.size()), starts(other.fit.starts) {
        auto const& names = other.problem.choice.unknown;
        for (std::size_t j = 0; j < problem.prior.size(); ++j) {
            auto const f = std::find(names.begin(), names.end(), problem.choice.unknown[j]);
            if (f == names.end())
                open.push_back(j);
            else
                parameters[j] = other.fit.parameters[static_cast<std::size_t>(f - names.begin())];
        }
        for (std::size_t e = 0; e < starts.size(); ++e) {
            starts[e] = mid(problem.experiments[e].initial);
            for (std::size_t i = 0; i < base.experiments[e].initial.size(); ++i)
                starts[e][i] = other.fit.starts[e][i];
        }
    }
};

/// Points of a candidate: a grid over the parameters of its last effect, all others where a part
/// of the candidate was fitted.
class effect_grid {
public:
    /// @param base   the problem without effects
    /// @param known  the part that was fitted
    effect_grid(identification_problem const& problem, identification_problem const& base,
                screened const& known)
        : problem_(&problem), from_(problem, base, known), steps_(from_.open.size() == 1 ? 9 : 4) {
        for (std::size_t k = 0; k < from_.open.size(); ++k) size_ *= steps_;
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    /// The same for all points.
    [[nodiscard]] std::vector<std::vector<double>> const& starts() const { return from_.starts; }
    [[nodiscard]] std::vector<double> operator[](std::size_t n) const {
        auto point = from_.parameters;
        for (auto const j : from_.open) {
            double const share =
                (static_cast<double>(n % steps_) + 0.5) / static_cast<double>(steps_);
            n /= steps_;
            auto const& side = problem_->prior[j];
            point[j] = side.lower() + share * (side.upper() - side.lower());
        }
        return point;
    }

    /// Where the effect hardly acts, so that the misfit of the part that was fitted has a slope.
    [[nodiscard]] std::vector<double> beside_neutral() const {
        constexpr double hardly = 0.01; // of the prior
        auto point = from_.parameters;
        auto const& constants = problem_->model.about.constants;
        for (auto const j : from_.open) {
            auto const& side = problem_->prior[j];
            auto const named = std::find_if(constants.begin(), constants.end(), [&](auto const& c) {
                return c.name == problem_->choice.unknown[j];
            });
            double const neutral = named == constants.end() ? 0 : named->nominal.nearest;
            double const step = hardly * (side.upper() - side.lower());
            point[j] = std::clamp(neutral + (mid(side) < neutral ? -step : step), side.lower(),
                                  side.upper());
        }
        return point;
    }

private:
    identification_problem const* problem_;
    taken_over from_;
    std::size_t steps_ = 1, size_ = 1;
};

/// The points of a grid from which to descend.
struct grid_starts {
    std::vector<double> best;
    approximate_fit there;     ///< at the best one, roughly
    std::vector<double> awake; ///< the best at which the effect does not sleep; or none
    bool sleeps = true;        ///< at all of them
};

/// @param asleep  the residuals while the effect sleeps
[[nodiscard]] inline grid_starts starts_on(effect_grid const& grid, approximate_fitter& fitter,
                                           std::vector<std::vector<double>> const& asleep) {
    constexpr double roughly = 0.05; // of the bounds: what rough simulations may miss
    grid_starts result;
    double least_awake = detail::infinity;
    for (std::size_t n = 0; n < grid.size(); ++n) {
        auto const point = grid[n];
        auto const here = fitter.roughly_at(point, grid.starts());
        bool const sleeps = alike(here.residuals, asleep, roughly) &&
                            alike(fitter.at(point, grid.starts()).residuals, asleep);
        result.sleeps = result.sleeps && sleeps;
        if (!sleeps && here.inflation < least_awake) {
            least_awake = here.inflation;
            result.awake = point;
        }
        if (result.best.empty() || here.inflation < result.there.inflation) {
            result.there = here;
            result.best = point;
        }
    }
    return result;
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
    effect_grid const grid(narrowed, base, *known);
    auto const from = starts_on(grid, descend, reference);
    silent = from.sleeps;
    if (many && silent) { // the measurements that are left out may hear it
        approximate_fitter all(full, go_on);
        for (std::size_t n = 0; n < grid.size() && silent; ++n) {
            silent = alike(all.at(grid[n], grid.starts()).residuals, known->fit.residuals);
        }
    }
    auto found = descend({from.best});
    if (!from.awake.empty() && from.awake != from.best) keep_better(found, descend({from.awake}));
    constexpr double promising = 3; // of more effects than one
    if (found.inflation > 1 && (effects == 1 || found.inflation < promising)) {
        // The best of the grid may lie in another valley: behind friction that lets nothing move.
        keep_better(found, descend({grid.beside_neutral(), grid.starts()}));
        // What sits at the end of its prior may be stuck there.
        auto const freed = away_from_ends(problem.prior, found.parameters);
        if (freed != found.parameters) keep_better(found, descend({freed}));
        leave_corners(narrowed, descend, found);
    }
    if (!(found.inflation < from.there.inflation)) {
        auto const squares = found.squares; // the descent's, whose least inflation is no better
        found = descend.at(from.best, grid.starts());
        found.squares = squares;
    }
    return many && !found.parameters.empty()
               ? approximate_fitter(full, go_on)({found.parameters, {}})
               : found;
}

} // namespace sivid

#endif
