// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_INTEGERS_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_INTEGERS_HPP

/// @file
/// Integers of 128 bits in standard C++, and what elementary functions do in integers alone.

#include <sivid/number/rounding.hpp>

#include <array>
#include <bit>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace sivid::detail {

/// Unsigned, modulo 2^128.
struct two_words {
    std::uint64_t high = 0, low = 0;

    friend constexpr bool operator==(two_words const&, two_words const&) = default;
    friend constexpr std::strong_ordering operator<=>(two_words const&, two_words const&) = default;
    friend constexpr two_words operator+(two_words a, two_words b) noexcept {
        std::uint64_t const sum = a.low + b.low;
        return {a.high + b.high + (sum < a.low ? 1u : 0u), sum};
    }
    friend constexpr two_words operator-(two_words a, two_words b) noexcept {
        return {a.high - b.high - (a.low < b.low ? 1u : 0u), a.low - b.low};
    }
    /// By 0 to 128 bits.
    friend constexpr two_words operator<<(two_words a, int n) noexcept {
        if (n == 0) return a;
        if (n >= 64) return {n == 128 ? 0 : a.low << (n - 64), 0};
        return {a.high << n | a.low >> (64 - n), a.low << n};
    }
    friend constexpr two_words operator>>(two_words a, int n) noexcept {
        if (n == 0) return a;
        if (n >= 64) return {0, n == 128 ? 0 : a.high >> (n - 64)};
        return {a.high >> n, a.low >> n | a.high << (64 - n)};
    }
};

[[nodiscard]] constexpr int leading_zeros(two_words a) noexcept {
    return a.high != 0 ? std::countl_zero(a.high) : 64 + std::countl_zero(a.low);
}

/// a b.
[[nodiscard]] constexpr two_words product_by_halves(std::uint64_t a, std::uint64_t b) noexcept {
    constexpr std::uint64_t half = 0xffff'ffff;
    std::uint64_t const ll = (a & half) * (b & half), lh = (a & half) * (b >> 32),
                        hl = (a >> 32) * (b & half);
    std::uint64_t const middle = (ll >> 32) + (lh & half) + (hl & half);
    return {(a >> 32) * (b >> 32) + (lh >> 32) + (hl >> 32) + (middle >> 32),
            middle << 32 | (ll & half)};
}

[[nodiscard]] constexpr two_words full_product(std::uint64_t a, std::uint64_t b) noexcept {
#if defined(__SIZEOF_INT128__)
    __extension__ using wide = unsigned __int128;
    wide const p = static_cast<wide>(a) * b;
    return {static_cast<std::uint64_t>(p >> 64), static_cast<std::uint64_t>(p)};
#else
    return product_by_halves(a, b);
#endif
}

/// floor(a b / 2^128).
[[nodiscard]] constexpr two_words high_product(two_words a, two_words b) noexcept {
    two_words const ll = full_product(a.low, b.low), lh = full_product(a.low, b.high),
                    hl = full_product(a.high, b.low);
    two_words const middle = two_words{0, ll.high} + two_words{0, lh.low} + two_words{0, hl.low};
    return full_product(a.high, b.high) + two_words{0, lh.high} + two_words{0, hl.high} +
           two_words{0, middle.high};
}

/// floor(a / d), d < 2^63.
[[nodiscard]] constexpr two_words quotient(two_words a, std::uint64_t d) noexcept {
    two_words q{a.high / d, 0};
    std::uint64_t rest = a.high % d;
    for (int i = 63; i >= 0; --i) {
        rest = rest << 1 | (a.low >> i & 1u);
        if (rest >= d) {
            rest -= d;
            q.low |= std::uint64_t{1} << i;
        }
    }
    return q;
}

/// Signed, in two's complement: what g++ and clang have as `__int128`, as far as sivid uses it.
class signed_two_words {
public:
    constexpr signed_two_words() = default;
    template <std::integral N>
    constexpr signed_two_words(N n) noexcept // NOLINT: as integers convert
        : bits_{n < N{} ? ~std::uint64_t{0} : 0, static_cast<std::uint64_t>(n)} {}

