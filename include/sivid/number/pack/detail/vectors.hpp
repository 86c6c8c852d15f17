// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_VECTORS_HPP
#define SIVID_NUMBER_PACK_DETAIL_VECTORS_HPP

/// @file
/// Plain doubles side by side, for whatever has error bounds of its own (Taylor models): by the
/// vector extension of g++ and clang, or one double in standard C++ on the portable machine
/// (detail/machine.hpp) and for other compilers. No other header knows of the extension.

#include <sivid/number/pack/detail/pack_target.hpp>

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
#include <emmintrin.h>
#endif

namespace sivid {
inline namespace SIVID_PACK_TARGET {
namespace lanes_detail {

#if SIVID_VECTOR_EXTENSION

inline constexpr std::size_t vector_bytes = SIVID_PACK_AVX512 ? 64 : SIVID_PACK_AVX2 ? 32 : 16;
typedef double vector __attribute__((vector_size(vector_bytes)));
typedef std::int64_t vector_mask __attribute__((vector_size(vector_bytes)));
/// In memory that holds doubles, aligned to a vector or to a double.
typedef double stored_vector __attribute__((vector_size(vector_bytes), may_alias));
typedef double loose_vector __attribute__((vector_size(vector_bytes), aligned(8), may_alias));
typedef std::int64_t loose_mask __attribute__((vector_size(vector_bytes), aligned(8), may_alias));

#else

inline constexpr std::size_t vector_bytes = sizeof(double);

/// All bits or none.
struct vector_mask {
    std::int64_t bits;
    vector_mask() = default;
    constexpr vector_mask(std::int64_t b) noexcept : bits{b} {} // NOLINT: in every lane
    constexpr explicit operator bool() const noexcept { return bits != 0; }
    constexpr std::int64_t& operator[](std::size_t) noexcept { return bits; }
    constexpr std::int64_t const& operator[](std::size_t) const noexcept { return bits; }
    friend constexpr vector_mask operator&(vector_mask a, vector_mask b) noexcept {
        return a.bits & b.bits;
    }
    friend constexpr vector_mask operator|(vector_mask a, vector_mask b) noexcept {
        return a.bits | b.bits;
    }
    friend constexpr vector_mask operator+(vector_mask a, vector_mask b) noexcept {
        return a.bits + b.bits;
    }
    friend constexpr vector_mask operator~(vector_mask a) noexcept { return ~a.bits; }
    friend constexpr vector_mask operator!=(vector_mask a, vector_mask b) noexcept {
        return a.bits != b.bits ? -1 : 0;
    }
};
struct vector {
    double value;
    vector() = default;
    constexpr vector(double x) noexcept : value{x} {} // NOLINT: in every lane
    constexpr double& operator[](std::size_t) noexcept { return value; }
    constexpr double const& operator[](std::size_t) const noexcept { return value; }
    friend constexpr vector operator+(vector a, vector b) noexcept { return a.value + b.value; }
    friend constexpr vector operator-(vector a, vector b) noexcept { return a.value - b.value; }
    friend constexpr vector operator*(vector a, vector b) noexcept { return a.value * b.value; }
    friend constexpr vector operator/(vector a, vector b) noexcept { return a.value / b.value; }
    friend constexpr vector operator-(vector a) noexcept { return -a.value; }
    constexpr vector& operator+=(vector b) noexcept { return *this = *this + b; }
    constexpr vector& operator-=(vector b) noexcept { return *this = *this - b; }
    constexpr vector& operator*=(vector b) noexcept { return *this = *this * b; }
    friend constexpr vector_mask operator<(vector a, vector b) noexcept {
        return a.value < b.value ? -1 : 0;
    }
    friend constexpr vector_mask operator<=(vector a, vector b) noexcept {
        return a.value <= b.value ? -1 : 0;
    }
    friend constexpr vector_mask operator>(vector a, vector b) noexcept { return b < a; }
    friend constexpr vector_mask operator==(vector a, vector b) noexcept {
        return a.value == b.value ? -1 : 0;
    }
};
using stored_vector = vector;
using loose_vector = vector;
using loose_mask = vector_mask;

#endif

inline constexpr std::size_t per_vector = vector_bytes / sizeof(double);

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

/// The sum of each of as many vectors as one has lanes.
template <class Vector>
[[gnu::always_inline]] inline Vector across(Vector const* x) {
#if SIVID_VECTOR_EXTENSION
    constexpr std::size_t count = sizeof(Vector) / sizeof(double);
    if constexpr (count == 2) {
        return __builtin_shufflevector(x[0], x[1], 0, 2) +
               __builtin_shufflevector(x[0], x[1], 1, 3);
    } else if constexpr (count == 4) {
        Vector two[2];
        for (std::size_t i = 0; i < 2; ++i) {
            two[i] = __builtin_shufflevector(x[2 * i], x[2 * i + 1], 0, 4, 2, 6) +
                     __builtin_shufflevector(x[2 * i], x[2 * i + 1], 1, 5, 3, 7);
        }
        return __builtin_shufflevector(two[0], two[1], 0, 1, 4, 5) +
               __builtin_shufflevector(two[0], two[1], 2, 3, 6, 7);
    } else {
        Vector two[4], four[2];
        for (std::size_t i = 0; i < 4; ++i) {
            Vector const y = x[2 * i], z = x[2 * i + 1];
            two[i] = __builtin_shufflevector(y, z, 0, 8, 2, 10, 4, 12, 6, 14) +
                     __builtin_shufflevector(y, z, 1, 9, 3, 11, 5, 13, 7, 15);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            Vector const y = two[2 * i], z = two[2 * i + 1];
            four[i] = __builtin_shufflevector(y, z, 0, 1, 8, 9, 4, 5, 12, 13) +
                      __builtin_shufflevector(y, z, 2, 3, 10, 11, 6, 7, 14, 15);
        }
        return __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 8, 9, 10, 11) +
               __builtin_shufflevector(four[0], four[1], 4, 5, 6, 7, 12, 13, 14, 15);
    }
#else
    return x[0];
#endif
}

} // namespace lanes_detail
} // namespace SIVID_PACK_TARGET

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
