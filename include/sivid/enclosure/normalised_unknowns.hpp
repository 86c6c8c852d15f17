// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_NORMALISED_UNKNOWNS_HPP
#define SIVID_ENCLOSURE_NORMALISED_UNKNOWNS_HPP

#include <sivid/space/box.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// What is unknown about a family of trajectories, as variables \f$ q \in [-1,1]^N \f$: every side
/// of the boxes of parameters and initial states that has a width is centre + radius * q_v.
struct normalised_unknowns {
    struct side {
        double centre = 0;
        double radius = 0; ///< 0: the side is a point up to `rest`
        double rest = 0;   ///< width of what has no variable
        std::size_t variable = 0;
    };
    std::vector<side> initial;
    std::vector<side> parameters;
    std::size_t variables = 0;

    /// Sides narrower than this, relative to their size, get no variable: they are decimals.
    static constexpr double negligible = 1e-13;

    normalised_unknowns(box const& x0, box const& p) {
        auto const add = [this](interval const& x) {
            side s;
            s.centre = mid(x);
            double const r = rad(x);
            if (r <= negligible * std::abs(s.centre)) {
                s.rest = r;
            } else {
                s.radius = r;
                s.variable = variables++;
            }
            return s;
        };
        for (auto const& x : p) parameters.push_back(add(x));
        for (auto const& x : x0) initial.push_back(add(x));
    }
};

} // namespace sivid

#endif
