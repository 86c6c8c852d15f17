// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_ONLINE_HPP
#define HOVERCRAFT_ONLINE_HPP

#include <sivid/paving/online_identification.hpp>
#include <sivid/work_limit.hpp>

#include <functional>
#include <iosfwd>

namespace hovercraft_example {

/// Feeds the measurements of a problem in the order of their times, those of one time together, and
/// writes a line for each update: the time of the samples, how long the update took, what is known
/// then. When the limit is reached the measurements that are left come all at once, so that the
/// result is of all of them.
/// @param stopped  whether somebody said stop, for the reason that is given then
[[nodiscard]] sivid::identification
identify_online(sivid::identification_problem problem, sivid::online_options options,
                sivid::work_limit limit, std::function<bool()> const& stopped, std::ostream& lines);

} // namespace hovercraft_example

#endif
