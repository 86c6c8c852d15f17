// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_ARITHMETIC_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_ARITHMETIC_HPP

/// @file
/// Directed operations without directed rounding: the sign of the exact residual says on which side
/// of the exact value the rounded one lies; where it lies on the wrong side, one step outward. And
/// interval operations on vectors of lower and upper bounds, without branches on data. Meanings as
/// in IEEE 1788: bounds NaN = empty, 0 * inf = 0, quotients over the non-zero part of the divisor.
/// All tight. Masks are set where the function is not defined on the whole argument.
///
/// Proven for *faithful* rounding (the result is one of the two neighbours of the exact value),
/// hence in every mode of the control register, and even if a compiler folds or moves operations
/// across a change of the mode. Assumed: FTZ and DAZ off. Bounds are the tightest when the mode is
/// the nearest.
///
/// What is small is inlined always: g++ 12 with -flto takes an argument for unread of which members
/// are only handed on by value (docs/theory/numbers.md, Compilers). Functions with aggregates by
/// reference therefore hand on copies of their members where what they call is larger.

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/pack/detail/vectors.hpp>
#include <sivid/number/rounding.hpp>

#include <array>
#include <cstddef>
#include <limits>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

/// A sum or product and its rounding error: head + tail is the exact value.
template <class V>
struct exact_pair {
    V head, tail;
};

/// The exact sum, given |a| >= |b| or a = 0 (round-to-nearest).
template <class V>
[[nodiscard, gnu::always_inline]] inline exact_pair<V> fast_two_sum(V a, V b) noexcept {
    V const s = a + b;
    return {s, b - (s - a)};
}

/// The exact sum (round-to-nearest).
template <class V>
[[nodiscard, gnu::always_inline]] inline exact_pair<V> two_sum(V a, V b) noexcept {
    V const s = a + b;
    V const b_part = s - a;
    V const a_part = s - b_part;
    return {s, (a - a_part) + (b - b_part)};
}

/// a b - p, exact for p a faithful rounding of a b, if no part of it under- or overflows. Dekker's
/// product: the halves have 26 bits each, their products are exact, and so is every partial sum
/// (docs/theory/pack_functions.md, section 2).
template <class V>
[[nodiscard]] V dekker_residual(V a, V b, V p) noexcept {
    V const ah = leading_half(a), al = a - ah;
    V const bh = leading_half(b), bl = b - bh;
    return (((ah * bh - p) + ah * bl) + al * bh) + al * bl;
}

/// The sign of a b + c, one lane at a time: for the rare lanes that Dekker's product cannot serve.
template <class V>
[[nodiscard]] V sign_by_lanes(V a, V b, V c) noexcept {
    std::array<double, V::lanes> x, y, z;
    a.store(x.data());
    b.store(y.data());
    c.store(z.data());
    for (std::size_t i = 0; i < V::lanes; ++i) x[i] = detail::sign_of_fused(x[i], y[i], z[i]);
    return V::load(x.data());
}

/// The exact product of moderate numbers (round-to-nearest; 2^-900 < |a b| < 2^900 or a b = 0).
template <class V>
[[nodiscard, gnu::always_inline]] inline exact_pair<V> two_product(V a, V b) noexcept {
    V const p = a * b;
    if constexpr (V::fused)
        return {p, fma(a, b, -p)};
    else
        return {p, dekker_residual(a, b, p)};
}

template <class V>
struct directed {
    using mask = typename V::mask;

    [[gnu::always_inline]] static V step_down(V s, mask m) noexcept { return -step_up(-s, m); }

    [[gnu::always_inline]] static V add_up(V a, V b) noexcept {
        V const s = a + b;
        return step_up(s, sum_residual(a, b, s) > V(0.0));
    }
    [[gnu::always_inline]] static V add_down(V a, V b) noexcept {
        V const s = a + b;
        return step_down(s, sum_residual(a, b, s) < V(0.0));
    }
    [[gnu::always_inline]] static V sub_up(V a, V b) noexcept { return add_up(a, -b); }
    [[gnu::always_inline]] static V sub_down(V a, V b) noexcept { return add_down(a, -b); }

    static void mul_both(V a, V b, V& lower, V& upper) noexcept {
        V const p = a * b;
        V const r = product_residual(a, b, p);
        lower = step_down(p, r < V(0.0));
        upper = step_up(p, r > V(0.0));
    }
    static V mul_down(V a, V b) noexcept {
        V const p = a * b;
        return step_down(p, product_residual(a, b, p) < V(0.0));
    }
    static V mul_up(V a, V b) noexcept {
        V const p = a * b;
        return step_up(p, product_residual(a, b, p) > V(0.0));
    }

