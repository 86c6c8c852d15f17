// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_RANK_HPP
#define SIVID_DECISION_RANK_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/combination.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace sivid {

/// How hard the effects of parameters are bounded.
struct rank_options {
    double seconds = 10;
    std::size_t parts = 4000; ///< of the prior, at most
    /// Bounds need not be closer than this share of the effect, or of one error bound.
    double accuracy = 0.1;
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
};

/// The effect of a parameter on a channel: how far it alone can move a measurement.
struct parameter_effect {
    std::size_t parameter = 0;
    /// False: no equation carries it to the channel, and its effect is exactly 0.
    bool acts = true;
    double low = 0, high = std::numeric_limits<double>::infinity(); ///< in error bounds; proved
    /// Where `low` is reached: a measurement's time, start and parameters, and the two values.
    double time = 0;
    std::vector<double> start{}, at{};
    double from = 0, to = 0;
};

/// One channel of one experiment.
struct channel_effects {
    std::size_t experiment = 0, channel = 0;
    std::vector<parameter_effect> effects; ///< by parameter, in the order of the prior

    /// Positions in the order of effects, from 1 on, that the bounds leave a parameter; equal ends
    /// where its place is certified.
    struct place {
        std::size_t best = 1, worst = 1;
    };
    [[nodiscard]] place place_of(std::size_t parameter) const {
        place result;
        auto const& mine = effects[parameter];
        for (auto const& other : effects) {
            if (other.parameter == parameter) continue;
            result.best += other.low > mine.high ? 1 : 0;
            result.worst += other.high > mine.low ? 1 : 0;
        }
        return result;
    }
    /// Parameters, the strongest upper bound first.
    [[nodiscard]] std::vector<std::size_t> order() const;
};

/// Measurements of a channel whose bounds have no width: whatever moves them moves them by any
/// number of error bounds, and so they do not count.
struct exact_measurements {
    std::size_t experiment = 0, channel = 0, count = 0;
    std::vector<bool> acts; ///< by parameter: some equation carries it to the channel
};

struct ranking {
    std::vector<channel_effects> channels; ///< with measurements that count
    std::vector<exact_measurements> exact;
    /// Which parameters act through products only: no measurement of any channel tells them apart.
    dependence_structure combinations;
    bool complete = false; ///< all bounds are as close as was asked for
    std::size_t parts = 0, integrations = 0;
    double seconds = 0;

    /// The largest effect of a parameter on any measurement of any channel, of those that count.
    [[nodiscard]] interval overall(std::size_t parameter) const;
    /// Whether some equation carries a parameter to a channel that is measured; else it cannot
    /// matter.
    [[nodiscard]] bool acts(std::size_t parameter) const;
    /// The same, to measurements that do not count: how far it moves them is not known.
    [[nodiscard]] bool moves_exact(std::size_t parameter) const;
};

/// Bounds the effect of each parameter on each measured channel, over the whole prior.
///   \f$ e_j = \max_{k, x_0, p_{-j}} \max_{a, b} |y_k(x_0, p_{-j}, a) - y_k(x_0, p_{-j}, b)| / w_k
///   \f$: over all measurements k of the channel, all starts, all values of the other parameters,
///   and any two values a, b of parameter j, all in their priors, with the same inputs; w_k is half
///   the width of the measurement's bound. What was measured does not enter, only when and how
///   exactly. Measurements without a bound are moved by no error bound; those with one of width 0
///   do not count (`exact`).
///   From above: runs over parts of the prior give the outputs as polynomials, of whose terms only
///   those with p_j change with it; along p_j the parts add up. Parts are split where a bound is
///   loose. From below: validated runs of points.
/// @throws std::invalid_argument  an invalid problem, a model with delays, starts that follow
///         parameters
/// @guarantee  every effect lies in [low, high]; high is infinite where runs over some part of the
///             prior do not reach a measurement
/// @cost  integrations of parts, as those of an identification
[[nodiscard]] SIVID_DECL ranking rank(identification_problem const& problem,
                                      rank_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/rank.ipp>
#endif

#endif
