// SPDX-License-Identifier: MIT
// With DAZ set by the caller, sin and log of subnormal numbers lost their inclusion: comparisons
// took the numbers for zero. Packs for AVX-512 did not look at FTZ and DAZ at all. The elementary
// functions clear both for their duration.
#include <sivid/number/guard.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack.hpp>

#include "support/catch.hpp"
#include "support/flushing.hpp"
#include "support/further_functions.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace sivid;

namespace {

using scalar = interval_traits<interval>;

/// Portable arithmetic cannot turn flushing off; it is refused.
constexpr bool can_clear = detail::control_flush != 0;

/// Results as bits, so that no comparison depends on the state.
struct outcome {
    std::uint64_t lo = 0, hi = 0;
    bool cut = false;
    bool operator==(outcome const&) const = default;
};
std::uint64_t bits_of(double x) {
    // A comparison of numbers could be moved to where subnormal ones are taken for zero.
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    constexpr auto infinity = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
    auto const bits = std::bit_cast<std::uint64_t>(x);
    return bits == sign ? 0 : (bits & ~sign) > infinity ? infinity + 1 : bits;
}
std::string text(outcome const& o) {
    char line[120];
    std::snprintf(line, sizeof line, "[%a, %a]%s", std::bit_cast<double>(o.lo),
                  std::bit_cast<double>(o.hi), o.cut ? " cut" : "");
    return line;
}

std::vector<interval> arguments() {
    double const inf = std::numeric_limits<double>::infinity();
    std::vector<interval> all{scalar::empty(), scalar::entire()};
    std::vector<double> const ends{-inf,      -0x1p30,    -750.0,     -744.0,     -1.0,
                                   -0.5,      -0x1p-1022, -0x1p-1060, -0x1p-1074, 0.0,
                                   0x1p-1074, 0x1p-1070,  0x1p-1060,  0x1p-1022,  0x1p-1000,
                                   0.5,       1.0,        1.5,        0x1p30,     inf};
    for (std::size_t i = 0; i < ends.size(); ++i)
        for (std::size_t j = i; j < ends.size(); ++j)
            if (i < j || (ends[i] > -inf && ends[i] < inf))
                all.push_back(scalar::bounds(ends[i], ends[j]));
    return all;
}

/// f(x, y, cut) in each state against the value of `reference` without flags.
template <class T, class F, class Reference>
void require_same(char const* name, F const& f, Reference const& reference) {
    using I = decltype(T::point(0.0));
    auto const xs = arguments();
    for (std::size_t k = 0; k < xs.size(); ++k) {
        auto const& x = xs[k];
        auto const& y = xs[(k * 7 + 3) % xs.size()];
        bool cut = false;
        interval const r = reference(x, y, cut);
        outcome const expected{bits_of(r.lower()), bits_of(r.upper()), cut};
        I a, b;
        if constexpr (T::lanes == 1 && !requires { a.set(0, x); }) {
            a = x;
            b = y;
        } else {
            a = I{x};
            b = I{y};
        }
        for (auto const flags : flushing::combinations()) {
            typename T::mask mask{};
            I result;
            flushing::word after = 0;
            {
                flushing::state const s{flags};
                result = f(a, b, mask);
                after = flushing::read();
            }
            INFO(name << " of [" << x.lower() << ", " << x.upper() << "], flags " << flags);
            REQUIRE((after & (flushing::rounding | flushing::all())) == flags);
            for (std::size_t lane = 0; lane < T::lanes; ++lane) {
                outcome const got{bits_of(T::lower(result, lane)), bits_of(T::upper(result, lane)),
                                  (static_cast<std::uint64_t>(mask) >> lane & 1u) != 0};
                if (!(got == expected)) {
                    INFO(text(got) << " instead of " << text(expected));
                    CHECK(false);
                }
            }
        }
    }
}

#define SIVID_SAME(name, call)                                                                     \
    require_same<t>(                                                                               \
        name,                                                                                      \
        [](auto const& x, [[maybe_unused]] auto const& y, [[maybe_unused]] auto& cut) {            \
            using u [[maybe_unused]] = t;                                                          \
            return call;                                                                           \
        },                                                                                         \
        [](interval const& x, [[maybe_unused]] interval const& y, [[maybe_unused]] bool& cut) {    \
            using u [[maybe_unused]] = scalar;                                                     \
            return call;                                                                           \
        })

} // namespace

TEMPLATE_TEST_CASE("elementary functions hold under FTZ and DAZ", "", interval, pack<1>, pack<2>,
                   pack<4>, pack<8>, pack<16>) {
    using t = interval_traits<TestType>;
    if constexpr (!can_clear || requires { requires TestType::vector::keeps_own_mode; }) {
        for (auto const flags : flushing::combinations()) {
            flushing::state const s{flags};
            CHECK_THROWS_AS(require_sound_environment(), unsound_environment);
        }
        return;
    }
    SIVID_SAME("exp", u::exp(x));
    SIVID_SAME("log", u::log(x, cut));
    SIVID_SAME("sin", u::sin(x));
    SIVID_SAME("cos", u::cos(x));
    SIVID_SAME("tan", u::tan(x, cut));
    SIVID_SAME("atan", u::atan(x));
    SIVID_SAME("tanh", u::tanh(x));
    if constexpr (support::has_further_functions<TestType>) {
        SIVID_SAME("expm1", u::expm1(x));
        SIVID_SAME("log1p", u::log1p(x, cut));
        SIVID_SAME("asin", u::asin(x, cut));
        SIVID_SAME("acos", u::acos(x, cut));
        SIVID_SAME("sinh", u::sinh(x));
        SIVID_SAME("cosh", u::cosh(x));
        SIVID_SAME("asinh", u::asinh(x));
        SIVID_SAME("acosh", u::acosh(x, cut));
        SIVID_SAME("atanh", u::atanh(x, cut));
        SIVID_SAME("pow", u::pow(x, y, cut));
        SIVID_SAME("atan2", u::atan2(x, y, cut));
    }
}

TEST_CASE("powers and roots of intervals hold under FTZ and DAZ") {
    if (!can_clear) SIVID_SKIP("this machine cannot clear FTZ and DAZ");
    using t = scalar;
    SIVID_SAME("sqr", sivid::sqr(x));
    SIVID_SAME("sqrt", sivid::sqrt(x, cut));
    SIVID_SAME("hypot", sivid::hypot(x, y));
    for (int n : {-7, -2, -1, 0, 1, 2, 3, 4, 9}) {
        CAPTURE(n);
        require_same<t>(
            "pown", [n](interval const& x, interval const&, bool& cut) { return pown(x, n, cut); },
            [n](interval const& x, interval const&, bool& cut) { return pown(x, n, cut); });
    }
}

TEST_CASE("operators of intervals hold under FTZ and DAZ") {
    if (!can_clear) SIVID_SKIP("this machine cannot clear FTZ and DAZ");
    auto const xs = arguments();
    auto const check = [&](char const* name, auto const& f) {
        std::size_t missed = 0;
        for (auto const& x : xs)
            for (auto const& y : xs) {
                interval const exact = f(x, y);
                interval flushed;
                {
                    flushing::state const s{flushing::all()};
                    flushed = f(x, y);
                }
                if (!subset(exact, flushed)) ++missed;
            }
        INFO(name);
        CHECK(missed == 0);
    };
    check("+", [](auto const& x, auto const& y) { return x + y; });
    check("-", [](auto const& x, auto const& y) { return x - y; });
    check("*", [](auto const& x, auto const& y) { return x * y; });
    check("/", [](auto const& x, auto const& y) { return x / y; });
}