    /// Given b >= 0, an infinite quotient by b = 0 having its sign from +0.
    static V div_down(V a, V b) noexcept {
        V const q = a / b;
        return step_down(q, quotient_residual(a, b, q) < V(0.0));
    }
    static V div_up(V a, V b) noexcept {
        V const q = a / b;
        return step_up(q, quotient_residual(a, b, q) > V(0.0));
    }

    static V sqrt_down(V a) noexcept {
        V const s = sqrt(a);
        return step_down(s, root_residual(a, s) < V(0.0));
    }
    static V sqrt_up(V a) noexcept {
        V const s = sqrt(a);
        return step_up(s, root_residual(a, s) > V(0.0));
    }

    /// a 2^k for an integer k in [-1200, 1200], |a| below 2^400, and above 2^-400 or k in {-1, 0}:
    /// the first factor is exact.
    static V scale_down(V a, V k) noexcept {
        V const half = halve(k), x = a * power_of_two(half), y = power_of_two(k - half), p = x * y;
        return scales_exactly(p) ? p : step_down(p, product_residual(x, y, p) < V(0.0));
    }
    static V scale_up(V a, V k) noexcept {
        V const half = halve(k), x = a * power_of_two(half), y = power_of_two(k - half), p = x * y;
        return scales_exactly(p) ? p : step_up(p, product_residual(x, y, p) > V(0.0));
    }

private:
    /// An integer near k/2; 0 for k = 0, 0 or -1 for k = -1.
    static V halve(V k) noexcept { return (k * V(0.5) + V(0x1.8p52)) - V(0x1.8p52); }

    /// Whether no lane under- or overflowed.
    static bool scales_exactly(V p) noexcept {
        V const size = abs(p);
        return (!((size > V(0x1p-1000)) & (size < V(0x1p1000)))).bits() == 0;
    }

    /// Sign of a + b - s. With |big| >= |small|, s - big is exact for every faithful s (Sterbenz,
    /// or s = a + b exactly), and the difference of two doubles rounds to zero only if it is zero.
    /// Overflow gives infinities of the right sign, infinite terms give NaN: no step.
    static V sum_residual(V a, V b, V s) noexcept {
        auto const swapped = abs(a) < abs(b);
        V const big = select(swapped, b, a), small = select(swapped, a, b);
        return small - (s - big);
    }

    /// Sign of a b - p; NaN (no step) if a factor is infinite or NaN.
    static V product_residual(V a, V b, V p) noexcept {
        V r = plain_product_residual(a, b, p);
        V const zero(0.0), one(1.0), scale(0x1p600);
        auto const tiny = (abs(p) < V(0x1p-900)) & (min(abs(a), abs(b)) > zero);
        if (tiny.bits() != 0) [[unlikely]] {
            // The residual may underflow: compare (a 2^i)(b 2^j) with p 2^(i+j), exact scalings.
            V const x = a * select(abs(a) < one, scale, one),
                    y = b * select(abs(b) < one, scale, one);
            V const scaled =
                (p * select(abs(a) < one, scale, one)) * select(abs(b) < one, scale, one);
            r = select(tiny, V::fused ? fma(x, y, -scaled) : sign_by_lanes(x, y, -scaled), r);
        }
        return r;
    }

    static V plain_product_residual(V a, V b, V p) noexcept {
        if constexpr (V::fused) {
            return fma(a, b, -p);
        } else {
            V const r = dekker_residual(a, b, p);
            auto const huge = (max(abs(a), abs(b)) > V(0x1p990)) | (abs(p) > V(0x1p1000));
            if (huge.bits() == 0) [[likely]]
                return r;
            return select(huge, sign_by_lanes(a, b, -p), r);
        }
    }

    /// Sign of a / b - q for b > 0: of a - q b, scaled up where a is tiny.
    static V quotient_residual(V a, V b, V q) noexcept {
        V const scale = select(abs(a) < V(0x1p-900), V(0x1p512), V(1.0));
        return remainder(a * scale, b, q * scale);
    }

