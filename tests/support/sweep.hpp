// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_SUPPORT_SWEEP_HPP
#define SIVID_TESTS_SUPPORT_SWEEP_HPP

namespace support {

#ifdef SIVID_LONG_TESTS
inline constexpr bool long_sweeps = true;
#else
inline constexpr bool long_sweeps = false;
#endif

/// How many cases a sweep takes: the first few in the check, all in the build of the long tests.
template <class Count>
constexpr Count swept(Count few, Count all) {
    return long_sweeps ? all : few;
}

} // namespace support

#endif // SIVID_TESTS_SUPPORT_SWEEP_HPP
