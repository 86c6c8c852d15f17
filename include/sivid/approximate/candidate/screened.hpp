// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_SCREENED_HPP
#define SIVID_APPROXIMATE_CANDIDATE_SCREENED_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/candidate/candidate.hpp>
#include <sivid/executor.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// A candidate with its problem and fit.
struct screened {
    candidate figures;
    identification_problem problem;
    approximate_fit fit;
    bool silent = false; ///< no value of the effect's parameters moves a measured output
};

/// A candidate that is to be fitted.
struct wanted_fit {
    std::vector<std::size_t> effects; ///< of the catalogue
    screened const* part = nullptr;   ///< the likeliest part of it that was fitted, if any
};
struct made_fit {
    approximate_fit fit;
    bool silent = false;
    bool cut_short = false; ///< ended before it was done
};

/// Whether the residuals of two fits are the same, but for rounding, or but for so much.
[[nodiscard]] inline bool alike(std::vector<std::vector<double>> const& a,
                                std::vector<std::vector<double>> const& b, double but_for = 1e-5) {
    if (a.size() != b.size()) return false;
    for (std::size_t e = 0; e < a.size(); ++e) {
        for (std::size_t k = 0; k < a[e].size(); ++k) {
            if (!(std::abs(a[e][k] - b[e][k]) < but_for)) return false;
        }
    }
    return true;
}

struct screening_options {
    double seconds = 60;
    /// Pairs are tried with so many of the best single effects when none explains alone, ...
    std::size_t partners = 6;
    /// ... and the best single one with all others when it does.
    bool always_pairs = true;
    /// Candidates of up to so many effects are tried: where no pair explains, effects join the
    /// likeliest candidates one by one.
    std::size_t most_effects = 2;
    /// Called before each fit with what is tried, by one thread at a time; false ends the
    /// screening.
    std::function<bool(std::string const&)> progress{};
    /// Asked within the fits, by any thread; false ends the screening, and a fit that it ends
    /// counts only if it explains the data. May be empty.
    std::function<bool()> go_on{};
    executor workers{}; ///< for candidates that do not build on each other
    /// Fits candidates in place of the workers, with the same result: on many machines, say. Told
    /// whether to go on, by its own thread; none where a fit was not begun. May be empty.
    std::function<std::vector<std::optional<made_fit>>(std::vector<wanted_fit> const&,
                                                       std::function<bool()> const& go_on)>
        fit_elsewhere{};
};

/// Which candidates are single effects that act everywhere, the closest first.
[[nodiscard]] inline std::vector<std::size_t>
closest_singles(std::vector<screened> const& candidates, std::vector<effect> const& catalogue,
                std::size_t most) {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        auto const& effects = candidates[k].figures.effects;
        bool const everywhere = effects.size() == 1 && catalogue[effects.front()].only_in.empty();
        if (everywhere) result.push_back(k);
    }
    std::stable_sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
        return candidates[a].fit.inflation < candidates[b].fit.inflation;
    });
    result.resize(std::min(most, result.size()));
    return result;
}

} // namespace sivid

#endif
