// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SLICED_INPUT_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SLICED_INPUT_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sivid {

/// A problem in which parameters of the effects change recorded inputs in a way that enclosures
/// follow badly: delays, also of channels, plays, dead bands, saturations. Over ranges of these
/// parameters the inputs have error bounds, and where that is possible they are lines in the
/// parameter besides, which keeps its place among the unknowns (`late_by_parameter`,
/// `threshold_by_parameter`, `with_late_channels`); else it has none there (`delayed_within`,
/// `played`).
struct sliced_input {
    struct side {
        std::size_t index = 0;     ///< in the prior of all parameters
        bool is_parameter = false; ///< whether it stays an unknown: the distance from its middle
    };
    std::vector<side> sides; ///< one at least
    /// The problem over a box of all parameters. Its unknowns have their names, in some order.
    std::function<identification_problem(box const&)> over;
    /// What the data tell that no such parameter touches: of inputs that stand still, on channels
    /// that are not late. Its unknowns are the other parameters.
    std::optional<identification_problem> untouched;
};

/// @param base, effects  outlive what is returned
/// @param beside  further experiments, which are to be posed in the same form
/// @returns  nothing where no effect is such a one; where the input of one that has to be is a
///           formula, or two change one input
/// @guarantee  whatever outputs the effects' problem has for parameters in the box, the one over
///             the box has for some input within its errors, all else being the same; with late
///             channels experiments are split, and samples may be left out
[[nodiscard]] SIVID_DECL std::optional<sliced_input>
sliced_input_of(identification_problem const& base, std::vector<effect> const& effects,
                std::vector<experiment> const& beside = {});

/// What is left of all parameters once a problem over their box leaves `found` of its unknowns;
/// nothing where that is empty.
/// @param whole  the problem of all parameters, whose names count
[[nodiscard]] SIVID_DECL std::optional<explained_hull>
explained_by(identification_problem const& whole, sliced_input const& sliced, explained_hull all,
             identification_problem const& over, explained_hull const& found);

/// Products of all parameters that are products of the problem's unknowns over a box, too: those
/// of no parameter that is told from its middle there. By the order of its unknowns.
[[nodiscard]] SIVID_DECL std::vector<combination_hull>
products_in(identification_problem const& over, identification_problem const& whole,
            sliced_input const& sliced, std::vector<combination_hull> const& products);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/candidate/impl/sliced_input.ipp>
#endif

#endif
