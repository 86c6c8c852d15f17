// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_POSED_PROBLEM_HPP
#define HOVERCRAFT_POSED_PROBLEM_HPP

#include "effects.hpp"
#include "generate.hpp"

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/named_effects.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hovercraft_example {

/// The identification problem of a data set, effects of the catalogue joined to its model.
/// @throws bad_request  for an effect that is unknown, given twice, or whose parameters cannot be
///                      identified with proof
[[nodiscard]] inline sivid::identification_problem
posed(sivid::dataset const& data, sivid::recorded_model const& model,
      std::vector<std::string> const& effects,
      std::optional<sivid::outlier_rule> const& outliers = std::nullopt) {
    auto problem = sivid::problem_from_dataset(data, model, outliers);
    if (effects.empty()) return problem;
    try {
        auto const named =
            sivid::effects_named(sivid::chosen_effects(catalogue(), data), effects, &model.about);
        for (auto const& e : named) {
            for (auto const& scenario : e.only_in)
                (void)sivid::index_of(problem.experiments, scenario, "scenario to fit");
        }
        problem = sivid::affected(problem, named);
    } catch (std::invalid_argument const& e) {
        throw bad_request(e.what());
    }
    if (problem.model.has_memory())
        throw bad_request("an effect that delays, a backlash or a rate limit cannot be joined here "
                          "yet; `diagnose` bounds those of an input, and verifies them at points");
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
