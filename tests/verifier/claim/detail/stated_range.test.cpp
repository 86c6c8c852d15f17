// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace sivid;
using io_detail::leaves;
using io_detail::share_of;
using io_detail::states;
using traits = interval_traits<interval>;

TEST_CASE("a range may be stated a little too wide, and too narrow by floats of its own ends") {
    auto const follows = interval(1e-17, 2.0);
    CHECK(states(follows, follows));
    CHECK(states(interval(1e-17 * (1 + 0x1p-51), 2.0 - 0x1p-51), follows));
    CHECK(states(interval(-1e-15, 2.0 + 1e-15), follows)); // nothing is excluded
    CHECK_FALSE(states(interval(7e-15, 2.0), follows));    // little beside 2, but false
    CHECK_FALSE(states(interval(1.1e-17, 2.0), follows));
    CHECK_FALSE(states(interval(1e-17, 2.0 - 1e-14), follows));
    CHECK_FALSE(states(interval(-1e-9, 2.0), follows)); // not sharp
    CHECK_FALSE(states(interval(1e-17, 2.0 + 1e-9), follows));
    CHECK(states(interval(-2.0, -1e-17), interval(-2.0, -1e-17)));
    CHECK_FALSE(states(interval(-2.0, -7e-15), interval(-2.0, -1e-17)));
    // Of many operations more is lost.
    CHECK_FALSE(states(interval(1 + 0x1p-49, 2.0), interval(1.0, 2.0)));
    CHECK(states(interval(1 + 0x1p-49, 2.0), interval(1.0, 2.0), 8));
    CHECK(states(interval(0.0), traits::bounds(-5e-324, 5e-324)));
}

TEST_CASE("no bound at one end is no room at the other") {
    auto const no_end = [](double low) { return traits::bounds(low, HUGE_VAL); };
    CHECK(states(no_end(1), no_end(1)));
    CHECK(states(traits::entire(), traits::entire()));
    CHECK_FALSE(states(no_end(1.9), no_end(1)));
    CHECK_FALSE(states(no_end(1), interval(1.0, 2.0)));
    CHECK_FALSE(states(interval(1.0, 2.0), no_end(1)));
    CHECK_FALSE(states(traits::bounds(-HUGE_VAL, 0.0), traits::bounds(-HUGE_VAL, 1.0)));
    CHECK(states(traits::empty(), traits::empty()));
    CHECK_FALSE(states(traits::empty(), interval(1.0)));
    CHECK_FALSE(states(interval(1.0), traits::empty()));
}

TEST_CASE("a box beside a prior leaves it, however close it is") {
    box const prior{interval(0.5, 2.0)};
    CHECK_FALSE(leaves(box{interval(0.5, 1.0)}, prior));
    CHECK_FALSE(leaves(box{interval(1.0, 2.0 + 0x1p-51)}, prior)); // read outward
    CHECK_FALSE(leaves(box{interval(2.0, 2.0 + 0x1p-51)}, prior)); // its face
    CHECK(leaves(box{interval(2.0 + 0x1p-51, 2.0 + 0x1p-50)}, prior));
    CHECK(leaves(box{interval(1.0, 2.1)}, prior));
    CHECK(leaves(box{interval(0.4, 1.0)}, prior));
}

TEST_CASE("a share holds that of every box that would have been printed and read as this one") {
    box const prior{interval(0.0, 1.0), interval(0.1)};
    auto const some = share_of(box{interval(0.25, 0.5), interval(0.1)}, prior);
    CHECK(contains(some, 0.25));
    CHECK(some.lower() < 0.25);
    CHECK(width(some) < 1e-14);
    CHECK(share_of(prior, prior).upper() >= 1);
    CHECK(share_of(prior, prior).lower() > 1 - 1e-14);
    auto const thin = share_of(box{interval(0.5, 0.5 + 0x1p-53), interval(0.1)}, prior);
    CHECK(thin.lower() == 0);
    CHECK(thin.upper() > 0);
    CHECK(share_of(box{interval(1.5, 2.0), interval(0.1)}, prior).upper() == 0);
}
