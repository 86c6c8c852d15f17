// SPDX-License-Identifier: MIT
#include "identifiability.hpp"

#include <sivid/report/identifiability_words.hpp>

#include <ostream>

namespace hovercraft_example {

void print_identifiability(sivid::identification_problem const& problem,
                           sivid::identification const& found, std::ostream& out) {
    sivid::identifiability_options options;
    auto at = is_empty(found.hull) ? mid(problem.prior) : mid(found.hull);
    if (found.witness) {
        at = found.witness->parameters;
        for (auto const& start : found.witness->starts) {
            options.at_starts.push_back(sivid::point_box(start));
        }
    }
    auto const told = sivid::identifiability_of(problem, sivid::point_box(at), options);
    out << "  what such data tell, at "
        << (found.witness ? "the witness" : "the middle of what is left") << ":\n";
    for (auto const& line : sivid::report::identifiability_words(told)) {
        out << "    " << line << "\n";
    }
}

} // namespace hovercraft_example
