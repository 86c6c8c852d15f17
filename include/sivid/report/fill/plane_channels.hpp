// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_FILL_PLANE_CHANNELS_HPP
#define SIVID_REPORT_FILL_PLANE_CHANNELS_HPP

#include <string>

namespace sivid::report {

/// Which channels are a position in the plane; `heading` may be empty.
struct plane_channels {
    std::string x = "x";
    std::string y = "y";
    std::string heading{};
};

} // namespace sivid::report

#endif
