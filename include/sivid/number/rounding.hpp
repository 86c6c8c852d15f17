// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_HPP
#define SIVID_NUMBER_ROUNDING_HPP

/// @file
/// Directed rounding of + - * / sqrt, tight and independent of the caller's rounding mode.
///
/// Two ways, chosen by the flags of the including file:
///   * AVX-512: the direction is part of the instruction;
///   * otherwise: the result r of one operation in *any* mode is one of the two neighbours of the
///     exact value; the sign of the exact residual says on which side it lies, and r is moved by
///     one step if it lies on the wrong one. No control register is read or written.
/// Rare operands (subnormal, overflow) take the slow way: on x86-64 through MXCSR, elsewhere
/// through integers. So outside x86-64 no directed mode is ever needed.

#include <sivid/number/rounding/detail/machine.hpp>

#include <bit>
#include <cstdint>
#include <limits>

// ---- By integers alone: whatever the rounding mode is, with subnormals flushed or not, on every
// machine.

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

#if SIVID_MACHINE_X86_64
#if defined(__AVX512F__) || defined(__FMA__)
#include <immintrin.h>
#else
#include <emmintrin.h> // a tenth of the former, and all that these kernels use
#endif
#endif

// Kernels that differ with compiler flags live in a namespace that names the flags, so that
// translation units with different flags can be linked.
#if SIVID_MACHINE_X86_64 && defined(__AVX512F__) && !defined(SIVID_UNFUSED)
#define SIVID_EMBEDDED_ROUNDING 1
#else
#define SIVID_EMBEDDED_ROUNDING 0
#endif
#if !SIVID_MACHINE_X86_64
#define SIVID_ROUNDING_KERNELS rounding_by_integers
#elif SIVID_EMBEDDED_ROUNDING
#define SIVID_ROUNDING_KERNELS rounding_avx512
#elif defined(__FMA__)
#define SIVID_ROUNDING_KERNELS rounding_residual_fma
#else
#define SIVID_ROUNDING_KERNELS rounding_residual
#endif

namespace sivid::detail {

inline namespace SIVID_MACHINE {

// The slow way: any operands, any caller's mode.
#if SIVID_MACHINE_X86_64
template <direction D>
double directed_add(double a, double b) noexcept {
    with_rounding<D> const mode;
    return pinned(pinned(a) + pinned(b));
}
template <direction D>
double directed_mul(double a, double b) noexcept {
    with_rounding<D> const mode;
    return pinned(pinned(a) * pinned(b));
}
template <direction D>
double directed_div(double a, double b) noexcept {
    with_rounding<D> const mode;
    return pinned(pinned(a) / pinned(b));
}
template <direction D>
double directed_sqrt(double a) noexcept {
    with_rounding<D> const mode;
    return pinned(plain_sqrt(pinned(a)));
}
#else
template <direction D>
double directed_mul(double a, double b) noexcept {
    return exactly_rounded_product<D>(pinned(a), pinned(b));
}
template <direction D>
double directed_div(double a, double b) noexcept {
    return exactly_rounded_quotient<D>(pinned(a), pinned(b));
}
template <direction D>
double directed_sqrt(double a) noexcept {
    return exactly_rounded_root<D>(pinned(a));
}
#endif

} // namespace SIVID_MACHINE

inline constexpr std::uint64_t sign_bit = 0x8000'0000'0000'0000u;

[[gnu::always_inline]] constexpr std::uint64_t bits(double x) noexcept {
    return std::bit_cast<std::uint64_t>(x);
}
[[gnu::always_inline]] constexpr bool is_zero(double x) noexcept { return bits(x) << 1 == 0; }
[[gnu::always_inline]] constexpr bool is_nan(double x) noexcept {
    return (bits(x) & ~sign_bit) > 0x7ff0'0000'0000'0000u;
}
[[gnu::always_inline]] constexpr bool is_infinite(double x) noexcept {
    return (bits(x) & ~sign_bit) == 0x7ff0'0000'0000'0000u;
}

/// x moved by `count` floats, downward if count < 0; saturates at the infinities, keeps NaN.
constexpr double step(double x, std::int64_t count) noexcept {
    if (is_nan(x)) return x;
    constexpr std::int64_t infinity = 0x7ff0'0000'0000'0000;
    auto const magnitude = static_cast<std::int64_t>(bits(x) & ~sign_bit);
    std::int64_t ordered = (bits(x) & sign_bit) != 0 ? -magnitude : magnitude;
    ordered += count;
    if (ordered > infinity) ordered = infinity;
    if (ordered < -infinity) ordered = -infinity;
    return ordered < 0 ? std::bit_cast<double>(static_cast<std::uint64_t>(-ordered) | sign_bit)
                       : std::bit_cast<double>(static_cast<std::uint64_t>(ordered));
}
constexpr double next_down(double x) noexcept { return step(x, -1); }
constexpr double next_up(double x) noexcept { return step(x, +1); }

/// One step of a non-zero, non-NaN x towards `D` if `move`, without a branch.
template <direction D>
[[gnu::always_inline]] constexpr double step_if(double x, bool move) noexcept {
    auto const away = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits(x)) >> 63 | 1);
    std::uint64_t const shift = move ? away : 0;
    return std::bit_cast<double>(D == direction::up ? bits(x) + shift : bits(x) - shift);
}

