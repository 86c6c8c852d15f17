// SPDX-License-Identifier: MIT
// What a diagnosis says twice must agree with itself, whatever the truth is.
#ifndef WITHHELD_CONSISTENCY_HPP
#define WITHHELD_CONSISTENCY_HPP

#include "judge.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace withheld {

std::vector<finding> contradictions_in(nlohmann::json const& diagnosis);

} // namespace withheld

#endif
