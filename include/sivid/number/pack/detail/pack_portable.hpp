// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_PORTABLE_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_PORTABLE_HPP

/// @file
/// One double as a vector of one lane, in plain C++: packs of odd width, every pack of a machine
/// without a back end of its own, and the text from which one starts.

#include <sivid/number/pack/detail/pack_target.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

class mask_portable {
public:
    mask_portable() = default;
    explicit mask_portable(bool m) noexcept : m_{m} {}
    [[nodiscard]] unsigned bits() const noexcept { return m_ ? 1u : 0u; }
    friend mask_portable operator&(mask_portable a, mask_portable b) noexcept {
        return mask_portable{a.m_ && b.m_};
    }
    friend mask_portable operator|(mask_portable a, mask_portable b) noexcept {
        return mask_portable{a.m_ || b.m_};
    }
    friend mask_portable operator!(mask_portable a) noexcept { return mask_portable{!a.m_}; }

private:
    bool m_ = false;
};

class vector_portable {
public:
    using mask = mask_portable;
    static constexpr std::size_t lanes = 1;
    static constexpr bool fused = SIVID_FUSED != 0; // else fma() rounds twice
    static constexpr bool keeps_own_mode = false;
    static constexpr bool reads_subnormals = false;

    vector_portable() = default;
    explicit vector_portable(double x) noexcept : v_{x} {}
    static vector_portable load(double const* p) noexcept { return vector_portable{*p}; }
    void store(double* p) const noexcept { *p = v_; }
    [[nodiscard]] double raw() const noexcept { return v_; }

    friend vector_portable operator+(vector_portable a, vector_portable b) noexcept {
        return vector_portable{a.v_ + b.v_};
    }
    friend vector_portable operator-(vector_portable a, vector_portable b) noexcept {
        return vector_portable{a.v_ - b.v_};
    }
    /// Opaque, so that a compiler cannot fuse the product with a later sum.
    friend vector_portable operator*(vector_portable a, vector_portable b) noexcept {
        return vector_portable{detail::opaque(a.v_ * b.v_)};
    }
    friend vector_portable operator/(vector_portable a, vector_portable b) noexcept {
        return vector_portable{a.v_ / b.v_};
    }
    friend vector_portable operator-(vector_portable a) noexcept { return vector_portable{-a.v_}; }
    friend vector_portable fma(vector_portable a, vector_portable b, vector_portable c) noexcept {
#if SIVID_FUSED
        return vector_portable{detail::fused(a.v_, b.v_, c.v_)};
#else
        return a * b + c;
#endif
    }
    friend vector_portable sqrt(vector_portable a) noexcept {
        return vector_portable{detail::plain_sqrt(a.v_)};
    }
    friend vector_portable abs(vector_portable a) noexcept {
        return vector_portable{std::fabs(a.v_)};
    }
    /// The second operand where one of them is NaN.
    friend vector_portable min(vector_portable a, vector_portable b) noexcept {
        return vector_portable{a.v_ < b.v_ ? a.v_ : b.v_};
    }
    friend vector_portable max(vector_portable a, vector_portable b) noexcept {
        return vector_portable{a.v_ > b.v_ ? a.v_ : b.v_};
    }
    /// The other operand where one of them is NaN.
    friend vector_portable min_number(vector_portable a, vector_portable b) noexcept {
        return b.v_ != b.v_ ? a : min(a, b);
    }
    friend vector_portable max_number(vector_portable a, vector_portable b) noexcept {
        return b.v_ != b.v_ ? a : max(a, b);
    }

    friend mask operator<(vector_portable a, vector_portable b) noexcept {
        return mask{a.v_ < b.v_};
    }
    friend mask operator<=(vector_portable a, vector_portable b) noexcept {
        return mask{a.v_ <= b.v_};
    }
    friend mask operator>(vector_portable a, vector_portable b) noexcept { return b < a; }
    friend mask operator>=(vector_portable a, vector_portable b) noexcept { return b <= a; }
    friend mask operator==(vector_portable a, vector_portable b) noexcept {
        return mask{a.v_ == b.v_};
    }
    friend mask unordered(vector_portable a, vector_portable b) noexcept {
        return mask{a.v_ != a.v_ || b.v_ != b.v_};
    }
    friend vector_portable select(mask m, vector_portable yes, vector_portable no) noexcept {
        return m.bits() != 0 ? yes : no;
    }

    /// The next double above s where m is set (s not NaN and not +inf there).
    friend vector_portable step_up(vector_portable s, mask m) noexcept {
        if (m.bits() == 0) return s;
        if (s.v_ == 0.0) return vector_portable{std::bit_cast<double>(std::uint64_t{1})};
        auto const bits = std::bit_cast<std::uint64_t>(s.v_);
        return vector_portable{std::bit_cast<double>(s.v_ < 0.0 ? bits - 1 : bits + 1)};
    }

    /// Each a rounded to 26 bits, ties away: the rest has 26 bits as well (|a| < 2^1000).
    friend vector_portable leading_half(vector_portable a) noexcept {
        auto const rounded = std::bit_cast<std::uint64_t>(a.v_) + (std::uint64_t{1} << 26);
        return vector_portable{std::bit_cast<double>(rounded & ~((std::uint64_t{1} << 27) - 1))};
    }

    friend vector_portable negate_where(mask m, vector_portable a) noexcept {
        return m.bits() != 0 ? -a : a;
    }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector_portable a) noexcept {
        return mask{(std::bit_cast<std::uint64_t>(a.v_) >> I & 1u) != 0};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite normal x > 0.
    friend vector_portable exponent(vector_portable x) noexcept {
        auto const field = std::bit_cast<std::uint64_t>(x.v_) >> 52;
        return vector_portable{static_cast<double>(static_cast<std::int64_t>(field) - 1023)};
    }
    friend vector_portable mantissa(vector_portable x) noexcept {
        auto const field = std::bit_cast<std::uint64_t>(x.v_) & 0x000FFFFFFFFFFFFF;
        return vector_portable{std::bit_cast<double>(field | std::bit_cast<std::uint64_t>(1.0))};
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector_portable power_of_two(vector_portable k) noexcept {
        auto const sum = std::bit_cast<std::uint64_t>(k.v_ + 0x1.8p52); // k in the low bits
        return vector_portable{std::bit_cast<double>((sum + 1023) << 52)};
    }

private:
    double v_ = 0.0;
};

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