inline namespace SIVID_ROUNDING_KERNELS {

#if SIVID_EMBEDDED_ROUNDING

template <direction D>
inline constexpr int embedded =
    (D == direction::up ? _MM_FROUND_TO_POS_INF : _MM_FROUND_TO_NEG_INF) | _MM_FROUND_NO_EXC;

template <direction D>
[[gnu::always_inline]] inline double add(double a, double b) noexcept {
    return _mm_cvtsd_f64(
        _mm_add_round_sd(_mm_set_sd(opaque(a)), _mm_set_sd(opaque(b)), embedded<D>));
}
template <direction D>
[[gnu::always_inline]] inline double mul(double a, double b) noexcept {
    return _mm_cvtsd_f64(
        _mm_mul_round_sd(_mm_set_sd(opaque(a)), _mm_set_sd(opaque(b)), embedded<D>));
}
template <direction D>
[[gnu::always_inline]] inline double div(double a, double b) noexcept {
    return _mm_cvtsd_f64(
        _mm_div_round_sd(_mm_set_sd(opaque(a)), _mm_set_sd(opaque(b)), embedded<D>));
}
template <direction D>
[[gnu::always_inline]] inline double sqrt(double a) noexcept {
    __m128d const x = _mm_set_sd(opaque(a));
    return _mm_cvtsd_f64(_mm_sqrt_round_sd(x, x, embedded<D>));
}

#else

inline constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;

[[gnu::always_inline]] constexpr std::uint64_t exponent(double x) noexcept {
    return bits(x) >> 52 & 0x7ff;
}
[[gnu::always_inline]] constexpr std::uint64_t significand(double x) noexcept {
    return (bits(x) & fraction) | (fraction + 1);
}
/// Exponents of operands and result that are neither zero, subnormal, infinite nor NaN, the result
/// not in the uppermost binade either: rounded towards zero, an overflow would look like the
/// greatest finite number. Operands of a finite result are finite, so they are only tested for 0
/// (bit 11 of e - 1).
[[gnu::always_inline]] constexpr bool are_normal(std::uint64_t e, std::uint64_t f,
                                                 std::uint64_t result) noexcept {
    return (((e - 1) | (f - 1) | (result - 1) | (result + 2)) & 0x800) == 0;
}

/// a + b. Fast two-sum: with |big| >= |small| and s a neighbour of the sum, s - big is exact, so
/// the sign of small - (s - big) is the sign of the exact a + b - s in every rounding mode (it is a
/// multiple of the least subnormal and cannot round to zero). Infinite or empty operands give NaN
/// here and move nothing; an overflow gives -inf (+inf) and moves an infinite s back to the
/// greatest finite number.
template <direction D>
[[gnu::always_inline]] inline double add(double a, double b) noexcept {
    a = opaque(a);
    b = opaque(b);
    double const s = opaque(a + b);
    bool const ordered = (bits(a) & ~sign_bit) >= (bits(b) & ~sign_bit);
    double const big = ordered ? a : b, small = ordered ? b : a;
    double const residual = small - opaque(s - big);
    return step_if<D>(s, D == direction::up ? residual > 0.0 : residual < 0.0);
}

/// Sign of |exact| - |r|, from the difference of two integers of 106 bits that is known to be below
/// 2^63 in magnitude: the low 64 bits suffice.
[[gnu::always_inline]] constexpr std::int64_t low_difference(std::uint64_t p,
                                                             std::uint64_t q) noexcept {
    return static_cast<std::int64_t>(p - q);
}

/// r moved to the side D of the exact value, `excess` being the sign of |exact| - |r|. Without
/// branches: the magnitude may grow by one step if excess > 0, or shrink by one if excess < 0.
template <direction D>
[[gnu::always_inline]] constexpr double to_side(double r, std::int64_t excess) noexcept {
    auto const negative = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits(r)) >> 63);
    std::uint64_t const may_grow = D == direction::up ? ~negative : negative;
    std::uint64_t const grow = (std::uint64_t{0} - static_cast<std::uint64_t>(excess)) >> 63;
    auto const shrink = static_cast<std::uint64_t>(excess >> 63);
    return std::bit_cast<double>(bits(r) + ((grow & may_grow) | (shrink & ~may_grow)));
}

