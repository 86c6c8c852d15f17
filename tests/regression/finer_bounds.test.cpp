// SPDX-License-Identifier: MIT
// Interval types whose bounds are finer than doubles: what is taken from them as doubles has to be
// said of the side that it stands on.
#include <sivid/enclosure/tube.hpp>
#include <sivid/space/box.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#ifdef SIVID_HAS_MPFI
#include <sivid/number/mp_interval.hpp>

namespace {
using mp = sivid::mp_interval;
using mp_traits = sivid::interval_traits<mp>;

mp quotient(double a, double b) {
    bool cut = false;
    return mp_traits::div(mp_traits::point(a), mp_traits::point(b), cut);
}
} // namespace

TEST_CASE("a set that lies between two doubles stays enclosed though its centre is a double") {
    auto const growth = support::flow_of(
        support::model_of({1, 0, 0, 1e3}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0] * x[0]};
        }));
    bool cut = false;
    double const end = 0.4375;
    // x' = x^2 from 5/16: x(t) = 1 / (16/5 - t)
    auto const exact = mp_traits::div(mp_traits::point(1.0),
                                      mp_traits::sub(quotient(16, 5), mp_traits::point(end)), cut);
    for (double const tolerance : {1e-32, 1e-33, 1e-34, 1e-36}) {
        CAPTURE(tolerance);
        sivid::enclosure_options options;
        options.order = options.variational_order = 40;
        options.tolerance = tolerance;
        options.relative_tolerance = 0;
        options.maximum_step = 0.125;
        options.minimum_step = 1e-6;
        sivid::basic_box<mp> start(1);
        start[0] = mp_traits::point(0.3125);
        auto const motion =
            sivid::integrate<mp>(growth, start, sivid::basic_box<mp>(0), 0, end, options);
        REQUIRE(motion.end_time() == end);
        CHECK(mp_traits::subset(exact, motion.at(end)[0]));
    }
}

TEST_CASE("what is cut from a box covers the rest of it though the cut is no double") {
    auto const third = quotient(1, 3);
    sivid::basic_box<mp> outer(1), inner(1);
    outer[0] = mp_traits::bounds(0, 1);
    inner[0] = mp_traits::hull(third, mp_traits::point(1.0));
    auto const just_below = mp_traits::sub(third, mp_traits::point(1e-18));
    REQUIRE(mp_traits::disjoint(just_below, inner[0]));
    bool covered = false;
    for (auto const& piece : sivid::difference(outer, inner))
        covered = covered || mp_traits::subset(just_below, piece[0]);
    CHECK(covered);
    inner[0] = mp_traits::hull(mp_traits::point(0.0), third);
    CHECK(mp_traits::subset(third, sivid::relative_volume(inner, outer)));
}
#endif
