// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_MISFIT_HPP
#define SIVID_PAVING_RESPONSE_MISFIT_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace sivid {

/// The ends of a measured bound. Each is the outward neighbour of a decimal, or the decimal itself.
struct measured_ends {
    interval lower, upper;

    /// @given  bounded
    explicit measured_ends(interval const& bound) : lower(bound.lower()), upper(bound.upper()) {
        if (!(bound.lower() < bound.upper())) return;
        lower = interval_traits<interval>::bounds(bound.lower(), detail::next_up(bound.lower()));
        upper = interval_traits<interval>::bounds(detail::next_down(bound.upper()), bound.upper());
    }
};

/// Encloses \f$ |y - m| / e \f$ for all y in `output`, where m is the middle and e the half width
/// of the measured bound: by which factor the bound must grow to contain y.
///   A bound that is not bounded cannot grow: the misfit is 0 within and infinite outside.
[[nodiscard]] inline interval misfit(interval const& output, interval const& bound) {
    using traits = interval_traits<interval>;
    if (is_empty(output) || is_empty(bound)) return traits::bounds(0.0, detail::infinity);
    if (!is_bounded(bound)) {
        if (subset(output, bound)) return traits::point(0.0);
        return traits::bounds(disjoint(output, bound) ? detail::greatest : 0.0, detail::infinity);
    }
    bool undefined = false;
    auto const [lo, hi] = measured_ends(bound);
    // |2 y - (lo + hi)| / (hi - lo)
    auto const off = traits::sub(traits::mul(traits::point(2.0), output), traits::add(lo, hi));
    auto const size = traits::sub(hi, lo);
    auto const quotient = [&undefined](double a, double b) {
        return traits::div(traits::point(a), traits::point(b), undefined);
    };
    double const least = mig(off);
    double const most = mag(off);
    double const from = least == 0        ? 0.0
                        : upper(size) > 0 ? lower(quotient(least, upper(size)))
                                          : detail::greatest;
    double const to = most == 0         ? 0.0
                      : lower(size) > 0 ? upper(quotient(most, lower(size)))
                                        : detail::infinity;
    return traits::bounds(std::max(from, 0.0), to);
}

/// All outputs whose misfit is at most `level`. A bound that is not bounded does not grow.
/// @guarantee  contains them
[[nodiscard]] inline interval grown(interval const& bound, double level) {
    using traits = interval_traits<interval>;
    if (!is_bounded(bound)) return bound;
    auto const [lo, hi] = measured_ends(bound);
    auto const half = traits::point(0.5);
    auto const middle = traits::mul(half, traits::add(lo, hi));
    auto const way = traits::mul(traits::point(level), traits::mul(half, traits::sub(hi, lo)));
    return traits::bounds(traits::sub(middle, way).lower(), traits::add(middle, way).upper());
}

/// The (q+1)-th largest; `otherwise` when there are no more than q.
[[nodiscard]] inline double largest_after(std::vector<double> values, std::size_t q,
                                          double otherwise = 0) {
    if (q >= values.size()) return otherwise;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(q), values.end(),
                     std::greater<>());
    return values[q];
}

} // namespace sivid

#endif