/// a b. With significands m and p = m_p 2^k in units of the last place of the exact product
/// (k is 52, 53 or 54), the residual is m_a m_b - m_p 2^k.
template <direction D>
[[gnu::always_inline]] inline double mul(double a, double b) noexcept {
    a = opaque(a);
    b = opaque(b);
    double const p = opaque(a * b);
    std::uint64_t const ea = exponent(a), eb = exponent(b), ep = exponent(p);
    if (are_normal(ea, eb, ep)) [[likely]]
        return to_side<D>(p, low_difference(significand(a) * significand(b),
                                            significand(p) << ((ep - ea - eb + 1075) & 63)));
    if (is_zero(a) || is_zero(b)) return p; // exact, or 0 * inf = NaN
    return directed_mul<D>(a, b);
}

#if !SIVID_MACHINE_X86_64

/// Residual a b - p of a rounded product p, of the right sign in every rounding mode; exact for p 0
/// or 2^-960 <= |p| <= 2^1020 and |a|, |b| below 2^1020. Heads of 26 bits, as below.
[[gnu::always_inline]] inline double product_residual(double a, double b, double p) noexcept {
    auto const head = [](double x) {
        return std::bit_cast<double>((bits(x) + (std::uint64_t{1} << 26)) &
                                     ~((std::uint64_t{1} << 27) - 1));
    };
    double const ah = head(a), bh = head(b);
    double const al = opaque(a - ah), bl = opaque(b - bh);
    double r = opaque(ah * bh) - p;
    r = opaque(r) + opaque(ah * bl);
    r = opaque(r) + opaque(al * bh);
    return opaque(r) + opaque(al * bl);
}

#else

/// Residual a b - p of rounded products p, of the right sign in every rounding mode; exact for
/// 2^-960 <= |p| <= 2^1020 and |a|, |b| below 2^1023, else anything or NaN.
[[gnu::always_inline]] inline __m128d product_residual(__m128d a, __m128d b, __m128d p) noexcept {
#if defined(__FMA__)
    return _mm_fmsub_pd(a, b, p);
#else
    // Heads of 26 bits, rounded in the integers, and tails of 26 bits with a sign. All products
    // have at most 52 bits. In units of the last place of a b (a 106-bit number), p - a_h b_h is a
    // multiple of 2^52 below 2^81, then the sums are multiples of 2^27 below 2^80, at last the
    // residual itself: every step is exact, but for a last rounding of |residual| > 2^53 that keeps
    // its sign.
    __m128i const half = _mm_set1_epi64x(1 << 26), head = _mm_set1_epi64x(-(1LL << 27));
    auto const heads = [&](__m128d x) {
        return _mm_castsi128_pd(_mm_and_si128(_mm_add_epi64(_mm_castpd_si128(x), half), head));
    };
    __m128d const ah = heads(a), bh = heads(b);
    __m128d const al = _mm_sub_pd(a, ah), bl = _mm_sub_pd(b, bh);
    __m128d r = _mm_sub_pd(_mm_mul_pd(ah, bh), p);
    r = _mm_add_pd(r, _mm_mul_pd(ah, bl));
    r = _mm_add_pd(r, _mm_mul_pd(al, bh));
    return _mm_add_pd(r, _mm_mul_pd(al, bl));
#endif
}

