// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_SSE2_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_SSE2_HPP

/// @file
/// Two doubles in a 128-bit register, on every x86-64. Operations round as MXCSR says; the directed
/// operations (pack_directed.hpp) prove their bounds in every mode of it.

#include <sivid/number/pack/detail/pack_target.hpp>

#if SIVID_MACHINE_X86_64

#if defined(__FMA__)
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif

#include <cstddef>
#include <cstdint>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

class mask_sse2 {
public:
    mask_sse2() = default;
    explicit mask_sse2(__m128d m) noexcept : m_{m} {}
    [[nodiscard]] __m128d raw() const noexcept { return m_; }
    [[nodiscard]] unsigned bits() const noexcept {
        return static_cast<unsigned>(_mm_movemask_pd(m_));
    }
    friend mask_sse2 operator&(mask_sse2 a, mask_sse2 b) noexcept {
        return mask_sse2{_mm_and_pd(a.m_, b.m_)};
    }
    friend mask_sse2 operator|(mask_sse2 a, mask_sse2 b) noexcept {
        return mask_sse2{_mm_or_pd(a.m_, b.m_)};
    }
    friend mask_sse2 operator!(mask_sse2 a) noexcept {
        return mask_sse2{_mm_xor_pd(a.m_, _mm_castsi128_pd(_mm_set1_epi64x(-1)))};
    }

private:
    __m128d m_ = {};
};

class vector_sse2 {
public:
    using mask = mask_sse2;
    static constexpr std::size_t lanes = 2;
#if defined(__FMA__)
    static constexpr bool fused = true;
#else
    static constexpr bool fused = false; // fma() rounds twice
#endif
    static constexpr bool keeps_own_mode = false;
    static constexpr bool reads_subnormals = false;

    vector_sse2() = default;
    explicit vector_sse2(__m128d v) noexcept : v_{v} {}
    explicit vector_sse2(double x) noexcept : v_{_mm_set1_pd(x)} {}
    static vector_sse2 load(double const* p) noexcept { return vector_sse2{_mm_loadu_pd(p)}; }
    void store(double* p) const noexcept { _mm_storeu_pd(p, v_); }
    [[nodiscard]] __m128d raw() const noexcept { return v_; }

    friend vector_sse2 operator+(vector_sse2 a, vector_sse2 b) noexcept {
        return vector_sse2{_mm_add_pd(a.v_, b.v_)};
    }
    friend vector_sse2 operator-(vector_sse2 a, vector_sse2 b) noexcept {
        return vector_sse2{_mm_sub_pd(a.v_, b.v_)};
    }
    /// Opaque, so that a compiler cannot fuse the product with a later sum.
    friend vector_sse2 operator*(vector_sse2 a, vector_sse2 b) noexcept {
        __m128d product = _mm_mul_pd(a.v_, b.v_);
        __asm__("" : "+x"(product));
        return vector_sse2{product};
    }
    friend vector_sse2 operator/(vector_sse2 a, vector_sse2 b) noexcept {
        return vector_sse2{_mm_div_pd(a.v_, b.v_)};
    }
    friend vector_sse2 operator-(vector_sse2 a) noexcept {
        return vector_sse2{_mm_xor_pd(a.v_, _mm_set1_pd(-0.0))};
    }
    friend vector_sse2 fma(vector_sse2 a, vector_sse2 b, vector_sse2 c) noexcept {
#if defined(__FMA__)
        return vector_sse2{_mm_fmadd_pd(a.v_, b.v_, c.v_)};
#else
        return a * b + c;
#endif
    }
    friend vector_sse2 sqrt(vector_sse2 a) noexcept { return vector_sse2{_mm_sqrt_pd(a.v_)}; }
    friend vector_sse2 abs(vector_sse2 a) noexcept {
        return vector_sse2{_mm_andnot_pd(_mm_set1_pd(-0.0), a.v_)};
    }
    /// The second operand where one of them is NaN.
    friend vector_sse2 min(vector_sse2 a, vector_sse2 b) noexcept {
        return vector_sse2{_mm_min_pd(a.v_, b.v_)};
    }
    friend vector_sse2 max(vector_sse2 a, vector_sse2 b) noexcept {
        return vector_sse2{_mm_max_pd(a.v_, b.v_)};
    }
    /// The other operand where one of them is NaN.
    friend vector_sse2 min_number(vector_sse2 a, vector_sse2 b) noexcept {
        return select(unordered(b, b), a, min(a, b));
    }
    friend vector_sse2 max_number(vector_sse2 a, vector_sse2 b) noexcept {
        return select(unordered(b, b), a, max(a, b));
    }

