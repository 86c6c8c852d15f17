// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_TANH_SLOPE_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_TANH_SLOPE_HPP

#include <sivid/number/interval_traits.hpp>

namespace sivid::number_detail {

/// \f$ \{1 - \tanh^2 t : t \in x\} \f$. The difference is sharp over wide ranges, but far from 0,
/// where tanh is 1 up to a rounding, all that is left of it is that rounding. There
/// \f$ 4 e^{-2|t|} / (1 + e^{-2|t|})^2 \f$ keeps its digits: coefficients of series are slopes
/// times powers of the argument's own rate, and those may be large.
template <interval_scalar I>
[[nodiscard]] I tanh_slope(I const& x) {
    using traits = interval_traits<I>;
    typename traits::mask never{}; // the divisor is at least 1
    I const one = traits::point(1.0);
    I const e = traits::exp(traits::mul(traits::point(-2.0), traits::abs(x)));
    I const far =
        traits::div(traits::mul(traits::point(4.0), e), traits::sqr(traits::add(one, e)), never);
    return traits::intersect(traits::sub(one, traits::sqr(traits::tanh(x))), far);
}

} // namespace sivid::number_detail

#endif
