// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SCENARIO_NAMES_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SCENARIO_NAMES_HPP

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// Whether scenarios can stand in the name of an effect that acts in them only (`only_within`).
[[nodiscard]] inline bool can_stand_in_a_name(std::vector<std::string> const& scenarios) {
    constexpr std::size_t most = 8;
    return scenarios.size() <= most &&
           std::all_of(scenarios.begin(), scenarios.end(), [](std::string const& s) {
               return s.find_first_of("@+,<>") == std::string::npos;
           });
}

} // namespace sivid

#endif
