// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_OPTIONS_HPP
#define SIVID_ENCLOSURE_OPTIONS_HPP

#include <sivid/enclosure/runge_kutta/tableau.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

namespace sivid {

/// Which sets are carried along the trajectories.
enum class carried_set {
    taylor_model, ///< polynomials in the unknowns: tight over wide boxes
    doubleton     ///< first order: Lohner's sets, the readable reference
};

/// How trajectories are enclosed. Every choice is sound; they trade width against time.
struct enclosure_options {
    /// Highest order of the Taylor series. Each step uses the lowest order that meets the
    /// tolerance.
    std::size_t order = 14;
    /// Order of the series of the variational equation; 0 follows the order of the step.
    std::size_t variational_order = 0;
    /// A Runge-Kutta method for the centre trajectory instead of the Taylor series.
    std::optional<tableau> method = std::nullopt;
    /// Largest truncation error of one step in state i, as a half-width:
    /// tolerance * (size of x_i) + relative_tolerance * width of the enclosure of x_i, where the
    /// size is the largest |x_i| so far, or a millionth of the state's own range if that is more.
    double tolerance = 1e-13;
    double relative_tolerance = 1e-4;
    /// Steps are never shorter than this share of the span, except where an input's knot or the end
    /// is closer, or a kink is crossed.
    double minimum_step = 1e-8;
    /// Steps are never longer [the model's unit of time]; nothing: than a tenth of the span, as a
    /// tube says no more of a time than what its step sweeps (`examples/short/trajectory`).
    std::optional<double> maximum_step = std::nullopt;
    /// The time of which lengths of steps are shares [the model's unit of time]: see `for_span`.
    double span = 1;
    std::size_t maximum_steps = 1'000'000;
    /// Give up when the enclosure of a state is wider than this many times the state's own range.
    double widest = 2.0;
    /// Give up when what a Taylor-model set has lost to its generators exceeds this share of what
    /// its polynomial spans (or of a fiftieth of the state's own range, if that is more).
    double remainder_share = 0.5;
    /// Asked before each step, by the thread that makes it: false ends the enclosure there
    /// (`failure_reason::cancelled`); what was proved until then stays proved. Empty: never asked.
    std::function<bool()> keep_going = nullptr;

    [[nodiscard]] bool cancelled() const { return keep_going && !keep_going(); }
    [[nodiscard]] double shortest_step() const { return minimum_step * span; }
    /// Unless it is asked for, no rounding leaves a short step at the end of ten.
    [[nodiscard]] double longest_step() const {
        return maximum_step.value_or(span / 10 * (1 + 1e-9));
    }
};

/// The options for a span: a model may count in microseconds or in days.
/// @param span  in the unit of time of the model; 0, where there is nothing to do, changes nothing
[[nodiscard]] inline enclosure_options for_span(enclosure_options options, double span) {
    if (span > 0) options.span = span;
    return options;
}

/// What a Runge-Kutta `method` of order p can reach in steps that are worth taking: a tolerance of
/// at least \f$ 10^{-2-2p} \f$. Without a method the options as they are.
[[nodiscard]] inline enclosure_options for_method(enclosure_options options) {
    if (!options.method) return options;
    double const order = static_cast<double>(options.method->order);
    options.tolerance = std::max(options.tolerance, std::pow(10.0, -2 - 2 * order));
    options.minimum_step = std::min(options.minimum_step, 1e-6);
    return options;
}

} // namespace sivid

#endif