    /// Sign of a - q b for a faithful q = a / b.
    static V remainder(V a, V b, V q) noexcept {
        if constexpr (V::fused) {
            return -fma(q, b, -a);
        } else {
            V const p = q * b; // within a few ulp of a: a - p is exact
            V const r = (a - p) - dekker_residual(q, b, p);
            auto const huge = (max(abs(q), abs(b)) > V(0x1p990)) | (abs(a) > V(0x1p990));
            if (huge.bits() == 0) [[likely]]
                return r;
            return select(huge, -sign_by_lanes(q, b, -a), r);
        }
    }

    /// Sign of sqrt(a) - s for a >= 0: of a - s^2.
    static V root_residual(V a, V s) noexcept {
        auto const tiny = a < V(0x1p-900);
        V const x = a * select(tiny, V(0x1p512), V(1.0));
        V const y = s * select(tiny, V(0x1p256), V(1.0));
        return remainder(x, y, y);
    }
};

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double least_double = std::numeric_limits<double>::denorm_min();

/// One interval in each lane. Handed over by reference throughout: g++ 12 at -O1 takes the copy of
/// a by-value argument on the stack for unchanged after a call in between (it found
/// cosh_upper(mag(t)) to be cosh_upper(mig(t))).
template <class V>
struct bounds {
    V lo, hi;
};

