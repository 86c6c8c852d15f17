// SPDX-License-Identifier: MIT
// Encloses the period of a pendulum, T = 2 pi sqrt(l / g), with an interval type of the user's own.
// The exit code is 0 if the enclosure contains the periods of 1000 pendulums that fit the
// measurements.
#include "middle_radius.hpp"

#include <cmath>
#include <iostream>

/// Any interval type will do.
template <sivid::interval_scalar I>
I period(I const& length, I const& gravity, typename sivid::interval_traits<I>::mask& cut) {
    using t = sivid::interval_traits<I>;
    I const pi = t::mul(t::point(4.0), t::atan(t::point(1.0)));
    return t::mul(t::mul(t::point(2.0), pi), t::sqrt(t::div(length, gravity, cut), cut));
}

int main() {
    using traits = sivid::interval_traits<middle_radius>;
    middle_radius const length{0.994, 0.001}, gravity{9.81, 0.005};
    bool cut = false;
    middle_radius const t = period(length, gravity, cut);
    std::cout.precision(15);
    std::cout << "period: " << t.middle << " s +- " << t.radius << " s\n";
    if (cut) return 1;

    for (int i = 0; i < 1000; ++i) {
        double const l = 0.9931 + 1.8e-6 * i, g = 9.8051 + 9.8e-6 * (999 - i);
        if (!traits::contains(t, 2 * std::acos(-1.0) * std::sqrt(l / g))) return 1;
    }
    // The vocabulary type gives the same with its own bounds.
    using other = sivid::interval_traits<sivid::interval>;
    sivid::interval const same =
        period(other::bounds(traits::lower(length), traits::upper(length)),
               other::bounds(traits::lower(gravity), traits::upper(gravity)), cut);
    bool const agree = std::abs(sivid::mid(same) - t.middle) < 1e-12;
    std::cout << "the vocabulary type agrees: " << (agree ? "yes" : "no") << '\n';
    return agree ? 0 : 1;
}
