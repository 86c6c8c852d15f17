// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_POWER_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_POWER_HPP

/// @file
/// Proved bounds of x^y = 2^(y log2 x), in integers alone: no rounding mode, flag or library has a
/// part in them. Every number is non-negative and cut off, so that errors have one sign; they are
/// counted in units of the last place (docs/pack_functions.md, section 11).

#include <sivid/number/elementary/detail/wide_integer.hpp>
#include <sivid/number/rounding/detail/exact_rounding.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sivid::detail::own {

/// 2^127/1, 2^127/3, 2^127/5, ..., or 2^127/0!, 2^127/1!, 2^127/2!, ..., all cut off.
template <std::size_t N, bool Factorials>
[[nodiscard]] constexpr std::array<two_words, N> reciprocals() noexcept {
    constexpr two_words one{std::uint64_t{1} << 63, 0};
    std::array<two_words, N> c{};
    for (std::size_t j = 0; j < N; ++j)
        c[j] = !Factorials ? quotient(one, 2 * j + 1) : j == 0 ? one : quotient(c[j - 1], j);
    return c;
}

/// c[0] + c[1] x + c[2] x^2 + ... in units of 2^-127 like c, x in units of 2^-128.
template <std::size_t N>
[[nodiscard]] constexpr two_words horner(two_words x, std::array<two_words, N> const& c) noexcept {
    two_words sum = c[N - 1];
    for (std::size_t j = N - 1; j-- > 0;) sum = c[j] + high_product(x, sum);
    return sum;
}

/// |log2 m| in units of 2^-124, for m = n 2^-53 in [3/4, 3/2). Short by less than `log2_short`:
///   log2 m = 2/ln 2 artanh z,  artanh z = z (1 + z^2/3 + ...),  z = (m - 1)/(m + 1), |z| <= 1/5.
inline constexpr unsigned log2_short = 2;
[[nodiscard]] constexpr two_words log2_of(std::uint64_t n) noexcept {
    constexpr auto c = reciprocals<28, false>();
    constexpr two_words two_by_ln2{0x5c55'1d94'ae0b'f85d, 0xdf43'ff68'348e'9f44}; // 2^-125
    constexpr std::uint64_t one = std::uint64_t{1} << 53;
    std::uint64_t const numerator = n < one ? one - n : n - one, denominator = n + one;
    std::uint64_t const leading = quotient(two_words{numerator, 0}, denominator).low;
    std::uint64_t const rest = std::uint64_t{0} - leading * denominator;
    two_words const z{leading, quotient(two_words{rest, 0}, denominator).low}; // 2^-128
    return high_product(high_product(z, horner(high_product(z, z), c)), two_by_ln2);
}

/// 2^f in [1, 2) in units of 2^-127, for f in units of 2^-112; short by less than `exp2_short`, and
/// exact for f = 0.
inline constexpr unsigned exp2_short = 10;
[[nodiscard]] constexpr two_words exp2_of(two_words f) noexcept {
    constexpr auto c = reciprocals<32, true>();
    constexpr two_words ln2{0xb172'17f7'd1cf'79ab, 0xc9e3'b398'03f2'f6af}; // 2^-128
    return horner(high_product(f << 16, ln2), c);
}

/// y |log2 x|, y > 0, as a bound in units of 2^-112.
struct exponent_bound {
    two_words value;
    bool exact = true; ///< nothing was cut off
    bool huge = false; ///< beyond 2^11
};

/// m 2^e w 2^-bits, cut off.
[[nodiscard]] constexpr exponent_bound scaled_product(scaled_integer y, two_words w,
                                                      int bits) noexcept {
    two_words const low = full_product(y.m, w.low),
                    sum = full_product(y.m, w.high) + two_words{0, low.high};
    std::uint64_t p0 = low.low, p1 = sum.low, p2 = sum.high;
    int const length = p2 != 0 ? 192 - std::countl_zero(p2) : 128 - leading_zeros({p1, p0});
    int const shift = y.e - bits + 112;
    if (length + shift > 112 + 11) return {{}, false, true};
    if (shift >= 0) return {two_words{p1, p0} << shift}; // p2 is 0
    if (shift <= -192) return {{}, length == 0, false};
    std::uint64_t lost = 0;
    int n = -shift;
    for (; n >= 64; n -= 64) {
        lost |= p0;
        p0 = p1;
        p1 = p2;
        p2 = 0;
    }
    if (n > 0) {
        lost |= p0 << (64 - n);
        p0 = p0 >> n | p1 << (64 - n);
        p1 = p1 >> n | p2 << (64 - n);
    }
    return {{p1, p0}, lost == 0, false};
}

/// A bound of x^y on side D.
/// @given  x > 0, x != 1, y != 0, both finite
template <direction D>
[[nodiscard]] constexpr double power(double x, double y) noexcept {
    constexpr bool up = D == direction::up;
    // x = 2^e m
    scaled_integer const a = significand_of(x);
    constexpr std::uint64_t three_halves = std::uint64_t{3} << 51;
    bool const upper_half = a.m >= three_halves;
    std::uint64_t const n = upper_half ? a.m : a.m << 1;
    int const e = a.e + (upper_half ? 53 : 52);
    constexpr std::uint64_t one = std::uint64_t{1} << 53;
    bool const whole = n == one;
    two_words const l = whole ? two_words{} : log2_of(n),
                    l_up = whole ? two_words{} : l + two_words{0, log2_short};
    // |log2 x| between w and w_up, in units of 2^-bits
    bool log_negative = n < one;
    int bits = 124;
    two_words w = l, w_up = l_up;
    if (e != 0) {
        bits = 116;
        two_words const whole_part = two_words{0, static_cast<std::uint64_t>(e < 0 ? -e : e)}
                                     << bits;
        two_words const part = l >> 8,
                        part_up = whole ? two_words{} : (l_up >> 8) + two_words{0, 1};
        bool const adds = (e < 0) == log_negative;
        w = adds ? whole_part + part : whole_part - part_up;
        w_up = adds ? whole_part + part_up : whole_part - part;
        log_negative = e < 0;
    }
    bool const negative = log_negative != (y < 0.0);
    bool const outward = up != negative; // the magnitude of the exponent is to be bounded above
    exponent_bound p = scaled_product(significand_of(y), outward ? w_up : w, bits);
    if (p.huge) {
        if (negative) return up ? std::numeric_limits<double>::denorm_min() : 0.0;
        return up ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::max();
    }
    if (outward && !p.exact) p.value = p.value + two_words{0, 1};
    two_words const below_one{(std::uint64_t{1} << 48) - 1, ~std::uint64_t{0}};
    auto k = static_cast<int>((p.value >> 112).low);
    two_words f{p.value.high & below_one.high, p.value.low};
    if (negative) {
        k = -k;
        if (f != two_words{}) {
            --k;
            f = below_one - f + two_words{0, 1};
        }
    }
    two_words const r = exp2_of(f);
    if (whole && p.exact && f == two_words{}) return rounded<D>(false, {r.high, k - 63, false});
    if constexpr (!up) {
        return rounded<D>(false, {r.high, k - 63, false});
    } else {
        two_words const r_up = r + two_words{0, exp2_short};
        if (r_up < r) return rounded<D>(false, {std::uint64_t{1} << 63, k - 62, true});
        return rounded<D>(false, {r_up.high, k - 63, true});
    }
}

} // namespace sivid::detail::own

#endif
