// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_AVX2_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_AVX2_HPP

/// @file
/// Four doubles in a 256-bit register, with fused multiply-add. Operations round as MXCSR says; the
/// directed operations (pack_directed.hpp) prove their bounds in every mode of it.

#include <sivid/number/pack/detail/pack_target.hpp>

#if SIVID_PACK_AVX2

#include <immintrin.h>

#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

class mask_avx2 {
public:
    mask_avx2() = default;
    explicit mask_avx2(__m256d m) noexcept : m_{m} {}
    [[nodiscard]] __m256d raw() const noexcept { return m_; }
    [[nodiscard]] unsigned bits() const noexcept {
        return static_cast<unsigned>(_mm256_movemask_pd(m_));
    }
    friend mask_avx2 operator&(mask_avx2 a, mask_avx2 b) noexcept {
        return mask_avx2{_mm256_and_pd(a.m_, b.m_)};
    }
    friend mask_avx2 operator|(mask_avx2 a, mask_avx2 b) noexcept {
        return mask_avx2{_mm256_or_pd(a.m_, b.m_)};
    }
    friend mask_avx2 operator!(mask_avx2 a) noexcept {
        return mask_avx2{_mm256_xor_pd(a.m_, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))};
    }

private:
    __m256d m_ = {};
};

class vector_avx2 {
public:
    using mask = mask_avx2;
    static constexpr std::size_t lanes = 4;
    static constexpr bool fused = true;
    static constexpr bool keeps_own_mode = false;
    static constexpr bool reads_subnormals = false;

    vector_avx2() = default;
    explicit vector_avx2(__m256d v) noexcept : v_{v} {}
    explicit vector_avx2(double x) noexcept : v_{_mm256_set1_pd(x)} {}
    static vector_avx2 load(double const* p) noexcept { return vector_avx2{_mm256_loadu_pd(p)}; }
    void store(double* p) const noexcept { _mm256_storeu_pd(p, v_); }
    [[nodiscard]] __m256d raw() const noexcept { return v_; }

