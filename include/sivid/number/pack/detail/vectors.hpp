// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_VECTORS_HPP
#define SIVID_NUMBER_PACK_DETAIL_VECTORS_HPP

/// @file
/// Doubles side by side by the vector extension of g++ and clang, or one double in standard C++ on
/// the portable machine (detail/machine.hpp) and for other compilers: bare ones, for whatever has
/// error bounds of its own (Taylor models), and `simd::vector`, which packs and elementary
/// functions are made of. No other header but that of AVX-512 knows of the extension.

#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/rounding/detail/machine.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__GNUC__) && (SIVID_MACHINE_X86_64 || SIVID_MACHINE_ARM64)
#define SIVID_VECTOR_EXTENSION 1
#else
#define SIVID_VECTOR_EXTENSION 0
#endif

/// Behind the parameters of a lambda: inlined always.
#if defined(__GNUC__)
#define SIVID_INLINED_LAMBDA __attribute__((always_inline))
#else
#define SIVID_INLINED_LAMBDA
#endif

#if SIVID_VECTOR_EXTENSION && SIVID_PACK_AVX2
#include <immintrin.h>
#elif SIVID_VECTOR_EXTENSION && SIVID_MACHINE_X86_64
#if SIVID_FUSED
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif
#elif SIVID_VECTOR_EXTENSION
#include <arm_neon.h>
#endif

