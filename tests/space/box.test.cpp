// SPDX-License-Identifier: MIT
#include <sivid/space/box.hpp>

#include "support/boxes.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::interiors_meet;
using support::mp;
using support::volume;

namespace {

using traits = interval_traits<interval>;

/// Corners are multiples of 2^-20, so that 100 digits hold a volume exactly.
box random_box(draws& d, std::size_t n, double size) {
    auto const corner = [&] {
        return std::ldexp(std::round(std::ldexp(d.uniform(-size, size), 20)), -20);
    };
    std::vector<interval> sides;
    for (std::size_t i = 0; i < n; ++i) {
        double const a = corner();
        double const b = corner();
        sides.push_back(between(std::min(a, b), std::max(a, b)));
    }
    return box(std::move(sides));
}

} // namespace

TEST_CASE("a box is empty when one side is") {
    CHECK_FALSE(is_empty(box{between(0, 1), between(2, 2)}));
    CHECK(is_empty(box{between(0, 1), traits::empty()}));
    CHECK_FALSE(is_empty(box(3)));
    CHECK(box(3).size() == 3);
    CHECK(contains(box(2), {0, 0}));
}

TEST_CASE("hull, intersection, subset and containment of boxes agree on points") {
    draws d(11);
    for (int round = 0; round < 500; ++round) {
        auto const a = random_box(d, 3, 4);
        auto const b = random_box(d, 3, 4);
        auto const both = intersect(a, b);
        auto const around = hull(a, b);
        CHECK(subset(a, around));
        CHECK(subset(b, around));
        CHECK(subset(both, a));
        CHECK(subset(both, b));
        CHECK(subset(a, b) ==
              (!is_empty(both) && contains(b, {a[0].lower(), a[1].lower(), a[2].lower()}) &&
               contains(b, {a[0].upper(), a[1].upper(), a[2].upper()})));
        auto const x = d.in(around);
        CHECK(contains(around, x));
        CHECK((contains(a, x) && contains(b, x)) == (!is_empty(both) && contains(both, x)));
    }
    box const none{between(0, 1), traits::empty()};
    box const some{between(2, 3), between(4, 5)};
    CHECK(subset(none, some));
    CHECK(subset(hull(none, some), some));
    CHECK(subset(hull(some, none), some));
    CHECK(is_empty(intersect(none, some)));
}

TEST_CASE("the middle of a box is in the box, finite even when a side is unbounded") {
    box const x{between(1, 3), traits::entire(), between(0, HUGE_VAL)};
    auto const m = mid(x);
    CHECK(m[0] == 2);
    for (double const v : m) CHECK(std::isfinite(v));
    CHECK(contains(x, m));
    CHECK(width(x) == HUGE_VAL);
    CHECK(width(box{between(1, 3), between(0, 5)}) == 5);
}

TEST_CASE("bisection covers the box and shares the face") {
    draws d(12);
    for (int round = 0; round < 200; ++round) {
        auto const x = random_box(d, 3, 4);
        auto const i = d.below(3);
        double const at = d.in(x[i]);
        auto const [low, high] = bisect(x, i, at);
        CHECK(subset(low, x));
        CHECK(subset(high, x));
        CHECK(low[i].lower() == x[i].lower());
        CHECK(low[i].upper() == at);
        CHECK(high[i].lower() == at);
        CHECK(high[i].upper() == x[i].upper());
        for (std::size_t j = 0; j < 3; ++j) {
            if (j == i) continue;
            CHECK(low[j].lower() == x[j].lower());
            CHECK(high[j].upper() == x[j].upper());
        }
    }
}

TEST_CASE("the difference of boxes covers, without the removed interior and without overlap") {
    draws d(13);
    for (int round = 0; round < 500; ++round) {
        auto const n = 1 + d.below(4);
        auto const outer = random_box(d, n, 4);
        auto inner = random_box(d, n, 4);
        if (d.coin()) inner = intersect(inner, outer);
        auto const pieces = difference(outer, inner);
        CHECK(pieces.size() <= 2 * n);
        auto const common = intersect(outer, inner);
        mp sum = is_empty(common) ? mp(0) : volume(common);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            CHECK(subset(pieces[k], outer));
            CHECK_FALSE(is_empty(pieces[k]));
            if (!is_empty(inner)) CHECK_FALSE(interiors_meet(pieces[k], inner));
            for (std::size_t l = 0; l < k; ++l) CHECK_FALSE(interiors_meet(pieces[k], pieces[l]));
            sum += volume(pieces[k]);
        }
        CHECK(sum == volume(outer)); // exactly
        for (int sample = 0; sample < 20; ++sample) {
            auto const x = d.in(outer);
            bool covered = !is_empty(inner) && contains(inner, x);
            for (auto const& piece : pieces) covered = covered || contains(piece, x);
            CHECK(covered);
        }
    }
}

