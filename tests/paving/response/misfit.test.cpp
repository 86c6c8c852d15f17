// SPDX-License-Identifier: MIT
#include <sivid/paving/response/misfit.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace sivid;
using support::between;
using rational = boost::multiprecision::cpp_rational;

TEST_CASE("a misfit encloses the exact ratio for every output in the interval") {
    support::draws d(51);
    for (int trial = 0; trial < 300; ++trial) {
        double const m = d.uniform(-3, 3);
        double const e = std::pow(10, d.uniform(-9, 2));
        auto const bound = between(m - e, m + e);
        auto const output = d.interval(-4, 4, d.coin() ? 0.1 : 3);
        auto const found = misfit(output, bound);
        for (int sample = 0; sample < 6; ++sample) {
            rational const y(d.in(output));
            rational const middle = (rational(bound.lower()) + rational(bound.upper())) / 2;
            rational const half = (rational(bound.upper()) - rational(bound.lower())) / 2;
            rational const exact = abs(y - middle) / half;
            CHECK(rational(found.lower()) <= exact);
            CHECK(exact <= rational(found.upper()));
        }
        if (is_point(output)) CHECK(width(found) <= 1e-5 * std::max(1.0, found.upper()));
    }
}

TEST_CASE("a misfit holds for the decimals that a bound encloses") {
    // 0.1 and 0.3: middle 0.2, half width 0.1; the output 0.5 has misfit 3.
    auto const bound = between(std::nextafter(0.1, 0), std::nextafter(0.3, 1));
    auto const found = misfit(interval(0.5), bound);
    CHECK(found.lower() <= 3);
    CHECK(3 <= found.upper());
    CHECK(width(found) < 1e-12);
}

TEST_CASE("misfits at the limits") {
    double const inf = std::numeric_limits<double>::infinity();
    CHECK(misfit(interval(1.0), between(0, 2)).lower() == 0);
    CHECK(misfit(between(-1, 1), between(-1, 1)).lower() == 0);
    CHECK(misfit(interval_traits<interval>::entire(), between(-1, 1)).upper() == inf);
    CHECK(misfit(interval_traits<interval>::empty(), between(-1, 1)).upper() == inf);
    // A bound of no width: met exactly or never.
    CHECK(misfit(interval(1.0), interval(1.0)).upper() == 0);
    CHECK(misfit(interval(2.0), interval(1.0)).lower() > 1e300);
    CHECK(misfit(between(1, 2), interval(1.0)).lower() == 0);
    CHECK(misfit(between(1, 2), interval(1.0)).upper() == inf);
    // Half a line cannot grow.
    CHECK(misfit(interval(2.0), between(1, inf)).upper() == 0);
    CHECK(misfit(interval(0.0), between(1, inf)).lower() > 1e300);
    CHECK(misfit(between(0, 2), between(1, inf)).lower() == 0);
    CHECK(misfit(between(0, 2), between(1, inf)).upper() == inf);
}

TEST_CASE("the (q+1)-th largest") {
    CHECK(largest_after({3, 1, 2}, 0) == 3);
    CHECK(largest_after({3, 1, 2}, 1) == 2);
    CHECK(largest_after({3, 1, 2}, 2) == 1);
    CHECK(largest_after({3, 1, 2}, 3) == 0);
    CHECK(largest_after({}, 0) == 0);
}

TEST_CASE("a grown bound holds every output whose misfit is at most the level, and little more") {
    support::draws d(77);
    for (int n = 0; n < 2000; ++n) {
        double const m = d.uniform(-5, 5);
        auto const bound = support::around(m, d.uniform(1e-6, 2));
        double const level = d.uniform(0, 20);
        auto const all = grown(bound, level);
        double const y = d.uniform(m - 50, m + 50);
        if (misfit(interval(y), bound).upper() <= level) CHECK(contains(all, y));
        if (misfit(interval(y), bound).lower() > level * (1 + 1e-12) + 1e-12)
            CHECK_FALSE(contains(all, y));
    }
    auto const half = between(1, detail::infinity);
    CHECK(equal(grown(half, 7), half));
}
