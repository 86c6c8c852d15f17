// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_POSED_PROBLEM_HPP
#define HOVERCRAFT_POSED_PROBLEM_HPP

#include "effects.hpp"
#include "generate.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/named_effects.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hovercraft_example {

/// A problem, and effects to be joined to it over whose ranges no run goes: those that remember (a
/// delay, a play, a rate limit), or begin where their parameters say.
struct remembering_problem {
    sivid::identification_problem base;
    std::vector<sivid::effect> effects;
};

/// What a data set's result with effects rests on besides what is proved.
inline std::vector<std::string> assumptions_of(sivid::dataset const& data,
                                               sivid::recorded_model const& model,
                                               std::vector<std::string> const& effects) {
    auto result = data.assumptions;
    auto const named =
        sivid::effects_named(sivid::chosen_effects(catalogue(), data), effects, &model.about);
    for (auto& words : sivid::wrap_assumptions(named)) result.push_back(std::move(words));
    return result;
}

/// The identification problem of a data set, effects of the catalogue joined to its model.
/// @param remembering  receives what it was made of where it has such effects; null: they are
///                     refused
/// @throws bad_request  for an effect that is unknown, given twice, or whose parameters cannot be
///                      identified with proof
[[nodiscard]] inline sivid::identification_problem
posed(sivid::dataset const& data, sivid::recorded_model const& model,
      std::vector<std::string> const& effects,
      std::optional<sivid::outlier_rule> const& outliers = std::nullopt,
      std::optional<remembering_problem>* remembering = nullptr) {
    auto problem = sivid::problem_from_dataset(data, model, outliers);
    if (effects.empty()) return problem;
    auto base = problem;
    std::vector<sivid::effect> named;
    try {
        named =
            sivid::effects_named(sivid::chosen_effects(catalogue(), data), effects, &model.about);
        for (auto const& e : named) {
            for (auto const& scenario : e.only_in)
                (void)sivid::index_of(problem.experiments, scenario, "scenario to fit");
        }
        problem = sivid::affected(problem, named);
    } catch (std::invalid_argument const& e) {
        throw bad_request(e.what());
    }
    bool const remembers = problem.model.has_memory();
    bool const partial =
        std::any_of(named.begin(), named.end(), [](auto const& e) { return !e.only_in.empty(); });
    if (remembering != nullptr && !partial &&
        (remembers || sivid::starts_follow_parameters(problem))) {
        *remembering = remembering_problem{std::move(base), std::move(named)};
        return problem;
    }
    if (remembers)
        throw bad_request("an effect that delays, a backlash or a rate limit cannot be joined "
                          "here yet; `identify` bounds those that act everywhere, `diagnose` "
                          "all, and both verify them at points");
    if (sivid::starts_follow_parameters(problem))
        throw bad_request("these effects together begin where their parameters say, which an "
                          "identification cannot follow yet; `diagnose` tries them at points");
    return problem;
}

/// What was identified, for people: the data set, and what was joined to the model.
[[nodiscard]] inline std::string title_of(sivid::dataset const& data,
                                          std::vector<std::string> const& effects) {
    std::string title = data.id;
    for (std::size_t k = 0; k < effects.size(); ++k)
        title += (k == 0 ? " with " : k + 1 == effects.size() ? " and " : ", ") + effects[k];
    return title;
}

} // namespace hovercraft_example

#endif
