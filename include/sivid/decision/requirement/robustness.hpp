// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_ROBUSTNESS_HPP
#define SIVID_DECISION_REQUIREMENT_ROBUSTNESS_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// Where a bound of a robustness comes from.
struct decisive_place {
    std::size_t comparison = 0; ///< index into `requirement::margins`
    std::size_t segment = 0;
};

/// What is known of the truth of a formula, for all motions of a set.
struct truth {
    double low = -std::numeric_limits<double>::infinity(); ///< the robustness is at least this,
    double high = std::numeric_limits<double>::infinity(); ///< and at most this
    bool certain = false;                                  ///< it holds for all of them
    bool possible = true;                                  ///< it may hold for one of them
    decisive_place low_from{}, high_from{};
    bool kept = true; ///< what it is provided for is proved of all of them, or nothing is known

    [[nodiscard]] bool proved() const { return certain; }
    [[nodiscard]] bool refuted() const { return !possible && kept; }
    /// For none of them it, and what it is provided for, will be proved.
    [[nodiscard]] bool hopeless() const { return !possible; }
};

/// A margin within [low, high] at all instants of a segment: what a comparison says there.
[[nodiscard]] SIVID_DECL truth truth_of_margin(double low, double high, bool strict,
                                               decisive_place where);

/// Bounds of the margins of all comparisons over time, in segments: the instants of a grid, 2 k,
/// and what lies between them, 2 k + 1, ends excluded.
struct margin_bounds {
    std::vector<double> times; ///< increasing
    /// [comparison][segment], 2 n - 1 segments; what is not known is infinite.
    std::vector<std::vector<double>> low, high;

    [[nodiscard]] std::size_t segments() const { return 2 * times.size() - 1; }
    [[nodiscard]] double begin_of(std::size_t s) const { return times[s / 2]; }
    [[nodiscard]] double end_of(std::size_t s) const { return times[(s + 1) / 2]; }
};

/// Bounds the truth and the robustness of a requirement at time 0.
/// @given  the margins are bounded at every instant of each segment, for all motions of the set;
///         `bounds.times` begins with 0 and ends with the end of the motion
/// @guarantee  for each motion of the set; dense in time
/// @cost  O(segments) for each operator that is asked once, O(segments^2) for nested ones
[[nodiscard]] SIVID_DECL truth evaluate(requirement const& what, margin_bounds const& bounds);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/requirement/impl/robustness.ipp>
#endif

#endif
