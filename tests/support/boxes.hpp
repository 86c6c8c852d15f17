// SPDX-License-Identifier: MIT
// What pavings must not get wrong, in exact arithmetic.
#ifndef SIVID_TESTS_SUPPORT_BOXES_HPP
#define SIVID_TESTS_SUPPORT_BOXES_HPP

#include "support/power_series.hpp"

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>

namespace support {

/// Products of exact differences.
inline mp volume(sivid::box const& x) {
    mp v = 1;
    for (auto const& s : x) v *= mp(s.upper()) - mp(s.lower());
    return v;
}

inline bool interiors_meet(sivid::box const& a, sivid::box const& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!(std::max(a[i].lower(), b[i].lower()) < std::min(a[i].upper(), b[i].upper()))) {
            return false;
        }
    }
    return true;
}

} // namespace support

#endif
