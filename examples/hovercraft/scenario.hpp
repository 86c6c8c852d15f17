// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_SCENARIO_HPP
#define HOVERCRAFT_SCENARIO_HPP

#include <sivid/io/scenario.hpp>

#include <string>
#include <string_view>
#include <vector>

/// The scenarios that are built in; the format: <sivid/io/scenario.hpp>.
namespace hovercraft_example {

using sivid::exact_signal;
using sivid::input_shape;
using sivid::parse_scenario;
using sivid::read_scenario;
using sivid::scenario_description;

/// A scenario that is built in: Table 2.4 of the report as S1, S2, S3, and those of `scenarios/`.
struct built_in_scenario {
    std::string_view name, text;
};
/// All of them; the build puts the files of `scenarios/` here.
[[nodiscard]] std::vector<built_in_scenario> const& built_in_scenarios();

/// The scenarios that a command line asks for: "all" (S1, S2, S3), a built-in name, or a file.
/// @throws sivid::input_error
[[nodiscard]] std::vector<scenario_description> find_scenarios(std::string const& wanted,
                                                               sivid::model_names const& model);

} // namespace hovercraft_example

#endif
