// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_ONLINE_HPP
#define HOVERCRAFT_ONLINE_HPP

#include <sivid/paving/online_identification.hpp>

#include <iosfwd>

namespace hovercraft_example {

/// Feeds the measurements of a problem in the order of their times, those of one time together, and
/// writes a line for each update: the time of the samples, how long the update took, what is known
/// then.
[[nodiscard]] sivid::identification identify_online(sivid::identification_problem problem,
                                                    sivid::online_options const& options,
                                                    std::ostream& lines);

} // namespace hovercraft_example

#endif
