// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_HULLS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_HULLS_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/data_test_options.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sivid {

struct effect_hull_options {
    double seconds = 10;
    std::size_t boxes = 4000; ///< of the last search; a slice gets a share of them
    /// A delay or a play is told no more finely than this share of its prior.
    double accuracy = 1.0 / 128;
    std::function<bool()> keep_going{}; ///< false ends it with what is proved until then
    data_test_options test{};
};

/// Encloses all parameters of a model with effects that explain the data: those of the model
/// itself, then those of the effects.
///   A delay or a play has no enclosure over a range, and the equation of a lag is singular where
/// its time constant is 0. Over a slice of their priors they are inputs with error bounds
/// (`delayed_within`, `played`, `lagged_within`): slices that cannot explain the data are excluded,
/// the hulls of the others are joined. Short time constants are such a slice; the others are an
/// ordinary state.
/// @param base     without the effects
/// @param effects  at most one with a delay or a play of an input; delays of channels are left at
/// their prior
/// @guarantee  every parameter of `affected(base, effects)` that explains the data lies in the
///             result; empty when none does
/// @throws std::invalid_argument  as `affected`
/// @cost  a search for each slice, until its hull rests, within the limits
[[nodiscard]] SIVID_DECL box effect_hulls(identification_problem const& base,
                                          std::vector<effect> const& effects,
                                          effect_hull_options const& options = {});

/// A problem with effects whose parameters lie in a box, as one without a delay or a play of an
/// input: that is an input with error bounds for its range there (`late_by_parameter`, with the
/// distance from the range's middle as a parameter in the delay's place; `delayed_within`,
/// `played`, without a parameter).
/// @returns  nothing where more than one input has a memory, where a channel is late, and where the
///           input is a formula
/// @guarantee  whatever the effects' problem has as an output for parameters in the box, this one
///             has for some input within its errors
[[nodiscard]] SIVID_DECL std::optional<identification_problem>
without_memory(identification_problem const& base, std::vector<effect> const& effects,
               box const& parameters);

/// What is known of an effect that begins or ends in the midst of experiments.
struct episode_hulls {
    box parameters; ///< as of `effect_hulls`, whenever the effect acts; empty sides: none explain
    /// When it begins and ends, for each experiment: from its begin (or earlier) to its last
    /// measurement (or later, or never).
    std::vector<switch_times> times;
};

/// Encloses when an effect may act, in each experiment at times of its own, and all parameters with
/// which it then explains the data. Over a slice of such times its switch is an input with error
/// bounds (`switched_within`); slices at either end that cannot explain the data are cut off, as
/// long as that helps and there is time.
/// @param e  without a delay and a state of its own. Where it begins later, it may begin at any
/// time
///           in each experiment; where it ends, end at any time; else it does not. When it does
///           says only which slices need not be tried.
/// @guarantee  whatever parameters explain the data with the effect switched on, or off, or on and
///             off again at a time in each experiment, or never: they and these times lie in the
///             result
/// @cost  two short searches for each time, again and again while some exclude, within the limits
[[nodiscard]] SIVID_DECL episode_hulls hulls_of_episodes(identification_problem const& base,
                                                         effect e,
                                                         effect_hull_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/effect_hulls.ipp>
#endif

#endif