namespace sivid {
inline namespace SIVID_PACK_TARGET {
namespace lanes_detail {

/// A mask of one lane: all bits or none.
struct one_mask {
    std::int64_t bits;
    one_mask() = default;
    constexpr one_mask(std::int64_t b) noexcept : bits{b} {} // NOLINT: in every lane
    constexpr explicit operator bool() const noexcept { return bits != 0; }
    constexpr std::int64_t& operator[](std::size_t) noexcept { return bits; }
    constexpr std::int64_t const& operator[](std::size_t) const noexcept { return bits; }
    friend constexpr one_mask operator&(one_mask a, one_mask b) noexcept { return a.bits & b.bits; }
    friend constexpr one_mask operator|(one_mask a, one_mask b) noexcept { return a.bits | b.bits; }
    friend constexpr one_mask operator+(one_mask a, one_mask b) noexcept { return a.bits + b.bits; }
    friend constexpr one_mask operator~(one_mask a) noexcept { return ~a.bits; }
    friend constexpr one_mask operator!=(one_mask a, one_mask b) noexcept {
        return a.bits != b.bits ? -1 : 0;
    }
};
struct one_double {
    double value;
    one_double() = default;
    constexpr one_double(double x) noexcept : value{x} {} // NOLINT: in every lane
    constexpr double& operator[](std::size_t) noexcept { return value; }
    constexpr double const& operator[](std::size_t) const noexcept { return value; }
    friend constexpr one_double operator+(one_double a, one_double b) noexcept {
        return a.value + b.value;
    }
    friend constexpr one_double operator-(one_double a, one_double b) noexcept {
        return a.value - b.value;
    }
    friend constexpr one_double operator*(one_double a, one_double b) noexcept {
        return a.value * b.value;
    }
    friend constexpr one_double operator/(one_double a, one_double b) noexcept {
        return a.value / b.value;
    }
    friend constexpr one_double operator-(one_double a) noexcept { return -a.value; }
    constexpr one_double& operator+=(one_double b) noexcept { return *this = *this + b; }
    constexpr one_double& operator-=(one_double b) noexcept { return *this = *this - b; }
    constexpr one_double& operator*=(one_double b) noexcept { return *this = *this * b; }
    friend constexpr one_mask operator<(one_double a, one_double b) noexcept {
        return a.value < b.value ? -1 : 0;
    }
    friend constexpr one_mask operator<=(one_double a, one_double b) noexcept {
        return a.value <= b.value ? -1 : 0;
    }
    friend constexpr one_mask operator>(one_double a, one_double b) noexcept { return b < a; }
    friend constexpr one_mask operator==(one_double a, one_double b) noexcept {
        return a.value == b.value ? -1 : 0;
    }
    friend constexpr one_mask operator!=(one_double a, one_double b) noexcept {
        return a.value != b.value ? -1 : 0;
    }
};

/// N doubles, and as many words.
template <std::size_t N>
struct raw;
template <>
struct raw<1> {
    using numbers = one_double;
    using integers = one_mask;
    using words = std::uint64_t;
};

#if SIVID_VECTOR_EXTENSION

template <std::size_t N>
struct raw {
    typedef double numbers __attribute__((vector_size(8 * N)));
    typedef std::int64_t integers __attribute__((vector_size(8 * N)));
    typedef std::uint64_t words __attribute__((vector_size(8 * N)));
};

inline constexpr std::size_t vector_bytes = SIVID_PACK_AVX512 ? 64 : SIVID_PACK_AVX2 ? 32 : 16;
/// In memory that holds doubles, aligned to a vector or to a double.
typedef double stored_vector __attribute__((vector_size(vector_bytes), may_alias));
typedef double loose_vector __attribute__((vector_size(vector_bytes), aligned(8), may_alias));
typedef std::int64_t loose_mask __attribute__((vector_size(vector_bytes), aligned(8), may_alias));

#else

inline constexpr std::size_t vector_bytes = sizeof(double);
using stored_vector = one_double;
using loose_vector = one_double;
using loose_mask = one_mask;

#endif

/// The widest vectors here.
inline constexpr std::size_t per_vector = vector_bytes / sizeof(double);
using vector = raw<per_vector>::numbers;
using vector_mask = raw<per_vector>::integers;

[[gnu::always_inline]] inline vector_mask bits_of(vector const& x) {
    return std::bit_cast<vector_mask>(x);
}
[[gnu::always_inline]] inline vector vector_of(vector_mask const& x) {
    return std::bit_cast<vector>(x);
}

/// Bit l in lane l.
inline vector_mask lane_bits() {
    vector_mask m{};
    for (std::size_t l = 0; l < per_vector; ++l) m[l] = std::int64_t{1} << l;
    return m;
}
/// Bit l is the sign of lane l.
inline std::uint64_t sign_bits(vector_mask m) {
#if SIVID_VECTOR_EXTENSION && SIVID_PACK_AVX512
    return _mm512_movepi64_mask(std::bit_cast<__m512i>(m));
#elif SIVID_VECTOR_EXTENSION && SIVID_PACK_AVX2
    return static_cast<std::uint64_t>(_mm256_movemask_pd(std::bit_cast<__m256d>(m)));
#elif SIVID_VECTOR_EXTENSION && SIVID_MACHINE_X86_64
    return static_cast<std::uint64_t>(_mm_movemask_pd(std::bit_cast<__m128d>(m)));
#else
    std::uint64_t bits = 0;
    for (std::size_t l = 0; l < per_vector; ++l)
        bits |= static_cast<std::uint64_t>(m[l]) >> 63 << l;
    return bits;
#endif
}

/// The lanes in reverse order.
[[gnu::always_inline]] inline vector backward(vector const& x) {
#if SIVID_VECTOR_EXTENSION
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return __builtin_shufflevector(x, x, (per_vector - 1 - I)...);
    }
    (std::make_index_sequence<per_vector>{});
#else
    return x;
#endif
}

/// The sums of as many rows of eight numbers as a vector has lanes; x holds row behind row. Numbers
/// l and l + 2 of each four are added first, then the same of what that leaves, at last neighbours:
/// in this order whatever a vector has, so that every machine has the same bits.
template <class Vector>
[[gnu::always_inline]] inline Vector sums_of_eights(Vector const* x) {
    constexpr std::size_t count = sizeof(Vector) / sizeof(double);
    if constexpr (count == 1) {
        return ((x[0] + x[2]) + (x[4] + x[6])) + ((x[1] + x[3]) + (x[5] + x[7]));
#if SIVID_VECTOR_EXTENSION
    } else if constexpr (count == 2) {
        Vector const y = (x[0] + x[1]) + (x[2] + x[3]), z = (x[4] + x[5]) + (x[6] + x[7]);
        return __builtin_shufflevector(y, z, 0, 2) + __builtin_shufflevector(y, z, 1, 3);
    } else if constexpr (count == 4) {
        auto const fold = [](Vector const& y, Vector const& z) SIVID_INLINED_LAMBDA {
            return __builtin_shufflevector(y, z, 0, 1, 4, 5) +
                   __builtin_shufflevector(y, z, 2, 3, 6, 7);
        };
        Vector const y = fold(fold(x[0], x[1]), fold(x[2], x[3])),
                     z = fold(fold(x[4], x[5]), fold(x[6], x[7]));
        return __builtin_shufflevector(y, z, 0, 2, 4, 6) +
               __builtin_shufflevector(y, z, 1, 3, 5, 7);
    } else {
        auto const fold = [](Vector const& y, Vector const& z) SIVID_INLINED_LAMBDA {
            return __builtin_shufflevector(y, z, 0, 1, 4, 5, 8, 9, 12, 13) +
                   __builtin_shufflevector(y, z, 2, 3, 6, 7, 10, 11, 14, 15);
        };
        Vector const y = fold(fold(x[0], x[1]), fold(x[2], x[3])),
                     z = fold(fold(x[4], x[5]), fold(x[6], x[7]));
        return __builtin_shufflevector(y, z, 0, 2, 4, 6, 8, 10, 12, 14) +
               __builtin_shufflevector(y, z, 1, 3, 5, 7, 9, 11, 13, 15);
#endif
    }
}

/// x in every lane.
template <std::size_t N>
[[gnu::always_inline]] inline typename raw<N>::numbers spread(double x) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) SIVID_INLINED_LAMBDA {
        return typename raw<N>::numbers{(static_cast<void>(I), x)...};
    }
    (std::make_index_sequence<N>{});
}

