// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_DETAIL_STAGE_ARITHMETIC_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_DETAIL_STAGE_ARITHMETIC_HPP

#include <sivid/model/series/taylor_arithmetic.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace sivid::enclosure_detail {

/// What a Krawczyk operator needs of a set of numbers or functions beyond arithmetic.
template <class T>
struct stage_arithmetic {
    using traits = interval_traits<T>;

    /// Upper bound of |a|.
    [[nodiscard]] static double size(T const& a) {
        double result = 0;
        for (std::size_t l = 0; l < traits::lanes; ++l) {
            double const m = traits::mag(a, l);
            // NaN and the empty set: nothing is known.
            if (!(m >= 0)) return std::numeric_limits<double>::infinity();
            result = std::max(result, m);
        }
        return result;
    }
    [[nodiscard]] static T widened(T const& a, double r) {
        return traits::add(a, traits::bounds(-r, r));
    }
    /// A point of the set; no proof rests on which.
    [[nodiscard]] static T core(T const& a) { return traits::point(traits::mid(a)); }
    [[nodiscard]] static double approximate(T const& a) { return traits::mid(a); }
};

/// The same with functions: sizes are bounds over all variables, the core is the polynomial.
template <>
struct stage_arithmetic<taylor_model<double>> {
    using T = taylor_model<double>;

    [[nodiscard]] static double size(T const& a) {
        double const m = a.norm();
        return m >= 0 ? m : std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] static T widened(T const& a, double r) { return sivid::widened(a, r); }
    [[nodiscard]] static T core(T a) {
        a.r() = 0;
        return a;
    }
    [[nodiscard]] static double approximate(T const& a) { return a.c(0); }
};

} // namespace sivid::enclosure_detail

#endif
