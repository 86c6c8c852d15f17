// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SUGGESTED_DEGREE_HPP
#define SIVID_ENCLOSURE_SUGGESTED_DEGREE_HPP

#include <cstddef>

namespace sivid {

/// A degree for Taylor models in so many unknowns: what it costs grows with \f$ \binom{N+D}{D} \f$
/// coefficients, what it saves are halvings of boxes, of which there are the fewer the more
/// unknowns share them. Not 1, as then all that is not linear is lost to remainders. 0 for points,
/// without any unknown.
/// @guarantee  none is needed: every degree is sound
[[nodiscard]] constexpr std::size_t suggested_degree(std::size_t unknowns) {
    return unknowns == 0 ? 0 : unknowns <= 3 ? 4 : unknowns == 4 ? 3 : 2;
}

/// A degree for a few runs whose remainders are to be small, whatever they cost.
[[nodiscard]] constexpr std::size_t sharp_degree(std::size_t unknowns) {
    return unknowns == 0 ? 0 : unknowns <= 9 ? 4 : unknowns <= 12 ? 3 : suggested_degree(unknowns);
}

} // namespace sivid

#endif
