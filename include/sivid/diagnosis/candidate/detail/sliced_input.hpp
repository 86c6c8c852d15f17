// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SLICED_INPUT_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SLICED_INPUT_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sivid {

/// A problem in which one parameter of the effects changes a recorded input in a way that
/// enclosures follow badly (a delay, also of channels, a play, a dead band, a saturation). Over a
/// range of that parameter the input is one with error bounds, and where that is possible a line in
/// the parameter besides, which keeps its place among the unknowns (`late_by_parameter`,
/// `threshold_by_parameter`, `with_late_channels`); else it has none there (`delayed_within`,
/// `played`).
struct sliced_input {
    std::size_t side = 0;      ///< of the prior of all parameters
    bool is_parameter = false; ///< whether it stays an unknown
    /// The problem over a box of all parameters.
    ///   Its unknown for the side, if any, is the distance from the middle of the side.
    std::function<identification_problem(box const&)> over;
};

/// @param base, effects  outlive what is returned
/// @returns  nothing where no effect is such a one, or several are delays and plays; where the
///           input is a formula, or is changed by another effect before
/// @guarantee  whatever outputs the effects' problem has for parameters in the box, the one over
///             the box has for some input within its errors, all else being the same; with late
///             channels experiments are split, and samples may be left out
[[nodiscard]] SIVID_DECL std::optional<sliced_input>
sliced_input_of(identification_problem const& base, std::vector<effect> const& effects);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/sliced_input.ipp>
#endif

#endif
