// SPDX-License-Identifier: MIT
#include <sivid/number/guard.hpp>

#include "support/catch.hpp"
#include "support/flushing.hpp"

#include <cfenv>
#include <string>

using namespace sivid;

namespace {

/// The message with which the guard refuses while these switches are set; empty if it accepts.
std::string refusal(flushing::word flags) {
    auto const before = flushing::read();
    flushing::write(before | flags);
    std::string message;
    try {
        require_sound_environment();
    } catch (unsound_environment const& e) {
        flushing::write(before);
        message = e.what();
    }
    flushing::write(before);
    return message;
}

} // namespace

TEST_CASE("the guard accepts a sound environment and changes nothing") {
    auto const before = flushing::read();
    CHECK_NOTHROW(require_sound_environment());
    CHECK((flushing::read() & ~0x3fu) == (before & ~0x3fu)); // sticky flags may be raised
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
    for (auto const flags : flushing::combinations())
        CHECK_THAT(refusal(flags), ContainsSubstring("FTZ or DAZ"));
    CHECK(refusal(0).empty());
}

TEST_CASE("plain arithmetic is as written in this file") {
    CHECK(detail::plain_arithmetic_is_kept());
}
