// SPDX-License-Identifier: MIT
// The motion that a witness of a diagnosis describes.
#ifndef WITHHELD_WITNESS_HPP
#define WITHHELD_WITNESS_HPP

#include "recorded.hpp"
#include "simulate.hpp"

#include <nlohmann/json.hpp>

#include <optional>

namespace withheld {

/// The model with the effects of a cause at a witness; nothing when a value is left open.
std::optional<world> world_of(recording const& data, nlohmann::json const& cause,
                              nlohmann::json const& witness);

/// Where a witness starts a scenario: the middle of what it may where that is not said.
channels start_of(scenario const& plan, nlohmann::json const& witness);

} // namespace withheld

#endif
