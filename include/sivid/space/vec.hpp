// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_VEC_HPP
#define SIVID_SPACE_VEC_HPP

#include <array>
#include <cstddef>

namespace sivid {

/// A fixed-length tuple of scalars, the shape in which a model's functor receives and returns its
/// states, inputs and outputs: `auto const& [u, v, r] = x;`
template <class T, std::size_t N>
using vec = std::array<T, N>;

} // namespace sivid

#endif
