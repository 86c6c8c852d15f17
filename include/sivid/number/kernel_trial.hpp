// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_KERNEL_TRIAL_HPP
#define SIVID_NUMBER_KERNEL_TRIAL_HPP

/// @file
/// Runs the kernels of interval arithmetic that were compiled here on numbers whose results are
/// known, so that a compiler that broke one of them is found before anything is proved with it.
/// (g++ 12 with -flto lost sin and cos of packs in this way, in silence.)

#include <sivid/compiled.hpp>
#include <sivid/number/detail/pack_target.hpp>

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_KERNEL_TRIAL)
#include <sivid/number/detail/known_values.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack_traits.hpp>

#include <cstddef>
#endif

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// A kernel that missed a known value: of which type, and which function; null where all hold.
struct broken_kernel {
    char const* type = nullptr;
    char const* function = nullptr;
};

/// The first kernel of `interval`, and of packs by each vector that they are made of, that misses a
/// known value.
/// @given  what `require_sound_environment` demands of MXCSR
/// @cost   less than a millisecond once in a process, then a load
[[nodiscard]] SIVID_ENTRY broken_kernel first_broken_kernel() noexcept;

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_KERNEL_TRIAL)

namespace trial {

/// Packs of several vectors have the kernels of those of one.
template <std::size_t W>
[[nodiscard]] char const* first_broken_function_of_pack() noexcept {
    if constexpr (pack<W>::parts == 1)
        return first_broken_function<pack_traits<W>>();
    else
        return nullptr;
}

[[nodiscard]] SIVID_ENTRY broken_kernel search() noexcept {
    if (auto f = first_broken_function<interval_traits<interval>>()) return {"interval", f};
    if (auto f = first_broken_function_of_pack<1>()) return {"pack<1>", f};
    if (auto f = first_broken_function_of_pack<2>()) return {"pack<2>", f};
    if (auto f = first_broken_function_of_pack<4>()) return {"pack<4>", f};
    if (auto f = first_broken_function_of_pack<8>()) return {"pack<8>", f};
    return {};
}

} // namespace trial

SIVID_ENTRY broken_kernel first_broken_kernel() noexcept {
    static broken_kernel const found = trial::search();
    return found;
}

#endif

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
