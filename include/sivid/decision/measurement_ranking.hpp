// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MEASUREMENT_RANKING_HPP
#define SIVID_DECISION_MEASUREMENT_RANKING_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/ranking/measurement_group.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/paving/verdict.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sivid {

/// How hard what measurements are worth is bounded.
struct measurement_ranking_options {
    double seconds = 10;
    std::size_t boxes = 100'000; ///< of each search, at most
    /// Bounds of a growth need not be closer than this, as a share.
    double accuracy = 0.1;
    std::size_t times = 4; ///< parts of the time that are compared
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
    /// What is tried before each search.
    sivid::strategy strategy = default_strategy();
};

/// What a group of measurements is worth.
struct measurement_worth {
    measurement_group what;
    std::size_t measurements = 0;
    /// Volume of the parameters that explain all but these, against those that explain all; proved.
    interval growth{1.0, std::numeric_limits<double>::infinity()};
    std::size_t boxes = 0;

    /// The other measurements imply these.
    [[nodiscard]] bool changes_nothing() const { return growth.upper() == 1; }
};

struct measurement_ranking {
    verdict explained = verdict::undecided; ///< whether anything explains all of the data
    interval volume;                        ///< of what does, against the prior
    /// What the volumes are of: parameters, or products of them that the data tell. Parameters
    /// where such products share a factor: not all of their values together are reached then.
    std::vector<std::string> coordinates;
    std::vector<measurement_worth> groups; ///< what is worth most for certain comes first
    bool complete = false;                 ///< all bounds are as close as was asked for
    std::size_t integrations = 0;
    double seconds = 0;
};

/// By how much would the set of parameters that explain the data grow without some of them?
///   S explains all measurements, \f$ S_g \supseteq S \f$ all but those of a group g. S is
///   identified; then, for each group, the difference \f$ D = S_g \setminus S \f$ is paved: what
///   the others exclude is outside it, and so is what meets all of g whatever the start. The growth
///   \f$ 1 + |D| / |S| \f$ is bounded by the inner and outer volumes of both. Where nothing of D
///   is left, g changes nothing: its measurements follow from the others.
/// @param groups  those to compare; none: each channel, each experiment, and `options.times` equal
///                parts of the time that have measurements, each from its first one on
/// @throws std::invalid_argument  an invalid problem, or two experiments of one name
/// @guarantee  each growth lies within its bounds; without an upper one where nothing is proved
///             inside S. No groups are compared when nothing explains the data.
/// @cost  an identification, and one more for each group
[[nodiscard]] SIVID_DECL measurement_ranking rank_measurements(
    identification_problem const& problem, measurement_ranking_options const& options = {},
    std::vector<measurement_group> groups = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/measurement_ranking.ipp>
#endif

#endif
