// SPDX-License-Identifier: MIT
// An interval type of one's own, plugged into sivid by specialising interval_traits: numbers given
// as a middle and a radius, as people write them (1.297 +- 0.002).
#ifndef EXAMPLES_CUSTOM_INTERVAL_MIDDLE_RADIUS_HPP
#define EXAMPLES_CUSTOM_INTERVAL_MIDDLE_RADIUS_HPP

#include <sivid/number/traits_by_bounds.hpp>

#include <cstddef>
#include <limits>

/// The reals between middle - radius and middle + radius, both rounded outward; a negative radius
/// is the empty set.
struct middle_radius {
    double middle = 0.0, radius = 0.0;
};

template <>
struct sivid::interval_traits<middle_radius> : sivid::traits_by_bounds<middle_radius> {
    /// The radius is rounded up, so that nothing is lost: mid and rad of the vocabulary type do
    /// that.
    static middle_radius bounds(double lo, double hi) {
        sivid::interval const x = sivid::interval_traits<sivid::interval>::bounds(lo, hi);
        return sivid::is_empty(x) ? empty() : middle_radius{sivid::mid(x), sivid::rad(x)};
    }
    static middle_radius empty() { return {0.0, -1.0}; }
    /// Reading is rounded outward: middle - radius is hardly ever a double.
    static double lower(middle_radius const& a, std::size_t = 0) { return sivid::lower(both(a)); }
    static double upper(middle_radius const& a, std::size_t = 0) { return sivid::upper(both(a)); }

    /// Better than by bounds: no change of representation.
    static middle_radius neg(middle_radius const& a) { return {-a.middle, a.radius}; }

private:
    static sivid::interval both(middle_radius const& a) {
        using traits = sivid::interval_traits<sivid::interval>;
        if (a.radius < 0.0) return traits::empty();
        return traits::add(traits::point(a.middle), traits::bounds(-a.radius, a.radius));
    }
};

static_assert(sivid::interval_scalar<middle_radius>);

#endif
