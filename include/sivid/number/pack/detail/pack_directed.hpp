// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_DIRECTED_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_DIRECTED_HPP

/// @file
/// Directed operations without directed rounding: the sign of the exact residual says on which side
/// of the exact value the rounded one lies; where it lies on the wrong side, one step outward.
///
/// Proven for *faithful* rounding (the result is one of the two neighbours of the exact value),
/// hence in every mode of MXCSR, and even if a compiler folds or moves operations across a change
/// of the mode. Assumed: FTZ and DAZ off. Bounds are the tightest when the mode is the nearest.
///
/// What is small is inlined always: g++ 12 with -flto takes an argument for unread of which members
/// are only handed on by value (docs/numbers.md, Compilers). Functions with aggregates by reference
/// therefore hand on copies of their members where what they call is larger.

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/rounding/detail/exact_rounding.hpp>

#include <array>
#include <cstddef>

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
/// (docs/pack_functions.md, section 2).
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
        V const half = halve(k);
        return mul_down(a * power_of_two(half), power_of_two(k - half));
    }
    static V scale_up(V a, V k) noexcept {
        V const half = halve(k);
        return mul_up(a * power_of_two(half), power_of_two(k - half));
    }

private:
    /// An integer near k/2; 0 for k = 0, 0 or -1 for k = -1.
    static V halve(V k) noexcept { return (k * V(0.5) + V(0x1.8p52)) - V(0x1.8p52); }

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

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