    friend mask operator<(vector_sse2 a, vector_sse2 b) noexcept {
        return mask{_mm_cmplt_pd(a.v_, b.v_)};
    }
    friend mask operator<=(vector_sse2 a, vector_sse2 b) noexcept {
        return mask{_mm_cmple_pd(a.v_, b.v_)};
    }
    friend mask operator>(vector_sse2 a, vector_sse2 b) noexcept { return b < a; }
    friend mask operator>=(vector_sse2 a, vector_sse2 b) noexcept { return b <= a; }
    friend mask operator==(vector_sse2 a, vector_sse2 b) noexcept {
        return mask{_mm_cmpeq_pd(a.v_, b.v_)};
    }
    friend mask unordered(vector_sse2 a, vector_sse2 b) noexcept {
        return mask{_mm_cmpunord_pd(a.v_, b.v_)};
    }
    friend vector_sse2 select(mask m, vector_sse2 yes, vector_sse2 no) noexcept {
        return vector_sse2{_mm_or_pd(_mm_and_pd(m.raw(), yes.v_), _mm_andnot_pd(m.raw(), no.v_))};
    }

    /// The next double above s where m is set (s not NaN and not +inf there).
    friend vector_sse2 step_up(vector_sse2 s, mask m) noexcept {
        auto const zero = _mm_setzero_pd();
        auto const positive_zero = _mm_andnot_pd(_mm_cmpeq_pd(s.v_, zero), s.v_);
        auto const away = _mm_or_si128( // -1 below zero, else +1
            _mm_castpd_si128(_mm_cmplt_pd(s.v_, zero)), _mm_set1_epi64x(1));
        return vector_sse2{_mm_castsi128_pd(_mm_add_epi64(
            _mm_castpd_si128(positive_zero), _mm_and_si128(away, _mm_castpd_si128(m.raw()))))};
    }

    /// Each a rounded to 26 bits, ties away: the rest has 26 bits as well (|a| < 2^1000).
    friend vector_sse2 leading_half(vector_sse2 a) noexcept {
        auto const rounded =
            _mm_add_epi64(_mm_castpd_si128(a.v_), _mm_set1_epi64x(std::int64_t{1} << 26));
        return vector_sse2{
            _mm_castsi128_pd(_mm_and_si128(rounded, _mm_set1_epi64x(-(std::int64_t{1} << 27))))};
    }

    friend vector_sse2 negate_where(mask m, vector_sse2 a) noexcept {
        return vector_sse2{_mm_xor_pd(a.v_, _mm_and_pd(m.raw(), _mm_set1_pd(-0.0)))};
    }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector_sse2 a) noexcept {
        auto const bit = _mm_set1_epi64x(1 << I);
        auto const low = _mm_cmpeq_epi32(_mm_and_si128(_mm_castpd_si128(a.v_), bit), bit);
        return mask{_mm_castsi128_pd(_mm_shuffle_epi32(low, _MM_SHUFFLE(2, 2, 0, 0)))};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite normal x > 0.
    friend vector_sse2 exponent(vector_sse2 x) noexcept {
        auto const field = _mm_srli_epi64(_mm_castpd_si128(x.v_), 52);
        auto const big = _mm_set1_pd(0x1p52);
        auto const sum = _mm_castsi128_pd(_mm_or_si128(field, _mm_castpd_si128(big)));
        return vector_sse2{_mm_sub_pd(sum, _mm_set1_pd(0x1p52 + 1023))};
    }
    friend vector_sse2 mantissa(vector_sse2 x) noexcept {
        auto const field = _mm_set1_epi64x(0x000FFFFFFFFFFFFF);
        auto const one = _mm_castpd_si128(_mm_set1_pd(1.0));
        return vector_sse2{
            _mm_castsi128_pd(_mm_or_si128(_mm_and_si128(_mm_castpd_si128(x.v_), field), one))};
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector_sse2 power_of_two(vector_sse2 k) noexcept {
        auto const sum = _mm_add_pd(k.v_, _mm_set1_pd(0x1.8p52)); // k in the low bits
        auto const biased = _mm_add_epi64(_mm_castpd_si128(sum), _mm_set1_epi64x(1023));
        return vector_sse2{_mm_castsi128_pd(_mm_slli_epi64(biased, 52))};
    }

private:
    __m128d v_ = {};
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
#endif