/// Square roots; a b + c, rounded once; and what the optimiser knows nothing about.
[[gnu::always_inline]] inline one_double root(one_double a) { return detail::plain_sqrt(a.value); }
#if SIVID_FUSED
[[gnu::always_inline]] inline one_double fused(one_double a, one_double b, one_double c) {
    return detail::fused(a.value, b.value, c.value);
}
#endif
[[gnu::always_inline]] inline one_double hidden(one_double a) { return detail::opaque(a.value); }
/// As `hidden`, and it stays where it stands between changes of the rounding mode.
[[gnu::always_inline]] inline one_double pinned(one_double a) { return detail::pinned(a.value); }

#if SIVID_VECTOR_EXTENSION

[[gnu::always_inline]] inline raw<2>::numbers root(raw<2>::numbers a) {
#if SIVID_MACHINE_X86_64
    return _mm_sqrt_pd(a);
#else
    return vsqrtq_f64(a);
#endif
}
#if SIVID_FUSED
[[gnu::always_inline]] inline raw<2>::numbers fused(raw<2>::numbers a, raw<2>::numbers b,
                                                    raw<2>::numbers c) {
#if SIVID_MACHINE_X86_64
    return _mm_fmadd_pd(a, b, c);
#else
    return vfmaq_f64(c, a, b);
#endif
}
#endif
#if SIVID_PACK_AVX2
[[gnu::always_inline]] inline raw<4>::numbers root(raw<4>::numbers a) { return _mm256_sqrt_pd(a); }
#if SIVID_FUSED
[[gnu::always_inline]] inline raw<4>::numbers fused(raw<4>::numbers a, raw<4>::numbers b,
                                                    raw<4>::numbers c) {
    return _mm256_fmadd_pd(a, b, c);
}
#endif
#endif
#if SIVID_PACK_AVX512 // with zeroing: the plain form of g++ 12 warns about an uninitialised operand
[[gnu::always_inline]] inline raw<8>::numbers root(raw<8>::numbers a) {
    return _mm512_maskz_sqrt_pd(static_cast<__mmask8>(-1), a);
}
#endif
template <class Numbers>
[[gnu::always_inline]] inline Numbers hidden(Numbers a) {
    __asm__("" : SIVID_REGISTER(a));
    return a;
}
template <class Numbers>
[[gnu::always_inline]] inline Numbers pinned(Numbers a) {
    __asm__ volatile("" : SIVID_REGISTER(a));
    return a;
}

#endif

} // namespace lanes_detail
} // namespace SIVID_PACK_TARGET

