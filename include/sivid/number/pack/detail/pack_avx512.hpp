// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_AVX512_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_AVX512_HPP

/// @file
/// Eight doubles in a 512-bit register. Every instruction carries its rounding in its encoding
/// (embedded rounding), round-to-nearest included: results do not depend on the rounding mode of
/// the thread, and compilers can neither fold, share nor contract them.

#include <sivid/number/pack/detail/pack_arithmetic.hpp>
#include <sivid/number/pack/detail/pack_target.hpp>

#if SIVID_PACK_AVX512

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
