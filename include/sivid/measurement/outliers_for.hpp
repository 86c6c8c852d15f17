// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_OUTLIERS_FOR_HPP
#define SIVID_MEASUREMENT_OUTLIERS_FOR_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sivid {

/// How many of n measurements may violate their bounds, if each bound holds with probability `each`
/// or more, independently of the others: the least q for which it is proved that more than q do
/// with a probability of at most 1 - `wanted`. In m experiments with their q each, more do
/// somewhere with a probability of at most m times that.
/// @throws std::invalid_argument  for what is not within 0 to 1
/// @guarantee  the binomial sum is enclosed: q is never too small; one too large where the
///             probability is met within n 1e-15
/// @cost  O(n)
[[nodiscard]] inline std::size_t outliers_for(std::size_t n, interval const& each,
                                              interval const& wanted) {
    using t = interval_traits<interval>;
    for (auto const& x : {each, wanted})
        if (!(x.lower() >= 0 && x.upper() <= 1))
            throw std::invalid_argument("outliers_for: a probability is not within 0 to 1");
    auto const one = t::point(1.0), holds = t::point(each.lower()), fails = t::sub(one, holds);
    auto const count = [](std::size_t k) { return t::point(static_cast<double>(k)); };
    bool undefined = false; // not for what divides here
    // Probabilities of k violations against that of the likeliest k: nothing large underflows.
    auto const mode = std::min(n, static_cast<std::size_t>(fails.upper() * static_cast<double>(n)));
    std::vector<interval> parts(n + 1, one);
    for (auto k = mode; k < n; ++k)
        parts[k + 1] = t::div(t::mul(parts[k], t::mul(count(n - k), fails)),
                              t::mul(count(k + 1), holds), undefined);
    for (auto k = mode; k > 0; --k)
        parts[k - 1] = t::div(t::mul(parts[k], t::mul(count(k), holds)),
                              t::mul(count(n - k + 1), fails), undefined);
    auto total = t::point(0.0), more = total;
    for (auto const& part : parts) total = t::add(total, part);
    auto const rare = t::mul(t::sub(one, wanted), total);
    auto q = n;
    for (; q > 0; --q) {
        more = t::add(more, parts[q]);
        if (undefined || !(more.upper() <= rare.lower())) break;
    }
    return q;
}

} // namespace sivid

#endif
