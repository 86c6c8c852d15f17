// SPDX-License-Identifier: MIT
#include <sivid/number/guard.hpp>

#include "support/catch.hpp"

#include <cfenv>
#include <string>

using namespace sivid;

namespace {

/// The message with which the guard refuses while `bits` of MXCSR are set; empty if it accepts.
std::string refusal(unsigned bits) {
    unsigned const before = detail::read_mxcsr();
    detail::write_mxcsr(before | bits);
    std::string message;
    try {
        require_sound_environment();
    } catch (unsound_environment const& e) {
        detail::write_mxcsr(before);
        message = e.what();
    }
    detail::write_mxcsr(before);
    return message;
}

} // namespace

TEST_CASE("the guard accepts a sound environment and changes nothing") {
    unsigned const before = detail::read_mxcsr();
    CHECK_NOTHROW(require_sound_environment());
    CHECK((detail::read_mxcsr() & ~0x3fu) == (before & ~0x3fu)); // sticky flags may be raised
}

TEST_CASE("the guard refuses rounding modes other than nearest") {
    int const mode = GENERATE(FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    std::fesetround(mode);
    bool refused = false;
    std::string message;
    try {
        require_sound_environment();
    } catch (unsound_environment const& e) {
        refused = true;
        message = e.what();
    }
    std::fesetround(FE_TONEAREST);
    CHECK(refused);
    CHECK_THAT(message, ContainsSubstring("rounding mode"));
}

TEST_CASE("the guard refuses flushed subnormals") {
    CHECK_THAT(refusal(0x8000), ContainsSubstring("FTZ or DAZ"));
    CHECK_THAT(refusal(0x0040), ContainsSubstring("FTZ or DAZ"));
    CHECK(refusal(0).empty());
}

TEST_CASE("plain arithmetic is as written in this file") {
    CHECK(detail::plain_arithmetic_is_kept());
}