template <class V>
using mask_of = typename V::mask;

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> select(mask_of<V> m, bounds<V> const& yes,
                                                          bounds<V> const& no) noexcept {
    return {select(m, yes.lo, no.lo), select(m, yes.hi, no.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> constant(double lo, double hi) noexcept {
    return {V(lo), V(hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> empty_where(mask_of<V> m,
                                                               bounds<V> const& x) noexcept {
    return select(m, constant<V>(not_a_number, not_a_number), x);
}

template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> is_empty(bounds<V> const& a) noexcept {
    return unordered(a.lo, a.lo);
}
template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> either_empty(bounds<V> const& a,
                                                                 bounds<V> const& b) noexcept {
    return unordered(a.lo, b.lo);
}
template <class V>
[[nodiscard, gnu::always_inline]] inline mask_of<V> contains_zero(bounds<V> const& a) noexcept {
    return (a.lo <= V(0.0)) & (a.hi >= V(0.0));
}

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> neg(bounds<V> const& a) noexcept {
    return {-a.hi, -a.lo};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> add(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    return {d::add_down(a.lo, b.lo), d::add_up(a.hi, b.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> sub(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    return {d::sub_down(a.lo, b.hi), d::sub_up(a.hi, b.lo)};
}

/// Extremes of the four products of the ends. 0 * inf is NaN and left out: another product then
/// yields the 0, except for zero times everything, where all four are NaN.
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> mul(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    using d = directed<V>;
    V l0, l1, l2, l3, u0, u1, u2, u3;
    V const p = a.lo, q = a.hi, r = b.lo, s = b.hi; // copies: see the top
    d::mul_both(p, r, l0, u0);
    d::mul_both(p, s, l1, u1);
    d::mul_both(q, r, l2, u2);
    d::mul_both(q, s, l3, u3);
    V const lo = min_number(min_number(l0, l1), min_number(l2, l3));
    V const hi = max_number(max_number(u0, u1), max_number(u2, u3));
    auto const zero = unordered(lo, lo) & !either_empty(a, b);
    return {select(zero, V(0.0), lo), select(zero, V(0.0), hi)};
}

/// Two divisions: a divisor below zero is turned, together with the dividend, to one above; then
/// the signs of the dividend's ends choose the divisor's end. A divisor's end 0 counts as +0, so
/// that overflow to infinity has the right sign.
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> div(bounds<V> const& a, bounds<V> const& b,
                                                       mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const zero(0.0);
    auto const turned = b.hi <= zero;
    bounds<V> const n = select(turned, neg(a), a);
    bounds<V> const y = select(turned, neg(b), b);
    V const least = abs(y.lo); // where y.lo < 0 the result is replaced below
    bounds<V> q{d::div_down(n.lo, select(n.lo >= zero, y.hi, least)),
                d::div_up(n.hi, select(n.hi > zero, least, y.hi))};

    auto const none = either_empty(a, b);
    auto const dividend_zero = (a.lo == zero) & (a.hi == zero);
    auto const zero_inside = y.lo < zero;
    q = select(zero_inside, constant<V>(-infinity, infinity), q);
    q = select(zero_inside & dividend_zero, constant<V>(0.0, 0.0), q);
    undefined = undefined | (contains_zero(b) & !none);
    return empty_where(none | (y.hi == zero), q);
}

template <class V>
[[nodiscard, gnu::always_inline]] inline V mig(bounds<V> const& a) noexcept {
    return select(contains_zero(a), V(0.0), min(abs(a.lo), abs(a.hi)));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline V mag(bounds<V> const& a) noexcept {
    return max(abs(a.lo), abs(a.hi));
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> abs(bounds<V> const& a) noexcept {
    return {mig(a), mag(a)};
}
template <class V>
[[nodiscard]] bounds<V> sqr(bounds<V> const& a) noexcept {
    using d = directed<V>;
    V const low = mig(a), high = mag(a);
    return {d::mul_down(low, low), d::mul_up(high, high)};
}
template <class V>
[[nodiscard]] bounds<V> sqrt(bounds<V> const& a, mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const zero(0.0);
    auto const below = a.hi < zero;
    undefined = undefined | (a.lo < zero);
    bounds<V> const x{max(zero, a.lo), select(below, zero, a.hi)};
    return empty_where(below, bounds<V>{d::sqrt_down(x.lo), d::sqrt_up(x.hi)});
}

template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> min(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    return empty_where(either_empty(a, b), bounds<V>{min(a.lo, b.lo), min(a.hi, b.hi)});
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> max(bounds<V> const& a,
                                                       bounds<V> const& b) noexcept {
    return empty_where(either_empty(a, b), bounds<V>{max(a.lo, b.lo), max(a.hi, b.hi)});
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> hull(bounds<V> const& a,
                                                        bounds<V> const& b) noexcept {
    return {min_number(a.lo, b.lo), max_number(a.hi, b.hi)};
}
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> intersect(bounds<V> const& a,
                                                             bounds<V> const& b) noexcept {
    V const lo = max(a.lo, b.lo), hi = min(a.hi, b.hi);
    return empty_where(either_empty(a, b) | (hi < lo), bounds<V>{lo, hi});
}

/// \f$ \{\mathrm{sign}\, t\} \f$ with sign 0 = 0.
template <class V>
[[nodiscard]] bounds<V> sign(bounds<V> const& a) noexcept {
    V const zero(0.0), one(1.0);
    auto const of = [&](V t) {
        return select(t > zero, one, select(t < zero, -one, select(unordered(t, t), t, zero)));
    };
    V const lo = a.lo, hi = a.hi;
    return {of(lo), of(hi)};
}

/// \f$ \{t^n\} \f$, by squaring; at most 2 log2(n) roundings a side.
template <class V>
[[nodiscard]] bounds<V> pown(bounds<V> const& a, int n, mask_of<V>& undefined) noexcept {
    using d = directed<V>;
    V const one(1.0), zero(0.0);
    if (n == 0) return empty_where(is_empty(a), bounds<V>{one, one});
    auto const magnitude = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n);
    // Bounds of |t|^(n or n-1) for each end, an even power.
    auto const even_power = [](V t, unsigned m) {
        bounds<V> power{V(1.0), V(1.0)}, factor{t, t};
        for (; m != 0; m /= 2) {
            if (m % 2 != 0)
                power = {d::mul_down(power.lo, factor.lo), d::mul_up(power.hi, factor.hi)};
            if (m > 1)
                factor = {d::mul_down(factor.lo, factor.lo), d::mul_up(factor.hi, factor.hi)};
        }
        return power;
    };
    bounds<V> y;
    if (n == 1) {
        y = a;
    } else if (magnitude % 2 == 0) {
        y = {even_power(mig(a), magnitude).lo, even_power(mag(a), magnitude).hi};
    } else {
        bounds<V> const p = even_power(abs(a.lo), magnitude - 1),
                        q = even_power(abs(a.hi), magnitude - 1);
        y = {d::mul_down(a.lo, select(a.lo < zero, p.hi, p.lo)),
             d::mul_up(a.hi, select(a.hi < zero, q.lo, q.hi))};
    }
    if (n > 0) return y;
    auto const has_zero = contains_zero(a);
    undefined = undefined | has_zero;
    auto ignored = has_zero; // a power that underflows to zero is not one
    return div(bounds<V>{one, one}, y, ignored);
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

// Eight doubles in a 512-bit register. Every instruction carries its rounding in its encoding
// (embedded rounding), round-to-nearest included: results do not depend on the rounding mode of
// the thread, and compilers can neither fold, share nor contract them.

#if SIVID_PACK_AVX512 && SIVID_FUSED

#include <immintrin.h>

#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

/// The mask of the forms with zeroing: the plain forms of g++ 12 warn about an uninitialised
/// operand. Not a constant, because without optimisation the forms are macros that take a signed
/// char.
[[nodiscard]] inline __mmask8 all_lanes() noexcept { return 0xFF; }

template <>
class vector_mask<8> {
public:
    vector_mask() = default;
    explicit vector_mask(__mmask8 m) noexcept : bits_{m} {}
    [[nodiscard]] __mmask8 raw() const noexcept { return bits_; }
    [[nodiscard]] unsigned bits() const noexcept { return bits_; }
    friend vector_mask operator&(vector_mask a, vector_mask b) noexcept {
        return vector_mask{static_cast<__mmask8>(a.bits_ & b.bits_)};
    }
    friend vector_mask operator|(vector_mask a, vector_mask b) noexcept {
        return vector_mask{static_cast<__mmask8>(a.bits_ | b.bits_)};
    }
    friend vector_mask operator!(vector_mask a) noexcept {
        return vector_mask{static_cast<__mmask8>(~a.bits_)};
    }

private:
    __mmask8 bits_ = 0;
};

template <>
class vector<8> {
public:
    using mask = vector_mask<8>;
    static constexpr std::size_t lanes = 8;
    static constexpr bool fused = true;          // fma() rounds once
    static constexpr bool keeps_own_mode = true; // results do not depend on MXCSR's rounding field
    static constexpr bool reads_subnormals = true; // exponent() and mantissa()

    vector() = default;
    explicit vector(__m512d v) noexcept : v_{v} {}
    explicit vector(double x) noexcept : v_{_mm512_set1_pd(x)} {}
    static vector load(double const* p) noexcept { return vector{_mm512_loadu_pd(p)}; }
    void store(double* p) const noexcept { _mm512_storeu_pd(p, v_); }
    [[nodiscard]] __m512d raw() const noexcept { return v_; }

    [[gnu::always_inline]] friend vector kept(vector a) noexcept {
        __asm__("" : SIVID_REGISTER(a.v_));
        return a;
    }
    friend vector operator+(vector a, vector b) noexcept {
        return vector{_mm512_maskz_add_round_pd(all_lanes(), a.v_, b.v_, nearest)};
    }
    friend vector operator-(vector a, vector b) noexcept {
        return vector{_mm512_maskz_sub_round_pd(all_lanes(), a.v_, b.v_, nearest)};
    }
    friend vector operator*(vector a, vector b) noexcept {
        return vector{_mm512_maskz_mul_round_pd(all_lanes(), a.v_, b.v_, nearest)};
    }
    friend vector operator/(vector a, vector b) noexcept {
        return vector{_mm512_maskz_div_round_pd(all_lanes(), a.v_, b.v_, nearest)};
    }
    friend vector operator-(vector a) noexcept {
        return vector{_mm512_xor_pd(a.v_, _mm512_set1_pd(-0.0))};
    }
    friend vector fma(vector a, vector b, vector c) noexcept {
        return vector{_mm512_fmadd_round_pd(a.v_, b.v_, c.v_, nearest)};
    }
    friend vector sqrt(vector a) noexcept {
        return vector{_mm512_maskz_sqrt_round_pd(all_lanes(), a.v_, nearest)};
    }
    friend vector abs(vector a) noexcept {
        return vector{_mm512_andnot_pd(_mm512_set1_pd(-0.0), a.v_)};
    }
    /// The second operand where one of them is NaN.
    friend vector min(vector a, vector b) noexcept {
        return vector{_mm512_maskz_min_round_pd(all_lanes(), a.v_, b.v_, _MM_FROUND_NO_EXC)};
    }
    friend vector max(vector a, vector b) noexcept {
        return vector{_mm512_maskz_max_round_pd(all_lanes(), a.v_, b.v_, _MM_FROUND_NO_EXC)};
    }
    /// The other operand where one of them is NaN.
    friend vector min_number(vector a, vector b) noexcept {
        return vector{_mm512_maskz_range_pd(all_lanes(), a.v_, b.v_, 0x4)};
    }
    friend vector max_number(vector a, vector b) noexcept {
        return vector{_mm512_maskz_range_pd(all_lanes(), a.v_, b.v_, 0x5)};
    }

    friend mask operator<(vector a, vector b) noexcept {
        return mask{_mm512_cmp_pd_mask(a.v_, b.v_, _CMP_LT_OQ)};
    }
    friend mask operator<=(vector a, vector b) noexcept {
        return mask{_mm512_cmp_pd_mask(a.v_, b.v_, _CMP_LE_OQ)};
    }
    friend mask operator>(vector a, vector b) noexcept { return b < a; }
    friend mask operator>=(vector a, vector b) noexcept { return b <= a; }
    friend mask operator==(vector a, vector b) noexcept {
        return mask{_mm512_cmp_pd_mask(a.v_, b.v_, _CMP_EQ_OQ)};
    }
    friend mask unordered(vector a, vector b) noexcept {
        return mask{_mm512_cmp_pd_mask(a.v_, b.v_, _CMP_UNORD_Q)};
    }
    friend vector select(mask m, vector yes, vector no) noexcept {
        return vector{_mm512_mask_blend_pd(m.raw(), no.v_, yes.v_)};
    }

    friend vector negate_where(mask m, vector a) noexcept {
        return vector{_mm512_mask_xor_pd(a.v_, m.raw(), a.v_, _mm512_set1_pd(-0.0))};
    }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector a) noexcept {
        return mask{_mm512_test_epi64_mask(_mm512_castpd_si512(a.v_), _mm512_set1_epi64(1 << I))};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite x > 0, subnormals included.
    friend vector exponent(vector x) noexcept {
        return vector{_mm512_maskz_getexp_pd(all_lanes(), x.v_)};
    }
    friend vector mantissa(vector x) noexcept {
        return vector{
            _mm512_maskz_getmant_pd(all_lanes(), x.v_, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_src)};
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector power_of_two(vector k) noexcept {
        return vector{
            _mm512_maskz_scalef_round_pd(all_lanes(), _mm512_set1_pd(1.0), k.v_, nearest)};
    }

private:
    static constexpr int nearest = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;

    __m512d v_ = {};
};

/// Directed rounding by embedded rounding: each bound is the tightest.
template <>
struct directed<vector<8>> {
    using V = vector<8>;
    static constexpr int down = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
    static constexpr int up = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;

    [[gnu::always_inline]] static V add_down(V a, V b) noexcept {
        return V{_mm512_maskz_add_round_pd(all_lanes(), a.raw(), b.raw(), down)};
    }
    [[gnu::always_inline]] static V add_up(V a, V b) noexcept {
        return V{_mm512_maskz_add_round_pd(all_lanes(), a.raw(), b.raw(), up)};
    }
    [[gnu::always_inline]] static V sub_down(V a, V b) noexcept {
        return V{_mm512_maskz_sub_round_pd(all_lanes(), a.raw(), b.raw(), down)};
    }
    [[gnu::always_inline]] static V sub_up(V a, V b) noexcept {
        return V{_mm512_maskz_sub_round_pd(all_lanes(), a.raw(), b.raw(), up)};
    }
    [[gnu::always_inline]] static V mul_down(V a, V b) noexcept {
        return V{_mm512_maskz_mul_round_pd(all_lanes(), a.raw(), b.raw(), down)};
    }
    [[gnu::always_inline]] static V mul_up(V a, V b) noexcept {
        return V{_mm512_maskz_mul_round_pd(all_lanes(), a.raw(), b.raw(), up)};
    }
    [[gnu::always_inline]] static void mul_both(V a, V b, V& lower, V& upper) noexcept {
        lower = mul_down(a, b);
        upper = mul_up(a, b);
    }
    [[gnu::always_inline]] static V div_down(V a, V b) noexcept {
        return V{_mm512_maskz_div_round_pd(all_lanes(), a.raw(), b.raw(), down)};
    }
    [[gnu::always_inline]] static V div_up(V a, V b) noexcept {
        return V{_mm512_maskz_div_round_pd(all_lanes(), a.raw(), b.raw(), up)};
    }
    [[gnu::always_inline]] static V sqrt_down(V a) noexcept {
        return V{_mm512_maskz_sqrt_round_pd(all_lanes(), a.raw(), down)};
    }
    [[gnu::always_inline]] static V sqrt_up(V a) noexcept {
        return V{_mm512_maskz_sqrt_round_pd(all_lanes(), a.raw(), up)};
    }
    /// a 2^k, k an integer of any size.
    [[gnu::always_inline]] static V scale_down(V a, V k) noexcept {
        return V{_mm512_maskz_scalef_round_pd(all_lanes(), a.raw(), k.raw(), down)};
    }
    [[gnu::always_inline]] static V scale_up(V a, V k) noexcept {
        return V{_mm512_maskz_scalef_round_pd(all_lanes(), a.raw(), k.raw(), up)};
    }
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif

#endif
