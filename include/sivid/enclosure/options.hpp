// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_OPTIONS_HPP
#define SIVID_ENCLOSURE_OPTIONS_HPP

#include <sivid/enclosure/runge_kutta/tableau.hpp>

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
    /// tolerance * (1 + |x_i|) + relative_tolerance * width of the enclosure of x_i.
    double tolerance = 1e-13;
    double relative_tolerance = 1e-4;
    /// Steps are never shorter than this, except where an input's knot or the end is closer, or a
    /// kink is crossed. Here and below in the unit of time of the model. Runs of experiments
    /// (`run_options`) scale both for records that last less than one unit, or more than a hundred.
    double minimum_step = 1e-7;
    double maximum_step = 1.0;
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
};

} // namespace sivid

#endif
