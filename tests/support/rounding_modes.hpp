// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_SUPPORT_ROUNDING_MODES_HPP
#define SIVID_TESTS_SUPPORT_ROUNDING_MODES_HPP

#include <cfenv>

namespace support {

inline constexpr int rounding_modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// Runs f in a rounding mode. The call is not inlined, so that nothing moves out of the mode.
template <class F>
[[gnu::noinline]] void in_mode(int mode, F const& f) {
    std::fesetround(mode);
    f();
    std::fesetround(FE_TONEAREST);
}

} // namespace support

#endif
