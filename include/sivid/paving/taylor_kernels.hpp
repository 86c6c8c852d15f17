// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_TAYLOR_KERNELS_HPP
#define SIVID_PAVING_TAYLOR_KERNELS_HPP

#include <cstddef>

namespace sivid {

/// The kernels of Taylor models: number of variables and degree, fewest variables first; degree 0
/// is for points, without any unknown.
#define SIVID_TAYLOR_KERNELS(X) X(1, 0) X(2, 4) X(3, 4) X(4, 3) X(6, 2) X(9, 2) X(12, 2)

/// Calls `use.template operator()<N, D>()` for the kernel that fits so many unknowns: degree 0 for
/// none, 4 up to three, 3 for four, 2 up to twelve.
/// @returns what that returns; with more unknowns than any kernel has, a default value
template <class Use>
[[nodiscard]] auto with_taylor_kernel(std::size_t unknowns, Use const& use) {
#define SIVID_USE_KERNEL(N, D)                                                                     \
    if (unknowns <= (D == 0 ? 0 : N)) return use.template operator()<N, D>();
    SIVID_TAYLOR_KERNELS(SIVID_USE_KERNEL)
#undef SIVID_USE_KERNEL
    return decltype(use.template operator()<2, 4>()){};
}

} // namespace sivid

#endif
