// SPDX-License-Identifier: MIT
#include "scenario.hpp"

#include <sivid/io/input_error.hpp>

namespace hovercraft_example {

std::vector<scenario_description> find_scenarios(std::string const& wanted,
                                                 sivid::model_names const& model) {
    std::vector<scenario_description> result;
    std::string known;
    for (auto const& s : built_in_scenarios()) {
        known += std::string{known.empty() ? "" : ", "} + std::string{s.name};
        bool const of_table =
            wanted == "all" && (s.name == "S1" || s.name == "S2" || s.name == "S3");
        if (s.name != wanted && !of_table) continue;
        auto const file = std::string{"scenario "} + std::string{s.name};
        result.push_back(parse_scenario(file, std::string{s.text}, model));
    }
    if (!result.empty()) return result;
    if (!std::filesystem::exists(wanted))
        throw sivid::input_error{{.file = wanted},
                                 "no such scenario and no such file",
                                 std::string{"give a JSON file, or one of: all, "} + known};
    return {read_scenario(wanted, model)};
}

} // namespace hovercraft_example
