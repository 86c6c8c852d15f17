// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ARITHMETIC_HPP
#define SIVID_NUMBER_ARITHMETIC_HPP

/// @file
/// Tight interval arithmetic on the vocabulary type: every bound is the nearest double on its side.
/// Set semantics of IEEE 1788: 0 * inf = 0, operations on the empty set are empty, a divisor that
/// contains zero gives the hull of the quotients that exist.

#include <sivid/number/interval.hpp>
#include <sivid/number/rounding.hpp>

#include <bit>
#include <cstdint>

namespace sivid::detail {

inline namespace SIVID_ROUNDING_KERNELS {

inline interval neg(interval const& x) noexcept {
    return unchecked_interval(-x.upper(), -x.lower());
}

[[gnu::always_inline]] inline interval add(interval const& x, interval const& y) noexcept {
    return unchecked_interval(add_down(x.lower(), y.lower()), add_up(x.upper(), y.upper()));
}

[[gnu::always_inline]] inline interval sub(interval const& x, interval const& y) noexcept {
    return unchecked_interval(add_down(x.lower(), -y.upper()), add_up(x.upper(), -y.lower()));
}

#if SIVID_EMBEDDED_ROUNDING

/// All four products at once: lanes 0 to 3 hold x y, lanes 4 to 7 hold x (-y), both rounded upward;
/// the greatest of each half are the upper bound and minus the lower bound. (The zero-masking forms
/// of the intrinsics keep g++ from warning about its own header.)
inline interval mul(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) [[unlikely]]
        return empty_interval();
    constexpr __mmask8 all = 0xff;
    __m512d const xx = _mm512_zextpd128_pd512(_mm_set_pd(opaque(x.upper()), opaque(x.lower())));
    __m512d const yy = _mm512_zextpd128_pd512(_mm_set_pd(opaque(y.upper()), opaque(y.lower())));
    __m512d const a =
        _mm512_maskz_permutexvar_pd(all, _mm512_set_epi64(1, 1, 0, 0, 1, 1, 0, 0), xx);
    __m512d const b =
        _mm512_maskz_permutexvar_pd(all, _mm512_set_epi64(1, 0, 1, 0, 1, 0, 1, 0), yy);
    constexpr auto minus = std::bit_cast<long long>(sign_bit);
    __m512d const c = _mm512_castsi512_pd(_mm512_xor_si512(
        _mm512_castpd_si512(b), _mm512_set_epi64(minus, minus, minus, minus, 0, 0, 0, 0)));
    __m512d p = _mm512_maskz_mul_round_pd(all, a, c, embedded<direction::up>);
    p = _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(p, p, _CMP_ORD_Q), p);
    p = _mm512_maskz_max_pd(all, p, _mm512_maskz_permute_pd(all, p, 0x55));
    p = _mm512_maskz_max_pd(all, p, _mm512_maskz_permutex_pd(all, p, 0x4e));
    double const hi = _mm512_cvtsd_f64(p);
    double const minus_lo = _mm256_cvtsd_f64(_mm512_maskz_extractf64x4_pd(all, p, 1));
    return unchecked_interval(-minus_lo, hi);
}

#else

/// Two products a_i b_i as [a_0 b_0 rounded down, a_1 b_1 rounded up]; 0 * inf is 0.
[[gnu::always_inline]] inline interval products(std::uint64_t a0, std::uint64_t b0,
                                                std::uint64_t a1, std::uint64_t b1) noexcept {
#if SIVID_MACHINE_X86_64
    std::uint64_t const minus_a0 = a0 ^ sign_bit;
    __m128d const up =
        mul_up_pair(_mm_set_pd(std::bit_cast<double>(a1), std::bit_cast<double>(minus_a0)),
                    _mm_set_pd(std::bit_cast<double>(b1), std::bit_cast<double>(b0)));
    return unchecked_interval(-_mm_cvtsd_f64(up), _mm_cvtsd_f64(_mm_unpackhi_pd(up, up)));
#else
    auto const x0 = std::bit_cast<double>(a0), y0 = std::bit_cast<double>(b0);
    auto const x1 = std::bit_cast<double>(a1), y1 = std::bit_cast<double>(b1);
    return unchecked_interval(is_zero(x0) || is_zero(y0) ? 0.0 : mul_down(x0, y0),
                              is_zero(x1) || is_zero(y1) ? 0.0 : mul_up(x1, y1));
#endif
}

