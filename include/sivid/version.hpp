// SPDX-License-Identifier: MIT
#ifndef SIVID_VERSION_HPP
#define SIVID_VERSION_HPP

#include <string_view>

// Semantic version; the build reads these three lines.
#define SIVID_VERSION_MAJOR 0
#define SIVID_VERSION_MINOR 1
#define SIVID_VERSION_PATCH 0

#define SIVID_DETAIL_TEXT2(x) #x
#define SIVID_DETAIL_TEXT(x) SIVID_DETAIL_TEXT2(x)

namespace sivid {

/// The version of this copy of the library, "major.minor.patch".
inline constexpr std::string_view version =
    SIVID_DETAIL_TEXT(SIVID_VERSION_MAJOR) "." SIVID_DETAIL_TEXT(
        SIVID_VERSION_MINOR) "." SIVID_DETAIL_TEXT(SIVID_VERSION_PATCH);

} // namespace sivid

#undef SIVID_DETAIL_TEXT
#undef SIVID_DETAIL_TEXT2

#endif // SIVID_VERSION_HPP