TEST_CASE("the difference with nothing, with all, and of nothing") {
    box const x{between(0, 1), between(0, 1)};
    box const none{between(0, 1), traits::empty()};
    REQUIRE(difference(x, none).size() == 1);
    CHECK(subset(x, difference(x, none)[0]));
    CHECK(difference(x, x).empty());
    CHECK(difference(none, x).empty());
    CHECK(difference(x, box{between(5, 6), between(0, 1)}).size() == 1);
    // A slice of zero width is removed only up to its closure.
    auto const halves = difference(x, box{between(0.5, 0.5), between(0, 1)});
    REQUIRE(halves.size() == 2);
    CHECK(halves[0][0].upper() == 0.5);
    CHECK(halves[1][0].lower() == 0.5);
}

TEST_CASE("relative volumes enclose the exact quotient") {
    draws d(14);
    for (int round = 0; round < 300; ++round) {
        auto const whole = random_box(d, 3, 4);
        auto const part = intersect(whole, random_box(d, 3, 4));
        auto const v = relative_volume(part, whole);
        mp const exact = is_empty(part) ? mp(0) : volume(part) / volume(whole);
        CHECK(mp(v.lower()) <= exact);
        CHECK(exact <= mp(v.upper()));
        CHECK(width(v) <= 1e-14);
    }
    box const flat{between(0, 2), between(3, 3)};
    CHECK(relative_volume(box{between(0, 1), between(3, 3)}, flat).upper() == 0.5);
    CHECK(relative_volume(flat, flat).lower() == 1);
}

TEST_CASE("a point within a box is off its bounds, and a side without doubles within stays whole") {
    std::mt19937_64 generator(20261120);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int k = 0; k < 1000; ++k) {
        double const a = uniform(generator);
        double const b = uniform(generator);
        box const where{interval_traits<interval>::bounds(std::min(a, b), std::max(a, b)),
                        hull(0.1_dec, 0.1_dec), interval(0.5), hull(0_dec, 1_dec)};
        auto const x = point_within(where, {uniform(generator), 0.3, 0.1, -1.0});
        CHECK(subset(x, where));
        CHECK(x[0].lower() == x[0].upper());
        CHECK(where[0].lower() < x[0].lower());
        CHECK(x[0].upper() < where[0].upper());
        CHECK(x[1].lower() == where[1].lower());
        CHECK(x[1].upper() == where[1].upper());
        CHECK(x[2].lower() == 0.5);
        CHECK(x[3].lower() > 1e-100);
        CHECK(x[3].upper() < 1e-10);
        auto const again = point_within(where, mid(x));
        CHECK(again[0].lower() == x[0].lower());
        CHECK(again[3].lower() == x[3].lower());
    }
}

TEST_CASE("an empty box has so many empty sides, and adds nothing to a hull") {
    CHECK(is_empty(empty_box(2)));
    CHECK(empty_box(2).size() == 2);
    CHECK_FALSE(is_empty(empty_box(0)));
    box const other{interval(1.0, 2.0), interval(3.0)};
    CHECK(subset(hull(empty_box(2), other), other));
    CHECK(subset(other, hull(empty_box(2), other)));
}

TEST_CASE("a part rounded within a box contains the part, at most a cell more, in any units") {
    draws d(65);
    for (int n = 0; n < 2000; ++n) {
        double const unit = n % 3 == 0 ? 1e6 : n % 3 == 1 ? 1.0 / 3600 : 0x1p-12;
        double const least = d.uniform(-9, 9), size = d.uniform(1e-6, 9), share = d.uniform(0, 1);
        double const end = least + share * size;
        auto const round = [&](double u) {
            box const whole{interval(least * u, (least + size) * u)};
            box const part{interval(std::min(end * u, whole[0].upper()), whole[0].upper())};
            auto const found = rounded_within(part, whole);
            CHECK(subset(part, found));
            CHECK(subset(found, whole));
            CHECK(width(found[0]) - width(part[0]) <= 1.01 * 0x1p-16 * size * u);
            return found[0].lower() / u;
        };
        // Bounds that lie next to a multiple may fall on either side of it.
        double const cells = share * 0x1p16;
        bool const close = std::abs(cells + 0x1p-10 - std::round(cells + 0x1p-10)) < 1e-4;
        double const base = round(1), other = round(unit);
        if (!close) CHECK(std::abs(base - other) <= 1e-12 * (std::abs(base) + size));
    }
}

TEST_CASE("what rounding may not move stays: all of a box, points, sides without bounds") {
    box const whole{interval(-1, 3), interval(2.0), interval(0, traits::entire().upper())};
    auto const same = rounded_within(whole, whole);
    CHECK(subset(same, whole));
    CHECK(subset(whole, same));
    box const half{interval(-1, 1), interval(2.0), interval(5, 7)};
    auto const found = rounded_within(half, whole);
    CHECK(found[0].lower() == -1);
    CHECK(found[0].upper() == 1);
    CHECK(found[2].lower() == 5);
    CHECK(found[2].upper() == 7);
}
