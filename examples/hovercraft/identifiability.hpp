// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_IDENTIFIABILITY_HPP
#define HOVERCRAFT_IDENTIFIABILITY_HPP

#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identification.hpp>

#include <functional>
#include <string>

namespace hovercraft_example {

/// What data like these can tell about the unknowns: at the witness, or in the middle of what was
/// not excluded.
sivid::identifiability identifiability_at(sivid::identification_problem const& problem,
                                          sivid::identification const& found,
                                          std::function<bool()> const& keep_going = {});

/// Where that is, in words.
std::string place_of_identifiability(sivid::identification const& found);

} // namespace hovercraft_example

#endif
