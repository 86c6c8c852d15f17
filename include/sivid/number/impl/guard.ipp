// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_IMPL_GUARD_IPP
#define SIVID_NUMBER_IMPL_GUARD_IPP

/// @file
/// The trial of all functions, which only `sivid::compiled` makes. (g++ 12 with -flto lost sin and
/// cos of packs in silence.)

#include <sivid/number/guard.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack.hpp>
#include <sivid/number/pack/detail/known_values.hpp>

#include <cstddef>

#ifdef SIVID_COMPILED_ALIKE

namespace sivid::inline SIVID_PACK_TARGET {

namespace trial {

/// Packs of several vectors have the kernels of those of one.
template <std::size_t W>
[[nodiscard]] char const* first_broken_function_of_pack() noexcept {
    if constexpr (pack<W>::parts == 1)
        return first_broken_function<pack_traits<W>>();
    else
        return nullptr;
}

[[nodiscard]] broken_kernel search() noexcept {
    if (auto f = first_broken_function<interval_traits<interval>>()) return {"interval", f};
    if (auto f = first_broken_function_of_pack<1>()) return {"pack<1>", f};
    if (auto f = first_broken_function_of_pack<2>()) return {"pack<2>", f};
    if (auto f = first_broken_function_of_pack<4>()) return {"pack<4>", f};
    if (auto f = first_broken_function_of_pack<8>()) return {"pack<8>", f};
    return {};
}

} // namespace trial

broken_kernel first_broken_kernel() noexcept {
    static broken_kernel const found = trial::search();
    return found;
}

} // namespace sivid::inline SIVID_PACK_TARGET

#endif

#endif