namespace simd {
inline namespace SIVID_PACK_TARGET {

/// One truth value for each lane: all bits of a word, or none.
template <std::size_t N>
class vector_mask {
    using words = typename lanes_detail::raw<N>::words;

public:
    vector_mask() = default;
    explicit vector_mask(words m) noexcept : m_{m} {}
    [[nodiscard]] words raw() const noexcept { return m_; }
    /// Bit l of lane l.
    [[nodiscard]] unsigned bits() const noexcept {
        if constexpr (N == 1) {
            return static_cast<unsigned>(m_ & 1u);
#if SIVID_VECTOR_EXTENSION && SIVID_PACK_AVX2
        } else if constexpr (N == 4) {
            return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(m_)));
#endif
#if SIVID_VECTOR_EXTENSION && SIVID_MACHINE_X86_64
        } else if constexpr (N == 2) {
            return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(m_)));
#endif
        } else {
            unsigned bits = 0;
            for (std::size_t l = 0; l < N; ++l) bits |= static_cast<unsigned>(m_[l] & 1u) << l;
            return bits;
        }
    }
    friend vector_mask operator&(vector_mask a, vector_mask b) noexcept {
        return vector_mask{a.m_ & b.m_};
    }
    friend vector_mask operator|(vector_mask a, vector_mask b) noexcept {
        return vector_mask{a.m_ | b.m_};
    }
    friend vector_mask operator!(vector_mask a) noexcept { return vector_mask{~a.m_}; }

private:
    words m_{};
};

/// N doubles. Operations round as the control register says; the directed operations
/// (pack_arithmetic.hpp) prove their bounds in every mode of it. AVX-512 has its own there.
template <std::size_t N>
class vector {
    static_assert(N == 1 || N <= lanes_detail::per_vector);
    using numbers = typename lanes_detail::raw<N>::numbers;
    using words = typename lanes_detail::raw<N>::words;

public:
    using mask = vector_mask<N>;
    static constexpr std::size_t lanes = N;
    static constexpr bool fused = SIVID_FUSED != 0; // else fma() rounds twice
    static constexpr bool keeps_own_mode = false;   // results depend on the thread's mode
    static constexpr bool reads_subnormals = false; // exponent() and mantissa() do not

    vector() = default;
    explicit vector(numbers v) noexcept requires(N > 1) : v_{v} {}
    explicit vector(double x) noexcept : v_{lanes_detail::spread<N>(x)} {}
    /// a and b side by side.
    [[nodiscard]] static vector of_ends(double a, double b) noexcept requires(N == 2) {
        return vector{numbers{a, b}};
    }
    [[nodiscard]] double operator[](std::size_t lane) const noexcept { return v_[lane]; }
    static vector load(double const* p) noexcept {
        vector r;
        std::memcpy(&r.v_, p, sizeof r.v_);
        return r;
    }
    void store(double* p) const noexcept { std::memcpy(p, &v_, sizeof v_); }

    friend vector operator+(vector a, vector b) noexcept { return made(a.v_ + b.v_); }
    friend vector operator-(vector a, vector b) noexcept { return made(a.v_ - b.v_); }
    /// Opaque, so that a compiler cannot fuse the product with a later sum.
    friend vector operator*(vector a, vector b) noexcept {
        return made(lanes_detail::hidden(a.v_ * b.v_));
    }
    friend vector operator/(vector a, vector b) noexcept { return made(a.v_ / b.v_); }
    friend vector operator-(vector a) noexcept { return of(bits(a) ^ sign); }
    friend vector fma(vector a, vector b, vector c) noexcept {
#if SIVID_FUSED
        return made(lanes_detail::fused(a.v_, b.v_, c.v_));
#else
        return a * b + c;
#endif
    }
    friend vector sqrt(vector a) noexcept { return made(lanes_detail::root(a.v_)); }
    friend vector abs(vector a) noexcept { return of(bits(a) & ~sign); }
    /// The second operand where one of them is NaN.
    friend vector min(vector a, vector b) noexcept { return made(a.v_ < b.v_ ? a.v_ : b.v_); }
    friend vector max(vector a, vector b) noexcept { return made(a.v_ > b.v_ ? a.v_ : b.v_); }
    /// The other operand where one of them is NaN.
    friend vector min_number(vector a, vector b) noexcept {
        return select(unordered(b, b), a, min(a, b));
    }
    friend vector max_number(vector a, vector b) noexcept {
        return select(unordered(b, b), a, max(a, b));
    }

    friend mask operator<(vector a, vector b) noexcept { return mask_of(a.v_ < b.v_); }
    friend mask operator<=(vector a, vector b) noexcept { return mask_of(a.v_ <= b.v_); }
    friend mask operator>(vector a, vector b) noexcept { return b < a; }
    friend mask operator>=(vector a, vector b) noexcept { return b <= a; }
    friend mask operator==(vector a, vector b) noexcept { return mask_of(a.v_ == b.v_); }
    friend mask unordered(vector a, vector b) noexcept {
        return mask_of(a.v_ != a.v_) | mask_of(b.v_ != b.v_);
    }
    friend vector select(mask m, vector yes, vector no) noexcept {
#if SIVID_VECTOR_EXTENSION && SIVID_PACK_AVX2
        if constexpr (N == 4)
            return made(_mm256_blendv_pd(no.v_, yes.v_, std::bit_cast<__m256d>(m.raw())));
        else
#endif
            return of((m.raw() & bits(yes)) | (~m.raw() & bits(no)));
    }

