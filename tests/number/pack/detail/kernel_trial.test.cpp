// SPDX-License-Identifier: MIT
#include <sivid/number/guard.hpp>
#include <sivid/number/pack/detail/kernel_trial.hpp>
#include <sivid/number/pack/detail/known_values.hpp>
#include <sivid/number/pack_traits.hpp>

#include "support/catch.hpp"

#include <string>

using namespace sivid;

namespace {

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
/// The upper bound of the lower end, as when an argument was lost.
struct logarithm_broken : interval_traits<interval> {
    static interval log(interval const& x, bool& cut) noexcept {
        return interval_traits<interval>::log(point(x.lower()), cut);
    }
};

std::string name(char const* found) { return found == nullptr ? "" : found; }

} // namespace

TEST_CASE("the kernels that were compiled here enclose the known values") {
    broken_kernel const k = first_broken_kernel();
    CHECK(name(k.type) == "");
    CHECK(name(k.function) == "");
    CHECK(name(trial::first_broken_function<interval_traits<interval>>()) == "");
}

TEST_CASE("a kernel that misses by one float or in one lane is found") {
    CHECK(name(trial::first_broken_function<sine_broken<1>>()) == "sin");
    CHECK(name(trial::first_broken_function<sine_broken<4>>()) == "sin");
    CHECK(name(trial::first_broken_function<addition_broken>()) == "add");
    CHECK(name(trial::first_broken_function<logarithm_broken>()) == "log");
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