    friend constexpr bool operator==(signed_two_words const&, signed_two_words const&) = default;
    friend constexpr std::strong_ordering operator<=>(signed_two_words a,
                                                      signed_two_words b) noexcept {
        constexpr std::uint64_t sign = std::uint64_t{1} << 63;
        return two_words{a.bits_.high ^ sign, a.bits_.low} <=>
               two_words{b.bits_.high ^ sign, b.bits_.low};
    }
    friend constexpr signed_two_words operator+(signed_two_words a, signed_two_words b) noexcept {
        return signed_two_words{a.bits_ + b.bits_};
    }
    friend constexpr signed_two_words operator-(signed_two_words a, signed_two_words b) noexcept {
        return signed_two_words{a.bits_ - b.bits_};
    }
    friend constexpr signed_two_words operator-(signed_two_words a) noexcept {
        return signed_two_words{two_words{} - a.bits_};
    }
    friend constexpr signed_two_words operator*(signed_two_words a, signed_two_words b) noexcept {
        two_words p = full_product(a.bits_.low, b.bits_.low);
        p.high += a.bits_.high * b.bits_.low + a.bits_.low * b.bits_.high;
        return signed_two_words{p};
    }
    friend constexpr signed_two_words operator<<(signed_two_words a, int n) noexcept {
        return signed_two_words{a.bits_ << n};
    }
    /// floor(a / 2^n).
    friend constexpr signed_two_words operator>>(signed_two_words a, int n) noexcept {
        two_words const ones{~std::uint64_t{0}, ~std::uint64_t{0}};
        two_words const shifted = a.bits_ >> n;
        bool const negative = a.bits_.high >> 63 != 0;
        return signed_two_words{negative ? shifted + (ones << (128 - n)) : shifted};
    }
    [[nodiscard]] constexpr two_words bits() const noexcept { return bits_; }

private:
    constexpr explicit signed_two_words(two_words bits) noexcept : bits_{bits} {}
    two_words bits_;
};

/// Nothing where the result is no `int64_t`.
[[nodiscard]] constexpr std::optional<std::int64_t> narrowed(signed_two_words x) noexcept {
    auto const low = static_cast<std::int64_t>(x.bits().low);
    if (x == signed_two_words{low}) return low;
    return std::nullopt;
}
[[nodiscard]] constexpr std::optional<std::int64_t> checked_product(std::int64_t a,
                                                                    std::int64_t b) noexcept {
    return narrowed(signed_two_words{a} * signed_two_words{b});
}
[[nodiscard]] constexpr std::optional<std::int64_t> checked_sum(std::int64_t a,
                                                                std::int64_t b) noexcept {
    return narrowed(signed_two_words{a} + signed_two_words{b});
}

#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 wide_integer;
#else
using wide_integer = signed_two_words;
#endif

} // namespace sivid::detail

// ---- What is done in integers alone, so that no rounding mode, flag or library has a part in it:
// any double reduced modulo quarter turns, beyond the limit of the kernels of sin, cos and tan;
// powers with whole exponents; and x^y = 2^(y log2 x). Numbers are non-negative and cut off, so
// that errors have one sign; they are counted in units of the last place
// (docs/theory/pack_functions.md, section 11).

