// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_IDENTIFIABILITY_HPP
#define HOVERCRAFT_IDENTIFIABILITY_HPP

#include <sivid/paving/identification.hpp>

#include <iosfwd>

namespace hovercraft_example {

/// Prints what data like these can tell about the unknowns: at the witness, or in the middle of
/// what was not excluded.
void print_identifiability(sivid::identification_problem const& problem,
                           sivid::identification const& found, std::ostream& out);

} // namespace hovercraft_example

#endif