    /// The next double above s where m is set (s not NaN and not +inf there).
    friend vector step_up(vector s, mask m) noexcept {
        vector const zero(0.0);
        words const positive_zero = ~(s == zero).raw() & bits(s);
        words const away = (s < zero).raw() | 1u; // -1 below zero, else +1
        return of(positive_zero + (away & m.raw()));
    }
    /// Each a rounded to 26 bits, ties away: the rest has 26 bits as well (|a| < 2^1000).
    friend vector leading_half(vector a) noexcept {
        constexpr std::uint64_t last = std::uint64_t{1} << 27;
        return of((bits(a) + last / 2) & ~(last - 1));
    }
    [[gnu::always_inline]] friend vector kept(vector a) noexcept {
        return made(lanes_detail::pinned(a.v_));
    }
    [[nodiscard]] static mask even_lanes() noexcept {
        words w{};
        if constexpr (N == 1)
            w = ~w;
        else
            for (std::size_t l = 0; l < N; l += 2) w[l] = ~std::uint64_t{0};
        return mask{w};
    }
    friend vector negate_where(mask m, vector a) noexcept { return of(bits(a) ^ (m.raw() & sign)); }
    /// Where bit I of the integer n is set, for a = n + 1.5 2^52.
    template <int I>
    friend mask bit_is_set(vector a) noexcept {
        return mask{words{} - (bits(a) >> I & 1u)};
    }

    /// floor(log2 x) and x / 2^floor(log2 x) in [1, 2), for finite normal x > 0.
    friend vector exponent(vector x) noexcept {
        constexpr auto big = std::bit_cast<std::uint64_t>(0x1p52);
        return of((bits(x) >> 52) | big) - vector(0x1p52 + 1023);
    }
    friend vector mantissa(vector x) noexcept {
        constexpr auto one = std::bit_cast<std::uint64_t>(1.0);
        return of((bits(x) & 0x000f'ffff'ffff'ffff) | one);
    }
    /// 2^k for integers k in [-1022, 1023].
    friend vector power_of_two(vector k) noexcept { // k in the low bits of the sum
        return of((bits(k + vector(0x1.8p52)) + 1023) << 52);
    }

private:
    static constexpr std::uint64_t sign = std::uint64_t{1} << 63;

    static vector made(numbers v) noexcept {
        vector r;
        r.v_ = v;
        return r;
    }
    static vector of(words w) noexcept { return made(std::bit_cast<numbers>(w)); }
    static words bits(vector a) noexcept { return std::bit_cast<words>(a.v_); }
    template <class Comparison>
    static mask mask_of(Comparison const& c) noexcept {
        return mask{std::bit_cast<words>(c)};
    }

    numbers v_{};
}; // namespace simd

} // namespace SIVID_PACK_TARGET
} // namespace simd

namespace number_detail {

/// Copies whole cache lines from one aligned block to another.
[[gnu::always_inline]] inline void copy_lines(void* to, void const* from, std::size_t lines) {
#if defined(__GNUC__)
    typedef double some __attribute__((vector_size(32), may_alias));
    auto* const y = static_cast<some*>(to);
    auto const* const x = static_cast<some const*>(from);
    for (std::size_t i = 0; i < 2 * lines; i += 2) {
        some const a = x[i], b = x[i + 1];
        y[i] = a;
        y[i + 1] = b;
    }
#else
    std::memcpy(to, from, 64 * lines);
#endif
}

/// Fills whole cache lines with zeros.
[[gnu::always_inline]] inline void clear_lines(void* to, std::size_t lines) {
#if defined(__GNUC__)
    typedef double some __attribute__((vector_size(32), may_alias));
    auto* const y = static_cast<some*>(to);
    for (std::size_t i = 0; i < 2 * lines; i += 2) y[i] = y[i + 1] = some{};
#else
    std::memset(to, 0, 64 * lines);
#endif
}

} // namespace number_detail
} // namespace sivid

#endif
