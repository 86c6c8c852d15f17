// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_HULLS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EFFECT_HULLS_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/candidate/effect_hull_options.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <vector>

namespace sivid {

/// Encloses all parameters of a model with effects that explain the data: those of the model
/// itself, then those of the effects.
///   A delay, a play or a rate limit has no enclosure over a range, thresholds are kinks, and a
///   lag's equation is
/// singular where its time constant is 0. Over a slice of their priors they are inputs with error
/// bounds (`sliced_input_of`, `lagged_within`): slices that cannot explain the data are excluded,
/// the hulls of the others are joined. Short time constants are such a slice; the others are an
/// ordinary state, octave by octave.
/// @param base     without the effects
/// @param effects  delays, plays and rate limits of different inputs, and one delay of channels:
/// where
///                 `sliced_input_of` cannot take them apart, all keep their priors
/// @guarantee  every parameter of `affected(base, effects)` that explains the data lies in the
///             result; empty when none does
/// @throws std::invalid_argument  as `affected`
/// @cost  a search for each slice, until its hull rests, within the limits
[[nodiscard]] SIVID_DECL explained_hull effect_hulls(identification_problem const& base,
                                                     std::vector<effect> const& effects,
                                                     effect_hull_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/effect_hulls.ipp>
#endif

#endif
