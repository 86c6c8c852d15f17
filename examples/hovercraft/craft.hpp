// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_CRAFT_HPP
#define HOVERCRAFT_CRAFT_HPP

#include <sivid/app/robot.hpp>

#include <vector>

namespace hovercraft_example {

/// Table 2.4 of the report as S1, S2, S3, and the other files of `scenarios`, put here by the
/// build.
[[nodiscard]] std::vector<sivid::app::built_in_scenario> built_in_scenarios();

/// The hovercraft with all that its program knows of it.
[[nodiscard]] sivid::app::robot craft();

} // namespace hovercraft_example

#endif