namespace sivid::detail::integers {

// ---- Quarter turns

/// 2/pi in words, the first below the point.
inline constexpr std::array<std::uint64_t, 20> two_by_pi{
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

/// |x| = k pi/2 + (head + tail), k modulo 4. The sum is at most pi/4 in magnitude and in error by
/// less than 2^-68 of itself; |tail| <= 2^-53 |head|. A head of 0: not known (no double is so near
/// to a multiple of pi/2).
struct reduced_turns {
    unsigned k;
    double head, tail;
};

/// With |x| = m 2^e: the words of 2/pi before those that matter give multiples of four quarter
/// turns. From there on 320 bits are multiplied by m; at least 255 of the product lie below the
/// point, so what is cut off is below m 2^-255 < 2^-200 quarter turns. The fraction is taken to 192
/// bits, its first 128 from the leading one on (at least 121, if it starts late) are multiplied by
/// pi/2.
/// @given  2^20 <= |x| < infinity
[[nodiscard]] constexpr reduced_turns reduce_far(double x) noexcept {
    scaled_integer const a = significand_of(x);
    int const first = a.e >= 66 ? (a.e - 2) / 64 : 0; // words left out
    std::array<std::uint64_t, 6> p{};                 // the product, its lowest word first
    for (std::size_t i = 0; i < 5; ++i) {
        std::uint64_t const word = two_by_pi[static_cast<std::size_t>(first) + 4 - i];
        two_words const product = full_product(a.m, word) + two_words{0, p[i]};
        p[i] = product.low;
        p[i + 1] = product.high;
    }
    auto const bits_from = [&](int at) { // 64 of them
        auto const word = static_cast<std::size_t>(at / 64);
        int const shift = at % 64;
        std::uint64_t const upper = word < 5 ? p[word + 1] : 0;
        return shift == 0 ? p[word] : p[word] >> shift | upper << (64 - shift);
    };
    int const point = 320 + 64 * first - a.e;
    auto k = static_cast<unsigned>(bits_from(point) & 3u);
    std::uint64_t f0 = bits_from(point - 64), f1 = bits_from(point - 128),
                  f2 = bits_from(point - 192);
    bool const negative = f0 >> 63 != 0; // the rest is counted back from the next quarter turn
    if (negative) {
        k = (k + 1) & 3u;
        f0 = ~f0; // one unit of the last place less than the difference
        f1 = ~f1;
        f2 = ~f2;
    }
    if (f0 == 0 && f1 < 128) return {k, 0.0, 0.0};
    int zeros = f0 == 0 ? 64 : std::countl_zero(f0);
    two_words part{f0, f1};
    if (zeros == 64)
        part = {f1, f2};
    else if (zeros > 0)
        part = {f0 << zeros | f1 >> (64 - zeros), f1 << zeros | f2 >> (64 - zeros)};
    constexpr two_words half_pi{0xc90f'daa2'2168'c234, 0xc4c6'628b'80dc'1cd1}; // 2^-127
    two_words const product = high_product(part, half_pi);                     // 2^(-127 - zeros)
    int const more = leading_zeros(product);
    two_words const h = product << more;
    int const exponent = -127 - zeros - more;
    // The head is rounded to nearest, the rest has a sign.
    bool const rounds_up = (h.high >> 10 & 1u) != 0;
    std::uint64_t const kept = (h.high >> 11) + (rounds_up ? 1u : 0u);
    two_words const off =
        rounds_up ? (two_words{0, kept} << 75) - h : h - (two_words{0, kept} << 75);
    double const head = rounded<direction::nearest>(negative, {kept, exponent + 75, false});
    if (off == two_words{}) return {k, head, 0.0};
    int const n = leading_zeros(off);
    return {k, head,
            rounded<direction::nearest>(negative != rounds_up,
                                        {(off << n).high, exponent + 64 - n, false})};
}

// ---- Powers with whole exponents

/// A bound on side D of the product, with 64 bits.
/// @given  the leading bit of both factors is set
template <direction D>
[[nodiscard]] constexpr scaled_integer product_bound(scaled_integer a, scaled_integer b) noexcept {
    two_words p = full_product(a.m, b.m);
    int e = a.e + b.e + 64;
    if (p.high >> 63 == 0) {
        p = p << 1;
        --e;
    }
    if (D == direction::up && p.low != 0 && ++p.high == 0) return {std::uint64_t{1} << 63, e + 1};
    return {p.high, e};
}
/// A bound on side D of t^n: at most n roundings of 2^-63 each.
/// @given  0 < t < infinity, n <= `most_whole`
inline constexpr unsigned most_whole = 512;
template <direction D>
[[nodiscard]] constexpr scaled_integer whole_power(double t, unsigned n) noexcept {
    scaled_integer factor = significand_of(t), power{std::uint64_t{1} << 63, -63};
    factor = {factor.m << 11, factor.e - 11};
    for (; n != 0; n /= 2) {
        if (n % 2 != 0) power = product_bound<D>(power, factor);
        if (n > 1) factor = product_bound<D>(factor, factor);
    }
    return power;
}
/// The double next to x on side D, with exponents of any size.
template <direction D>
[[nodiscard]] constexpr double rounded_positive(scaled_integer x) noexcept {
    if (x.e > 1024)
        return D == direction::up ? std::numeric_limits<double>::infinity()
                                  : std::numeric_limits<double>::max();
    return rounded<D>(false, x);
}

// ---- Any powers

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

} // namespace sivid::detail::integers

#endif
