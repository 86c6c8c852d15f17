// SPDX-License-Identifier: MIT
#include "identifiability.hpp"

#include <sivid/space/box.hpp>

namespace hovercraft_example {

sivid::identifiability identifiability_at(sivid::identification_problem const& problem,
                                          sivid::identification const& found,
                                          std::function<bool()> const& keep_going) {
    sivid::identifiability_options options;
    options.enclosure.keep_going = keep_going;
    auto at = is_empty(found.hull) ? mid(problem.prior) : mid(found.hull);
    if (found.witness) {
        at = found.witness->parameters;
        for (auto const& start : found.witness->starts) {
            options.at_starts.push_back(sivid::point_box(start));
        }
    }
    return sivid::identifiability_of(problem, sivid::point_box(at), options);
}

std::string place_of_identifiability(sivid::identification const& found) {
    return found.witness ? "at the witness" : "at the middle of what is left";
}

} // namespace hovercraft_example
