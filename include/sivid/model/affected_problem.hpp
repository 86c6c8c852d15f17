// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_AFFECTED_PROBLEM_HPP
#define SIVID_MODEL_AFFECTED_PROBLEM_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// The time that an experiment tells of: from its begin to its last measurement.
[[nodiscard]] inline interval measured_time(experiment const& e) {
    return interval(e.begin, e.end());
}

/// What counted readings rest on, in words: for each effect that shows a channel modulo something.
[[nodiscard]] inline std::vector<std::string> wrap_assumptions(std::vector<effect> const& effects) {
    std::vector<std::string> words;
    for (auto const& e : effects)
        if (e.wraps)
            words.push_back(e.wraps->channel + " has wrapped as often as its readings leap by " +
                            nearest_text(e.wraps->least) +
                            " or more, moves by less from one to the next, and is first read "
                            "within half a turn of where it starts (turns of 2 pi or 360 where its "
                            "unit is rad or deg and the leaps allow it)");
    return words;
}

/// The effect with a switch that may change in the midst of any experiment of a problem.
[[nodiscard]] inline effect switched_within_all(identification_problem const& base, effect e) {
    std::vector<std::string> names;
    std::vector<double> middles;
    for (auto const& x : base.experiments) {
        names.push_back(x.name);
        middles.push_back(x.begin + 0.5 * (x.end() - x.begin));
    }
    return only_within(std::move(e), std::move(names), std::move(middles));
}

/// The same experiments, with effects joined to the model. The parameters of the effects become
/// further unknowns, with the effects' priors; effects that act in some experiments only are
/// switched on in these.
///   A parameter that is feasible for `base` is feasible here with all effects neutral.
/// @throws std::invalid_argument  as `with`, where an experiment lacks an input or a state, and
///         where nobody can tell how often readings had wrapped (`effect::wraps`): `wraps_before`,
///         for all T of the prior about which they leap, or for a full turn of the channel's unit
///         where that is one of them, and `wraps_of`
[[nodiscard]] SIVID_DECL identification_problem affected(identification_problem const& base,
                                                         std::vector<effect> const& effects);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/affected_problem.ipp>
#endif

#endif