/// Two products rounded up; 0 * inf is 0.
[[gnu::always_inline]] inline __m128d mul_up_pair(__m128d a, __m128d b) noexcept {
    asm("" : "+x"(a), "+x"(b));
    __m128d p = _mm_mul_pd(a, b);
    asm("" : "+x"(p));
    __m128d const r = product_residual(a, b, p);
    __m128d const magnitude = _mm_andnot_pd(_mm_set1_pd(-0.0), p);
    __m128d const usual = _mm_and_pd(_mm_and_pd(_mm_cmpge_pd(magnitude, _mm_set1_pd(0x1p-960)),
                                                _mm_cmple_pd(magnitude, _mm_set1_pd(0x1p1020))),
                                     _mm_cmpord_pd(r, r));
    if (_mm_movemask_pd(usual) == 3) [[likely]] {
        __m128d const zero = _mm_setzero_pd();
        __m128i const away =
            _mm_or_si128(_mm_castpd_si128(_mm_cmplt_pd(p, zero)), _mm_set1_epi64x(1));
        __m128i const shift = _mm_and_si128(_mm_castpd_si128(_mm_cmpgt_pd(r, zero)), away);
        return _mm_castsi128_pd(_mm_add_epi64(_mm_castpd_si128(p), shift));
    }
    double const a0 = _mm_cvtsd_f64(a), b0 = _mm_cvtsd_f64(b);
    double const a1 = _mm_cvtsd_f64(_mm_unpackhi_pd(a, a)),
                 b1 = _mm_cvtsd_f64(_mm_unpackhi_pd(b, b));
    double const p0 = is_zero(a0) || is_zero(b0) ? 0.0 : mul<direction::up>(a0, b0);
    double const p1 = is_zero(a1) || is_zero(b1) ? 0.0 : mul<direction::up>(a1, b1);
    return _mm_set_pd(p1, p0);
}

#endif

/// a / b. The residual of q is a - q b = m_a 2^k - m_q m_b, below m_b in magnitude.
template <direction D>
[[gnu::always_inline]] inline double div(double a, double b) noexcept {
    a = opaque(a);
    b = opaque(b);
    double const q = opaque(a / b);
    std::uint64_t const ea = exponent(a), eb = exponent(b), eq = exponent(q);
    if (are_normal(ea, eb, eq)) [[likely]]
        return to_side<D>(q, low_difference(significand(a) << ((ea - eq - eb + 1075) & 63),
                                            significand(q) * significand(b)));
    if (is_zero(a)) return q;
    return directed_div<D>(a, b);
}

/// sqrt a. The residual of s is a - s^2 = m_a 2^k - m_s^2, at most 2 m_s in magnitude.
template <direction D>
[[gnu::always_inline]] inline double sqrt(double a) noexcept {
    a = opaque(a);
    double const s = opaque(plain_sqrt(a));
    std::uint64_t const ea = exponent(a), es = exponent(s);
    if (are_normal(ea, es, es) && a > 0.0) [[likely]]
        return to_side<D>(s, low_difference(significand(a) << ((ea - 2 * es + 1075) & 63),
                                            significand(s) * significand(s)));
    if (is_zero(a)) return 0.0;
    return directed_sqrt<D>(a);
}

#endif

[[gnu::always_inline]] inline double add_down(double a, double b) noexcept {
    return add<direction::down>(a, b);
}
[[gnu::always_inline]] inline double add_up(double a, double b) noexcept {
    return add<direction::up>(a, b);
}
[[gnu::always_inline]] inline double mul_down(double a, double b) noexcept {
    return mul<direction::down>(a, b);
}
[[gnu::always_inline]] inline double mul_up(double a, double b) noexcept {
    return mul<direction::up>(a, b);
}
[[gnu::always_inline]] inline double div_down(double a, double b) noexcept {
    return div<direction::down>(a, b);
}
[[gnu::always_inline]] inline double div_up(double a, double b) noexcept {
    return div<direction::up>(a, b);
}
[[gnu::always_inline]] inline double sqrt_down(double a) noexcept {
    return sqrt<direction::down>(a);
}
[[gnu::always_inline]] inline double sqrt_up(double a) noexcept { return sqrt<direction::up>(a); }

} // namespace SIVID_ROUNDING_KERNELS

} // namespace sivid::detail

#endif
