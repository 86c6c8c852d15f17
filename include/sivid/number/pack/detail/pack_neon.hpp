// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_NEON_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_NEON_HPP

/// @file
/// Two doubles in a 128-bit register of ARM64, with fused multiply-add. Operations round as FPCR
/// says; the directed operations (pack_directed.hpp) prove their bounds in every mode of it.

#include <sivid/number/pack/detail/pack_target.hpp>

#if SIVID_MACHINE_ARM64

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

class mask_neon {
public:
    mask_neon() = default;
    explicit mask_neon(uint64x2_t m) noexcept : m_{m} {}
    [[nodiscard]] uint64x2_t raw() const noexcept { return m_; }
    [[nodiscard]] unsigned bits() const noexcept {
        return static_cast<unsigned>((vgetq_lane_u64(m_, 0) & 1) | (vgetq_lane_u64(m_, 1) & 2));
    }
    friend mask_neon operator&(mask_neon a, mask_neon b) noexcept {
        return mask_neon{vandq_u64(a.m_, b.m_)};
    }
    friend mask_neon operator|(mask_neon a, mask_neon b) noexcept {
        return mask_neon{vorrq_u64(a.m_, b.m_)};
    }
    friend mask_neon operator!(mask_neon a) noexcept { return mask_neon{vceqzq_u64(a.m_)}; }

private:
    uint64x2_t m_ = {};
};

class vector_neon {
public:
    using mask = mask_neon;
    static constexpr std::size_t lanes = 2;
    static constexpr bool fused = true; // fma() rounds once
    static constexpr bool keeps_own_mode = false;
    static constexpr bool reads_subnormals = false;

    vector_neon() = default;
    explicit vector_neon(float64x2_t v) noexcept : v_{v} {}
    explicit vector_neon(double x) noexcept : v_{vdupq_n_f64(x)} {}
    static vector_neon load(double const* p) noexcept { return vector_neon{vld1q_f64(p)}; }
    void store(double* p) const noexcept { vst1q_f64(p, v_); }
    [[nodiscard]] float64x2_t raw() const noexcept { return v_; }

    friend vector_neon operator+(vector_neon a, vector_neon b) noexcept {
        return vector_neon{vaddq_f64(a.v_, b.v_)};
    }
    friend vector_neon operator-(vector_neon a, vector_neon b) noexcept {
        return vector_neon{vsubq_f64(a.v_, b.v_)};
    }
    /// Opaque, so that a compiler cannot fuse the product with a later sum.
    friend vector_neon operator*(vector_neon a, vector_neon b) noexcept {
        float64x2_t product = vmulq_f64(a.v_, b.v_);
        __asm__("" : SIVID_REGISTER(product));
        return vector_neon{product};
    }
    friend vector_neon operator/(vector_neon a, vector_neon b) noexcept {
        return vector_neon{vdivq_f64(a.v_, b.v_)};
    }
    friend vector_neon operator-(vector_neon a) noexcept { return vector_neon{vnegq_f64(a.v_)}; }
    friend vector_neon fma(vector_neon a, vector_neon b, vector_neon c) noexcept {
        return vector_neon{vfmaq_f64(c.v_, a.v_, b.v_)};
    }
    friend vector_neon sqrt(vector_neon a) noexcept { return vector_neon{vsqrtq_f64(a.v_)}; }
    friend vector_neon abs(vector_neon a) noexcept { return vector_neon{vabsq_f64(a.v_)}; }
    /// The second operand where one of them is NaN (the machine's own would be NaN).
    friend vector_neon min(vector_neon a, vector_neon b) noexcept { return select(a < b, a, b); }
    friend vector_neon max(vector_neon a, vector_neon b) noexcept { return select(b < a, a, b); }
    /// The other operand where one of them is NaN.
    friend vector_neon min_number(vector_neon a, vector_neon b) noexcept {
        return select((a < b) | unordered(b, b), a, b);
    }
    friend vector_neon max_number(vector_neon a, vector_neon b) noexcept {
        return select((b < a) | unordered(b, b), a, b);
    }

    friend mask operator<(vector_neon a, vector_neon b) noexcept {
        return mask{vcltq_f64(a.v_, b.v_)};
    }
    friend mask operator<=(vector_neon a, vector_neon b) noexcept {
        return mask{vcleq_f64(a.v_, b.v_)};
    }
    friend mask operator>(vector_neon a, vector_neon b) noexcept { return b < a; }
    friend mask operator>=(vector_neon a, vector_neon b) noexcept { return b <= a; }
    friend mask operator==(vector_neon a, vector_neon b) noexcept {
        return mask{vceqq_f64(a.v_, b.v_)};
    }
    friend mask unordered(vector_neon a, vector_neon b) noexcept {
        return !(mask{vceqq_f64(a.v_, a.v_)} & mask{vceqq_f64(b.v_, b.v_)});
    }
    friend vector_neon select(mask m, vector_neon yes, vector_neon no) noexcept {
        return vector_neon{vbslq_f64(m.raw(), yes.v_, no.v_)};
    }

    /// The next double above s where m is set (s not NaN and not +inf there).
    friend vector_neon step_up(vector_neon s, mask m) noexcept {
        uint64x2_t const is_zero = vceqzq_f64(s.v_);
        uint64x2_t const positive_zero = vbicq_u64(vreinterpretq_u64_f64(s.v_), is_zero);
        uint64x2_t const away = // -1 below zero, else +1
            vorrq_u64(vcltzq_f64(s.v_), vdupq_n_u64(1));
        return vector_neon{
            vreinterpretq_f64_u64(vaddq_u64(positive_zero, vandq_u64(away, m.raw())))};
    }

    friend vector_neon negate_where(mask m, vector_neon a) noexcept {
        uint64x2_t const flipped = vandq_u64(m.raw(), sign_bits());
        return vector_neon{vreinterpretq_f64_u64(veorq_u64(vreinterpretq_u64_f64(a.v_), flipped))};
    }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector_neon a) noexcept {
        return mask{vtstq_u64(vreinterpretq_u64_f64(a.v_), vdupq_n_u64(std::uint64_t{1} << I))};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite normal x > 0.
    friend vector_neon exponent(vector_neon x) noexcept {
        uint64x2_t const field = vshrq_n_u64(vreinterpretq_u64_f64(x.v_), 52);
        return vector_neon{vsubq_f64(vcvtq_f64_u64(field), vdupq_n_f64(1023.0))};
    }
    friend vector_neon mantissa(vector_neon x) noexcept {
        uint64x2_t const fraction =
            vandq_u64(vreinterpretq_u64_f64(x.v_), vdupq_n_u64(0x000F'FFFF'FFFF'FFFF));
        uint64x2_t const one = vreinterpretq_u64_f64(vdupq_n_f64(1.0));
        return vector_neon{vreinterpretq_f64_u64(vorrq_u64(fraction, one))};
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector_neon power_of_two(vector_neon k) noexcept {
        int64x2_t const biased = vaddq_s64(vcvtq_s64_f64(k.v_), vdupq_n_s64(1023));
        return vector_neon{vreinterpretq_f64_s64(vshlq_n_s64(biased, 52))};
    }

private:
    static uint64x2_t sign_bits() noexcept { return vdupq_n_u64(std::uint64_t{1} << 63); }

    float64x2_t v_ = {};
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
#endif
