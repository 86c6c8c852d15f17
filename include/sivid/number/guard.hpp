// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_GUARD_HPP
#define SIVID_NUMBER_GUARD_HPP

/// @file
/// Refuses builds (detail/refused_flags.hpp) and machines on which interval arithmetic would not
/// prove anything.

#include <sivid/number/pack/detail/kernel_trial.hpp>
#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/number/rounding/detail/refused_flags.hpp>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

namespace sivid {

namespace detail {

/// False if the compiler rearranged plain arithmetic. clang defines no macro for
/// -fassociative-math, -freciprocal-math and -fno-signed-zeros, so only running code shows them.
/// Inlined always: it has to be compiled with the flags of the file that asks.
[[gnu::always_inline]] inline bool plain_arithmetic_is_kept() noexcept {
    double const big = opaque(0x1p53), one = opaque(1.0);
    double const residual = (big + one) - big; // 0; 1 when reassociated
    double const x = opaque(5.0), y = opaque(-0.0);
    double const quotient = x / 49.0; // 5 * (1/49) rounds differently
    double const zero = y + 0.0;      // +0; -0 when signed zeros are ignored
    return opaque(residual) == 0.0 && opaque(quotient) == opaque(x) / opaque(49.0) &&
           std::bit_cast<std::uint64_t>(opaque(zero)) == 0;
}

/// @throws  unsound_environment with what is broken, if anything is
inline void require_unbroken(broken_kernel const& k) {
    if (k.function != nullptr)
        throw unsound_environment{std::string{k.function} + " of " + k.type +
                                  " misses a known value: the compiler has broken its machine code "
                                  "(g++ 12 with -flto is known for it: compile with "
                                  "-fno-ipa-modref or without -flto)"};
}

} // namespace detail

/// Checks that proofs are possible here and now; every solver calls it on entry.
/// @guarantee  on return: the machine has the instructions that this file was compiled for (as far
///             as packs use them), round-to-nearest is set, subnormals are neither flushed nor read
///             as zero, directed rounding works in each way that sivid uses, plain arithmetic is
///             not rearranged, and the kernels of `interval` and packs enclose known values
/// @throws     unsound_environment with the reason otherwise (for instance under valgrind, which
///             ignores the rounding mode, or in a program linked with -ffast-math)
/// @cost       about 50 ns; less than a millisecond the first time in a process
[[gnu::always_inline]] inline void require_sound_environment() {
    if (!pack_supported())
        throw unsound_environment{
            "this program was compiled for vector instructions that the machine does not have"};
    detail::control_word const control = detail::read_control();
    if (!detail::rounds_to_nearest(control))
        throw unsound_environment{
            "the floating-point rounding mode is not round-to-nearest; restore it with "
            "std::fesetround(FE_TONEAREST) before calling sivid"};
    if ((control & detail::control_flush) != 0 || !detail::subnormals_are_kept())
        throw unsound_environment{
            "subnormal numbers are flushed to zero (FTZ or DAZ is set); a library or an object "
            "linked with -ffast-math does that; link without it or clear the flags"};
    double const one = detail::opaque(1.0), three = detail::opaque(3.0);
    double const tiny = detail::opaque(std::numeric_limits<double>::denorm_min());
    if (!(detail::div_down(one, three) < detail::div_up(one, three)) ||
        !(detail::directed_div<detail::direction::down>(one, three) <
          detail::directed_div<detail::direction::up>(one, three)) ||
        !(detail::mul_up(tiny, tiny) > 0.0) || !(detail::add_up(one, tiny) > one))
        throw unsound_environment{
            "directed rounding has no effect; valgrind and software floating point behave so"};
    if (!detail::plain_arithmetic_is_kept())
        throw unsound_environment{
            "the compiler rearranges floating-point arithmetic (-funsafe-math-optimizations, "
            "-fassociative-math, -freciprocal-math or -fno-signed-zeros); compile without them"};
    detail::require_unbroken(first_broken_kernel());
}

} // namespace sivid

#endif