/// Unless both factors have both signs, the end points that make the lower bound are given by two
/// signs (the upper bound is minus the lower bound of x (-y)):
///   from x: the upper end if y_l < 0 (if y_u < 0 where x <= 0), else the lower end; from y
///   likewise.
/// Signs are sign bits: a zero counts as a tiny number of its sign, which selects products with the
/// same limit. Selection is by masks, since signs of operands cannot be predicted.
inline interval mul(interval const& x, interval const& y) noexcept {
    if (is_empty(x) || is_empty(y)) [[unlikely]]
        return empty_interval();
    std::uint64_t const xl = bits(x.lower()), xu = bits(x.upper());
    std::uint64_t const yl = bits(y.lower()), yu = bits(y.upper());
    auto const negative = [](std::uint64_t b) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(b) >> 63);
    };
    auto const select = [](std::uint64_t mask, std::uint64_t a, std::uint64_t b) {
        return (a & mask) | (b & ~mask);
    };
    std::uint64_t const nxl = negative(xl), nxu = negative(xu), nyl = negative(yl),
                        nyu = negative(yu);
    if ((nxl & ~nxu & nyl & ~nyu) != 0) {
        interval const p = products(xl, yu, xl, yl), q = products(xu, yl, xu, yu);
        return unchecked_interval(p.lower() < q.lower() ? p.lower() : q.lower(),
                                  p.upper() > q.upper() ? p.upper() : q.upper());
    }
    return products(select(select(nxu, nyu, nyl), xu, xl), select(select(nyu, nxu, nxl), yu, yl),
                    select(select(nxu, nyl, nyu), xl, xu), select(select(nyl, nxl, nxu), yl, yu));
}

#endif

inline interval sqr(interval const& x) noexcept {
    if (is_empty(x)) [[unlikely]]
        return empty_interval();
    double const least = mig(x), most = mag(x);
#if SIVID_EMBEDDED_ROUNDING
    return unchecked_interval(mul_down(least, least), mul_up(most, most));
#else
    return products(bits(least), bits(least), bits(most), bits(most));
#endif
}

/// Quotients x/y with y in Y, y != 0; `undefined` if Y contains 0 (and X is not empty).
inline interval div(interval const& x, interval const& y, bool& undefined) noexcept {
    if (is_empty(x) || is_empty(y)) return empty_interval();
    double const xl = x.lower(), xu = x.upper(), yl = y.lower(), yu = y.upper();
    if (yl <= 0.0 && yu >= 0.0) {
        undefined = true;
        if (is_zero(yl) && is_zero(yu)) return empty_interval();
        if (is_zero(xl) && is_zero(xu)) return unchecked_interval(0.0, 0.0);
        if ((yl < 0.0 && yu > 0.0) || (xl < 0.0 && xu > 0.0)) return entire_interval();
        // One end of y is zero, x is on one side: a half-line from the quotient nearest to zero.
        bool const positive = (xl >= 0.0) == (yu > 0.0);
        double const nearest_x = xl >= 0.0 ? xl : xu, farthest_y = yu > 0.0 ? yu : yl;
        // An infinite divisor or zero numerator brings the quotients down to 0.
        if (is_zero(nearest_x) || is_infinite(farthest_y))
            return positive ? unchecked_interval(0.0, infinity)
                            : unchecked_interval(-infinity, 0.0);
        return positive ? unchecked_interval(div_down(nearest_x, farthest_y), infinity)
                        : unchecked_interval(-infinity, div_up(nearest_x, farthest_y));
    }
    double a, b, c, d; // the result is [a/b, c/d]
    if (yl > 0.0) {
        a = xl;
        b = xl >= 0.0 ? yu : yl;
        c = xu;
        d = xu >= 0.0 ? yl : yu;
    } else {
        a = xu;
        b = xu >= 0.0 ? yu : yl;
        c = xl;
        d = xl >= 0.0 ? yl : yu;
    }
    return unchecked_interval(div_down(a, b), div_up(c, d));
}

} // namespace SIVID_ROUNDING_KERNELS

} // namespace sivid::detail

#endif
