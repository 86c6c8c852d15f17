// SPDX-License-Identifier: MIT
#include <sivid/number/guard.hpp>
#include <sivid/number/pack/detail/known_values.hpp>
#include <sivid/number/pack.hpp>

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

/// cos where sin is asked for, in one lane.
template <std::size_t W>
struct sine_broken : pack_traits<W> {
    using I = pack<W>;
    static I sin(I const& x) noexcept {
        I y = pack_traits<W>::sin(x);
        y.set(W - 1, pack_traits<W>::cos(x)[W - 1]);
        return y;
    }
};
/// One float too narrow.
struct addition_broken : interval_traits<interval> {
    static interval add(interval const& x, interval const& y) noexcept {
        interval const z = interval_traits<interval>::add(x, y);
        return detail::unchecked_interval(z.lower(), detail::next_down(z.upper()));
    }
};
struct subtraction_broken : interval_traits<interval> {
    static interval sub(interval const& x, interval const& y) noexcept {
        interval const z = interval_traits<interval>::sub(x, y);
        return detail::unchecked_interval(detail::next_up(z.lower()), z.upper());
    }
};
struct multiplication_broken : interval_traits<interval> {
    static interval mul(interval const& x, interval const& y) noexcept {
        interval const z = interval_traits<interval>::mul(x, y);
        return detail::unchecked_interval(detail::next_up(z.lower()), z.upper());
    }
};
struct division_broken : interval_traits<interval> {
    static interval div(interval const& x, interval const& y, bool& cut) noexcept {
        interval const z = interval_traits<interval>::div(x, y, cut);
        return detail::unchecked_interval(z.lower(), detail::next_down(z.upper()));
    }
};
/// The upper bound of the lower end, as when an argument was lost.
struct logarithm_broken : interval_traits<interval> {
    static interval log(interval const& x, bool& cut) noexcept {
        return interval_traits<interval>::log(point(x.lower()), cut);
    }
};

std::string name(char const* found) { return found == nullptr ? "" : found; }

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

TEST_CASE("the kernels that were compiled here enclose the known values") {
    broken_kernel const k = first_broken_kernel();
    CHECK(name(k.type) == "");
    CHECK(name(k.function) == "");
    CHECK(name(trial::first_broken_function<interval_traits<interval>>()) == "");
    CHECK(name(trial::first_broken_function<pack_traits<1>>()) == "");
    CHECK(name(trial::first_broken_function<pack_traits<2>>()) == "");
    CHECK(name(trial::first_broken_function<pack_traits<4>>()) == "");
    CHECK(name(trial::first_broken_function<pack_traits<8>>()) == "");
}

TEST_CASE("a kernel that misses by one float or in one lane is found") {
    CHECK(name(trial::first_broken_function<sine_broken<1>>()) == "sin");
    CHECK(name(trial::first_broken_function<sine_broken<4>>()) == "sin");
    CHECK(name(trial::first_broken_function<addition_broken>()) == "add");
    CHECK(name(trial::first_broken_function<logarithm_broken>()) == "log");
}

TEST_CASE("an operation that misses by one float is found from the headers alone") {
    CHECK(name(first_broken_operation<interval_traits<interval>>()) == "");
    CHECK(name(first_broken_operation<addition_broken>()) == "add");
    CHECK(name(first_broken_operation<subtraction_broken>()) == "sub");
    CHECK(name(first_broken_operation<multiplication_broken>()) == "mul");
    CHECK(name(first_broken_operation<division_broken>()) == "div");
}

TEST_CASE("the guard names the kernel that is broken and what to do") {
    CHECK_NOTHROW(detail::require_unbroken({}));
    try {
        detail::require_unbroken({"pack<2>", "sin"});
        FAIL("accepted");
    } catch (unsound_environment const& e) {
        CHECK_THAT(e.what(), ContainsSubstring("sin of pack<2>"));
        CHECK_THAT(e.what(), ContainsSubstring("-fno-ipa-modref"));
    }
}