    friend vector_avx2 operator+(vector_avx2 a, vector_avx2 b) noexcept {
        return vector_avx2{_mm256_add_pd(a.v_, b.v_)};
    }
    friend vector_avx2 operator-(vector_avx2 a, vector_avx2 b) noexcept {
        return vector_avx2{_mm256_sub_pd(a.v_, b.v_)};
    }
    /// Opaque, so that a compiler cannot fuse the product with a later sum.
    friend vector_avx2 operator*(vector_avx2 a, vector_avx2 b) noexcept {
        __m256d product = _mm256_mul_pd(a.v_, b.v_);
        __asm__("" : "+x"(product));
        return vector_avx2{product};
    }
    friend vector_avx2 operator/(vector_avx2 a, vector_avx2 b) noexcept {
        return vector_avx2{_mm256_div_pd(a.v_, b.v_)};
    }
    friend vector_avx2 operator-(vector_avx2 a) noexcept {
        return vector_avx2{_mm256_xor_pd(a.v_, _mm256_set1_pd(-0.0))};
    }
    friend vector_avx2 fma(vector_avx2 a, vector_avx2 b, vector_avx2 c) noexcept {
        return vector_avx2{_mm256_fmadd_pd(a.v_, b.v_, c.v_)};
    }
    friend vector_avx2 sqrt(vector_avx2 a) noexcept { return vector_avx2{_mm256_sqrt_pd(a.v_)}; }
    friend vector_avx2 abs(vector_avx2 a) noexcept {
        return vector_avx2{_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v_)};
    }
    /// The second operand where one of them is NaN.
    friend vector_avx2 min(vector_avx2 a, vector_avx2 b) noexcept {
        return vector_avx2{_mm256_min_pd(a.v_, b.v_)};
    }
    friend vector_avx2 max(vector_avx2 a, vector_avx2 b) noexcept {
        return vector_avx2{_mm256_max_pd(a.v_, b.v_)};
    }
    /// The other operand where one of them is NaN.
    friend vector_avx2 min_number(vector_avx2 a, vector_avx2 b) noexcept {
        return select(unordered(b, b), a, min(a, b));
    }
    friend vector_avx2 max_number(vector_avx2 a, vector_avx2 b) noexcept {
        return select(unordered(b, b), a, max(a, b));
    }

    friend mask operator<(vector_avx2 a, vector_avx2 b) noexcept {
        return mask{_mm256_cmp_pd(a.v_, b.v_, _CMP_LT_OQ)};
    }
    friend mask operator<=(vector_avx2 a, vector_avx2 b) noexcept {
        return mask{_mm256_cmp_pd(a.v_, b.v_, _CMP_LE_OQ)};
    }
    friend mask operator>(vector_avx2 a, vector_avx2 b) noexcept { return b < a; }
    friend mask operator>=(vector_avx2 a, vector_avx2 b) noexcept { return b <= a; }
    friend mask operator==(vector_avx2 a, vector_avx2 b) noexcept {
        return mask{_mm256_cmp_pd(a.v_, b.v_, _CMP_EQ_OQ)};
    }
    friend mask unordered(vector_avx2 a, vector_avx2 b) noexcept {
        return mask{_mm256_cmp_pd(a.v_, b.v_, _CMP_UNORD_Q)};
    }
    friend vector_avx2 select(mask m, vector_avx2 yes, vector_avx2 no) noexcept {
        return vector_avx2{_mm256_blendv_pd(no.v_, yes.v_, m.raw())};
    }

    /// The next double above s where m is set (s not NaN and not +inf there).
    friend vector_avx2 step_up(vector_avx2 s, mask m) noexcept {
        auto const zero = _mm256_setzero_pd();
        auto const positive_zero = _mm256_andnot_pd(_mm256_cmp_pd(s.v_, zero, _CMP_EQ_OQ), s.v_);
        auto const away = _mm256_or_si256( // -1 below zero, else +1
            _mm256_castpd_si256(_mm256_cmp_pd(s.v_, zero, _CMP_LT_OQ)), _mm256_set1_epi64x(1));
        return vector_avx2{_mm256_castsi256_pd(
            _mm256_add_epi64(_mm256_castpd_si256(positive_zero),
                             _mm256_and_si256(away, _mm256_castpd_si256(m.raw()))))};
    }

    friend vector_avx2 negate_where(mask m, vector_avx2 a) noexcept {
        return vector_avx2{_mm256_xor_pd(a.v_, _mm256_and_pd(m.raw(), _mm256_set1_pd(-0.0)))};
    }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector_avx2 a) noexcept {
        auto const bit = _mm256_set1_epi64x(1 << I);
        auto const found = _mm256_and_si256(_mm256_castpd_si256(a.v_), bit);
        return mask{_mm256_castsi256_pd(_mm256_cmpeq_epi64(found, bit))};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite normal x > 0.
    friend vector_avx2 exponent(vector_avx2 x) noexcept {
        auto const field = _mm256_srli_epi64(_mm256_castpd_si256(x.v_), 52);
        auto const big = _mm256_set1_pd(0x1p52);
        auto const sum = _mm256_castsi256_pd(_mm256_or_si256(field, _mm256_castpd_si256(big)));
        return vector_avx2{_mm256_sub_pd(sum, _mm256_set1_pd(0x1p52 + 1023))};
    }
    friend vector_avx2 mantissa(vector_avx2 x) noexcept {
        auto const field = _mm256_set1_epi64x(0x000FFFFFFFFFFFFF);
        auto const one = _mm256_castpd_si256(_mm256_set1_pd(1.0));
        return vector_avx2{_mm256_castsi256_pd(
            _mm256_or_si256(_mm256_and_si256(_mm256_castpd_si256(x.v_), field), one))};
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector_avx2 power_of_two(vector_avx2 k) noexcept {
        auto const sum = _mm256_add_pd(k.v_, _mm256_set1_pd(0x1.8p52)); // k in the low bits
        auto const biased = _mm256_add_epi64(_mm256_castpd_si256(sum), _mm256_set1_epi64x(1023));
        return vector_avx2{_mm256_castsi256_pd(_mm256_slli_epi64(biased, 52))};
    }

private:
    __m256d v_ = {};
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
#endif
