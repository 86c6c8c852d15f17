// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_KERNEL_TRIAL_HPP
#define SIVID_NUMBER_PACK_DETAIL_KERNEL_TRIAL_HPP

/// @file
/// Runs the kernels of interval arithmetic that were compiled here on numbers whose results are
/// known, so that a compiler that broke one of them is found before anything is proved with it.
/// (g++ 12 with -flto lost sin and cos of packs in this way, in silence.)

#include <sivid/compiled.hpp>
#include <sivid/number/pack/detail/pack_target.hpp>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// A kernel that missed a known value: of which type, and which function; null where all hold.
struct broken_kernel {
    char const* type = nullptr;
    char const* function = nullptr;
};

/// The first kernel of `interval`, and of packs by each vector that they are made of, that misses a
/// known value.
/// @given  what `require_sound_environment` demands of the machine
/// @cost   less than a millisecond once in a process, then a load
[[nodiscard]] SIVID_DECL broken_kernel first_broken_kernel() noexcept;

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/number/pack/impl/kernel_trial.ipp>
#endif

#endif
