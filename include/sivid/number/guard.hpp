// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_GUARD_HPP
#define SIVID_NUMBER_GUARD_HPP

/// @file
/// Refuses builds (rounding/detail/machine.hpp) and machines on which interval arithmetic would not
/// prove anything.

#include <sivid/compiled.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/detail/pack_target.hpp>
#include <sivid/number/rounding.hpp>
#include <sivid/number/rounding/detail/machine.hpp>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// A function that missed a known value: of which type, and which function; null where all hold.
struct broken_kernel {
    char const* type = nullptr;
    char const* function = nullptr;
};

/// The first of + - * / of the traits T that misses a known value: the result is no double, and
/// both its neighbours are to be enclosed. Null where all hold.
template <class T>
[[nodiscard]] char const* first_broken_operation() noexcept {
    struct known {
        double x, y;
        double sum, difference, product, quotient; // the greatest doubles below, by MPFR
    };
    constexpr known points[] = {{-3.7, 0.7, -0x1.8000000000001p+1, -0x1.199999999999ap+2,
                                 -0x1.4b851eb851eb9p+1, -0x1.524924924924ap+2},
                                {0.6, 3.1, 0x1.d999999999999p+1, -0x1.4000000000001p+1,
                                 0x1.dc28f5c28f5c2p+0, 0x1.8c6318c6318c5p-3},
                                {2.57, 7.39, 0x1.3eb851eb851ebp+3, -0x1.347ae147ae148p+2,
                                 0x1.2fe075f6fd21fp+4, 0x1.641d1949c9443p-2}};
    auto const holds = [](auto const& z, double below) {
        return T::lower(z) <= below && detail::next_up(below) <= T::upper(z);
    };
    for (known const& k : points) {
        auto const x = T::point(detail::opaque(k.x)), y = T::point(detail::opaque(k.y));
        typename T::mask undefined{};
        if (!holds(T::add(x, y), k.sum)) return "add";
        if (!holds(T::sub(x, y), k.difference)) return "sub";
        if (!holds(T::mul(x, y), k.product)) return "mul";
        if (!holds(T::div(x, y, undefined), k.quotient)) return "div";
    }
    return nullptr;
}

#ifdef SIVID_COMPILED_ALIKE
/// The first function of `interval`, and of packs by each vector that they are made of, that misses
/// a known value. Only the library tries them all, once in a process (less than a millisecond).
/// @given  what `require_sound_environment` demands of the machine
[[nodiscard]] broken_kernel first_broken_kernel() noexcept;
#else
/// The same of + - * / of `interval`: more would compile functions that a program does not call.
[[nodiscard]] inline broken_kernel first_broken_kernel() noexcept {
    static char const* const found = first_broken_operation<interval_traits<interval>>();
    return found == nullptr ? broken_kernel{} : broken_kernel{"interval", found};
}
#endif

} // namespace SIVID_PACK_TARGET

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
///             not rearranged, and + - * / of `interval` enclose known values (with
///             `sivid::compiled`: all functions of `interval` and packs)
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
