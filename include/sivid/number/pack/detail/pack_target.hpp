// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_TARGET_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_TARGET_HPP

/// @file
/// Which vector instructions the packs of this translation unit use.
///
/// Everything of a pack lives in an inline namespace named after the target, so that files compiled
/// for different machines can be linked together: the linker never merges their functions, and
/// handing a pack from one to the other is a link error instead of a wrong layout.

#include <sivid/number/rounding/detail/machine.hpp>

#if SIVID_MACHINE_ARM64
#define SIVID_PACK_AVX512 0
#define SIVID_PACK_AVX2 0
#define SIVID_PACK_TARGET pack_neon
#elif !SIVID_MACHINE_X86_64
#define SIVID_PACK_AVX512 0
#define SIVID_PACK_AVX2 0
#if SIVID_FUSED
#define SIVID_PACK_TARGET pack_portable_fma
#else
#define SIVID_PACK_TARGET pack_portable
#endif
#elif defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX2__) && defined(__FMA__)
#define SIVID_PACK_AVX512 1
#define SIVID_PACK_AVX2 1
#define SIVID_PACK_TARGET pack_avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define SIVID_PACK_AVX512 0
#define SIVID_PACK_AVX2 1
#define SIVID_PACK_TARGET pack_avx2
#elif defined(__FMA__)
#define SIVID_PACK_AVX512 0
#define SIVID_PACK_AVX2 0
#define SIVID_PACK_TARGET pack_sse2_fma
#else
#define SIVID_PACK_AVX512 0
#define SIVID_PACK_AVX2 0
#define SIVID_PACK_TARGET pack_sse2
#endif

#include <string_view>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// The instructions that packs were compiled for.
[[nodiscard]] constexpr std::string_view pack_target() noexcept {
    return SIVID_PACK_AVX512      ? "avx512"
           : SIVID_PACK_AVX2      ? "avx2"
           : SIVID_MACHINE_X86_64 ? "sse2"
           : SIVID_MACHINE_ARM64  ? "neon"
                                  : "portable";
}

/// Whether this machine and its operating system have the instructions that packs were compiled
/// for. Guards ask it before the first pack is touched; without them the program dies of SIGILL.
[[nodiscard]] inline bool pack_supported() noexcept {
#if SIVID_PACK_AVX512
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#elif SIVID_PACK_AVX2
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#elif defined(__x86_64__) && defined(__FMA__)
    return __builtin_cpu_supports("fma");
#else
    return true; // SSE2 is part of x86-64, vectors and fused operations are of ARM64
#endif
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
