// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_AFFECTED_PROBLEM_HPP
#define SIVID_DIAGNOSIS_AFFECTED_PROBLEM_HPP

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

/// Sets the initial ranges of the states that effects added, for the parameters in the prior.
/// @throws std::domain_error where such a value is not defined
inline void start_added_states(identification_problem& problem) {
    auto const& about = problem.model.about;
    auto const constants = constant_ranges(problem.model, problem.choice, problem.prior);
    for (auto& e : problem.experiments) {
        std::vector<interval> sides(e.initial.begin(), e.initial.end());
        sides.resize(about.states.size());
        for (auto const& a : problem.model.added_states) {
            sides[a.state] = start_of(problem.model, a, constants, e.inputs, e.begin);
        }
        e.initial = box(std::move(sides));
    }
}

/// Whether a state that effects added starts at a value that the parameters decide: of its initial
/// range then only one value belongs to a parameter.
[[nodiscard]] inline bool starts_follow_parameters(identification_problem const& problem) {
    return std::any_of(
        problem.experiments.begin(), problem.experiments.end(), [&](experiment const& e) {
            return std::any_of(problem.model.added_states.begin(), problem.model.added_states.end(),
                               [&](added_state const& a) { return width(e.initial[a.state]) > 0; });
        });
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

/// The same experiments, with effects joined to the model. The parameters of the effects become
/// further unknowns, with the effects' priors; effects that act in some experiments only are
/// switched on in these.
///   A parameter that is feasible for `base` is feasible here with all effects neutral.
/// @throws std::invalid_argument  as `with`, and where nobody can tell how often readings had
///         wrapped (`effect::wraps`): `wraps_before`, for all T of the prior about which they leap,
///         or for a full turn of the channel's unit where that is one of them, and `wraps_of`
[[nodiscard]] SIVID_DECL identification_problem affected(identification_problem const& base,
                                                         std::vector<effect> const& effects);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/affected_problem.ipp>
#endif

#endif
