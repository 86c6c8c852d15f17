// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_CANDIDATE_HPP
#define SIVID_APPROXIMATE_CANDIDATE_CANDIDATE_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Effects that might be what a model leaves out, with the figures of their best fit. Not a proof.
struct candidate {
    std::vector<std::size_t> effects; ///< into the catalogue, increasing; none: the model itself
    std::size_t unknowns = 0;         ///< parameters and starts that were fitted
    double inflation = std::numeric_limits<double>::infinity(); ///< at best, by minimax fit
    double squares = std::numeric_limits<double>::infinity();   ///< least sum of ((y - m)/e)^2

    /// Twice the negative logarithm of the likelihood, up to a constant, with a price for each
    /// unknown: \f$ 3 \sum r^2 + k \ln N \f$ (Schwarz, Annals of Statistics 6, 1978). Noise that
    /// fills its bounds evenly has the variance e^2/3.
    [[nodiscard]] double score(std::size_t measurements) const {
        return 3 * squares +
               static_cast<double>(unknowns) * std::log(static_cast<double>(measurements));
    }
    /// All data within their bounds.
    [[nodiscard]] bool explains() const { return inflation <= 1; }
};

/// How many sets of effects were tried, of those that were to be.
struct tried_candidates {
    struct count {
        std::size_t tried = 0, planned = 0;
    };
    count singles, pairs, larger;

    [[nodiscard]] std::size_t tried() const { return singles.tried + pairs.tried + larger.tried; }
    [[nodiscard]] std::size_t planned() const {
        return singles.planned + pairs.planned + larger.planned;
    }
    [[nodiscard]] bool complete() const { return tried() >= planned(); }
};

/// Which candidate it is.
struct choice_of_candidate {
    bool explained = false;
    std::size_t best = 0;            ///< index of the candidate; meaningful when `explained`
    std::vector<std::size_t> others; ///< that the data cannot tell from it, likeliest first
};

struct choice_options {
    /// Candidates whose score is worse by less than this are not told apart.
    double indistinguishable = 8;
    /// More effects must be better by this before they count as an alternative to fewer.
    double worth_another_effect = 12;
    std::size_t most_others = 2;
};

/// Decides by parsimony: among the candidates that explain all data, fewest effects first, then the
/// score. Candidates with more effects join the alternatives when the data speak for them.
[[nodiscard]] inline choice_of_candidate choose(std::vector<candidate> const& all,
                                                std::size_t measurements,
                                                choice_options const& options = {}) {
    choice_of_candidate result;
    std::vector<std::size_t> able;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].explains()) able.push_back(i);
    }
    if (able.empty()) return result;
    auto const score = [&](std::size_t i) { return all[i].score(measurements); };
    std::stable_sort(able.begin(), able.end(), [&](std::size_t a, std::size_t b) {
        auto const fewer = all[a].effects.size(), more = all[b].effects.size();
        return fewer != more ? fewer < more : score(a) < score(b);
    });
    result.explained = true;
    result.best = able.front();
    auto const holds = [&](std::size_t outer, std::size_t inner) {
        return std::includes(all[outer].effects.begin(), all[outer].effects.end(),
                             all[inner].effects.begin(), all[inner].effects.end());
    };
    for (auto const i : able) {
        if (i == result.best) continue;
        bool const same_size = all[i].effects.size() == all[result.best].effects.size();
        double const lost = score(i) - score(result.best);
        bool const alike = same_size && lost < options.indistinguishable;
        bool const better = !same_size && lost < -options.worth_another_effect;
        if (!alike && !better) continue;
        // A larger candidate stands for its own smaller parts once.
        bool const repeats =
            std::any_of(result.others.begin(), result.others.end(), [&](std::size_t o) {
                return all[o].effects.size() < all[i].effects.size() && holds(i, o);
            });
        if (!repeats) result.others.push_back(i);
    }
    std::stable_sort(result.others.begin(), result.others.end(),
                     [&](std::size_t a, std::size_t b) { return score(a) < score(b); });
    if (result.others.size() > options.most_others) result.others.resize(options.most_others);
    return result;
}

/// The candidate that comes closest, when none explains the data: fewest effects among those within
/// a twentieth of the least inflation.
/// @returns its index; 0 when there is none
[[nodiscard]] inline std::size_t closest_candidate(std::vector<candidate> const& all) {
    auto least = std::numeric_limits<double>::infinity();
    for (auto const& c : all) least = std::min(least, c.inflation);
    std::size_t result = all.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(all[i].inflation <= 1.05 * least)) continue;
        auto const rank = [&](std::size_t k) {
            return std::pair(all[k].effects.size(), all[k].inflation);
        };
        if (result == all.size() || rank(i) < rank(result)) result = i;
    }
    return result == all.size() ? 0 : result;
}

} // namespace sivid

#endif
