// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_EXACT_ROUNDING_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_EXACT_ROUNDING_HPP

/// @file
/// Products, quotients and roots of any doubles, rounded in a direction by integers alone: whatever
/// the rounding mode is, with subnormals flushed or not, on every machine. The slow way of
/// number/rounding.hpp where no control register is to be relied on.

#include <sivid/number/rounding/detail/machine.hpp>

#include <bit>
#include <cstdint>
#include <limits>

namespace sivid::detail {

/// m 2^e; `inexact` says that a number in (0, 1) has to be added to m.
struct scaled_integer {
    std::uint64_t m = 0;
    int e = 0;
    bool inexact = false;
};

/// |x| for finite x other than zero, with m in [2^52, 2^53).
[[nodiscard]] constexpr scaled_integer significand_of(double x) noexcept {
    std::uint64_t const all = std::bit_cast<std::uint64_t>(x);
    std::uint64_t const fraction = all & 0x000f'ffff'ffff'ffff;
    auto const field = static_cast<int>(all >> 52 & 0x7ff);
    if (field != 0) return {fraction | 0x0010'0000'0000'0000, field - 1075, false};
    int const missing = std::countl_zero(fraction) - 11;
    return {fraction << missing, -1074 - missing, false};
}

/// The double next to +-x on side D (or the nearest, ties to even); x itself if it is one.
/// @given  m != 0, and at least 54 bits of it where x is inexact
template <direction D>
[[nodiscard]] constexpr double rounded(bool negative, scaled_integer x) noexcept {
    int const missing = std::countl_zero(x.m);
    x.m <<= missing; // in [2^63, 2^64): what is still to be added lies below the last bit kept
    x.e -= missing;
    int const least = -1074, usual = x.e + 11; // exponents of the last bit
    int const last = usual < least ? least : usual;
    int const dropped = last - x.e;
    std::uint64_t const kept = dropped > 63 ? 0 : x.m >> dropped;
    // The bits dropped, with their first at bit 63.
    std::uint64_t const rest = dropped > 64 ? 0 : dropped == 64 ? x.m : x.m << (64 - dropped);
    bool const below = x.inexact || dropped > 64;
    constexpr std::uint64_t half = std::uint64_t{1} << 63;
    bool const away = D == direction::nearest
                          ? rest > half || (rest == half && (below || (kept & 1u) != 0))
                          : (rest != 0 || below) && (D == direction::up) != negative;
    // The leading bit of a normal number adds one to the exponent.
    std::uint64_t magnitude =
        (static_cast<std::uint64_t>(last - least) << 52) + kept + (away ? 1u : 0u);
    constexpr std::uint64_t infinite = 0x7ff0'0000'0000'0000;
    if (magnitude >= infinite)
        magnitude =
            D == direction::nearest || (D == direction::up) != negative ? infinite : infinite - 1;
    return std::bit_cast<double>(magnitude | (negative ? half : 0));
}

/// a b with its leading 64 bits.
[[nodiscard]] constexpr scaled_integer product_of(scaled_integer a, scaled_integer b) noexcept {
    std::uint64_t const x = a.m << 11, y = b.m << 11, low = 0xffff'ffff;
    std::uint64_t const ll = (x & low) * (y & low), lh = (x & low) * (y >> 32),
                        hl = (x >> 32) * (y & low);
    std::uint64_t const middle = (ll >> 32) + (lh & low) + (hl & low);
    return {(x >> 32) * (y >> 32) + (lh >> 32) + (hl >> 32) + (middle >> 32), a.e + b.e + 42,
            (middle & low) != 0 || (ll & low) != 0};
}
/// a / b, 64 bits by long division.
[[nodiscard]] constexpr scaled_integer quotient_of(scaled_integer a, scaled_integer b) noexcept {
    if (a.m < b.m) {
        a.m <<= 1;
        --a.e;
    }
    std::uint64_t q = 0;
    for (int i = 0; i < 64; ++i) { // a.m < 2 b.m
        q <<= 1;
        if (a.m >= b.m) {
            a.m -= b.m;
            q |= 1;
        }
        a.m <<= 1;
    }
    return {q, a.e - b.e - 63, a.m != 0};
}
/// sqrt a, 55 bits, digit by digit.
[[nodiscard]] constexpr scaled_integer root_of(scaled_integer a) noexcept {
    if (a.e % 2 != 0) {
        a.m <<= 1;
        --a.e;
    }
    std::uint64_t root = 0, rest = 0; // rest <= 2 root
    for (int i = 54; i >= 0; --i) {
        rest = rest << 2 | (i >= 28 ? a.m >> 2 * (i - 28) & 3u : 0u);
        std::uint64_t const trial = root << 2 | 1;
        root <<= 1;
        if (rest >= trial) {
            rest -= trial;
            root |= 1;
        }
    }
    return {root, a.e / 2 - 28, rest != 0};
}

[[nodiscard]] constexpr bool is_finite_other_than_zero(double x) noexcept {
    std::uint64_t const shifted = std::bit_cast<std::uint64_t>(x) << 1;
    return shifted != 0 && shifted < 0xffe0'0000'0000'0000;
}
[[nodiscard]] constexpr bool signs_differ(double a, double b) noexcept {
    return ((std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b)) >> 63) != 0;
}

// Zeros, infinities and NaN are left to the machine: their results are exact.
template <direction D>
[[nodiscard]] constexpr double exactly_rounded_product(double a, double b) noexcept {
    if (!is_finite_other_than_zero(a) || !is_finite_other_than_zero(b)) return a * b;
    return rounded<D>(signs_differ(a, b), product_of(significand_of(a), significand_of(b)));
}
template <direction D>
[[nodiscard]] constexpr double exactly_rounded_quotient(double a, double b) noexcept {
    if (!is_finite_other_than_zero(a) || !is_finite_other_than_zero(b)) return a / b;
    return rounded<D>(signs_differ(a, b), quotient_of(significand_of(a), significand_of(b)));
}
template <direction D>
[[nodiscard]] constexpr double exactly_rounded_root(double a) noexcept {
    if (!is_finite_other_than_zero(a))
        return a < 0.0 ? std::numeric_limits<double>::quiet_NaN() : a;
    if (signs_differ(a, 1.0)) return std::numeric_limits<double>::quiet_NaN();
    return rounded<D>(false, root_of(significand_of(a)));
}
/// A double with the sign of a b + c: what std::fma is good for in residuals, without the C
/// library. 0 where the sum is, or where it is not a number.
[[nodiscard]] constexpr double sign_of_fused(double a, double b, double c) noexcept {
    double const lo = exactly_rounded_product<direction::down>(a, b),
                 hi = exactly_rounded_product<direction::up>(a, b);
    return lo >= -c && hi > -c ? 1.0 : hi <= -c && lo < -c ? -1.0 : 0.0;
}
/// A whole number.
template <direction D>
[[nodiscard]] constexpr double exactly_rounded_integer(bool negative, std::uint64_t n) noexcept {
    return n == 0 ? 0.0 : rounded<D>(negative, {n, 0, false});
}

} // namespace sivid::detail

#endif
