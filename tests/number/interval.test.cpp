// SPDX-License-Identifier: MIT
#include <sivid/number/interval.hpp>

#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

using namespace sivid;

namespace {
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();
interval make(double lo, double hi) { return detail::bounded(lo, hi); }

template <class A, class B>
concept has_hull = requires(A a, B b) {
    hull(a, b);
};
} // namespace

TEST_CASE("bounds that do not make a set of numbers") {
    CHECK(is_empty(make(2, 1)));
    CHECK(is_empty(make(std::nan(""), 1)));
    CHECK(is_empty(interval{1.0, std::nan("")}));
    // A bound that overflowed to the wrong side stands for numbers beyond the greatest double.
    CHECK(equal(make(inf, inf), make(greatest, inf)));
    CHECK(equal(make(-inf, -inf), make(-inf, -greatest)));
}

TEST_CASE("the middle is finite and inside") {
    CHECK(mid(make(-inf, inf)) == 0.0);
    CHECK(mid(make(1, inf)) == greatest);
    CHECK(mid(make(-inf, 1)) == -greatest);
    CHECK(mid(make(1.7e308, 1.79e308)) == 0.5 * 1.7e308 + 0.5 * 1.79e308);
    CHECK(std::isnan(mid(detail::empty_interval())));
    oracle::inputs in{1};
    for (int i = 0; i < 20'000; ++i) {
        double a = in.mixed(), b = in.below(3) == 0 ? oracle::inputs::moved(a, 1) : in.mixed();
        if (a > b) std::swap(a, b);
        interval const x = make(a, b);
        double const m = mid(x), r = rad(x);
        REQUIRE(contains(x, m));
        REQUIRE(oracle::at(mpfr_sub, m, r).below <= a);
        REQUIRE(oracle::at(mpfr_add, m, r).above >= b);
        // The least such radius.
        if (r > 0.0 && r < greatest) {
            double const smaller = detail::next_down(r);
            REQUIRE((oracle::at(mpfr_sub, m, smaller).above > a ||
                     oracle::at(mpfr_add, m, smaller).below < b));
        }
        REQUIRE(width(x) == oracle::at(mpfr_sub, b, a).above);
        REQUIRE(mag(x) == std::fmax(std::fabs(a), std::fabs(b)));
        REQUIRE(mig(x) == (contains(x, 0.0) ? 0.0 : std::fmin(std::fabs(a), std::fabs(b))));
    }
}

TEST_CASE("sets") {
    interval const none = detail::empty_interval(), all = detail::entire_interval();
    CHECK(subset(none, none));
    CHECK(subset(none, make(1, 2)));
    CHECK_FALSE(subset(make(1, 2), none));
    CHECK(subset(make(1, 2), make(1, 3)));
    CHECK_FALSE(subset(make(1, 2), make(1.5, 3)));
    CHECK(interior(make(1, 2), make(0, 3)));
    CHECK_FALSE(interior(make(1, 2), make(1, 3)));
    CHECK(interior(all, all));
    CHECK_FALSE(interior(make(1, 2), none));
    CHECK(disjoint(make(1, 2), make(3, 4)));
    CHECK_FALSE(disjoint(make(1, 2), make(2, 4)));
    CHECK(disjoint(none, all));
    CHECK(equal(hull(make(1, 2), make(3, 4)), make(1, 4)));
    CHECK(equal(hull(none, make(3, 4)), make(3, 4)));
    CHECK(equal(intersect(make(1, 3), make(2, 4)), make(2, 3)));
    CHECK(is_empty(intersect(make(1, 2), make(3, 4))));
    CHECK_FALSE(contains(all, inf));
    CHECK_FALSE(contains(none, 0.0));
    CHECK(is_bounded(make(1, 2)));
    CHECK_FALSE(is_bounded(none));
    CHECK_FALSE(is_bounded(make(1, inf)));
}

TEST_CASE("whole numbers beside intervals are exact, or enclosed") {
    interval const x = make(1, 2);
    CHECK(equal(x + 1, make(2, 3)));
    CHECK(equal(1 - x, make(-1, 0)));
    CHECK(equal(3 * x, make(3, 6)));
    CHECK(equal(x / 2, make(0.5, 1)));
    constexpr std::int64_t big = (std::int64_t{1} << 53) + 1;
    CHECK(equal(0.0 * x + big, make(0x1p53, 0x1p53 + 2)));
    CHECK(equal(0.0 * x - big, make(-0x1p53 - 2, -0x1p53)));
    CHECK(equal(interval{std::uint64_t{0xffff'ffff'ffff'ffff}},
                make(detail::next_down(0x1p64), 0x1p64)));
    CHECK(equal(interval{0.5f}, make(0.5, 0.5)));
}

TEST_CASE("the hull of two rounded doubles does not compile") {
    STATIC_REQUIRE_FALSE(has_hull<double, double>);
    STATIC_REQUIRE(has_hull<interval, interval>);
}

TEST_CASE("Boost's compound operators and limits use the sound policy") {
    interval x = 1.0;
    x /= interval{3.0};
    CHECK(lower(x) < upper(x));
    CHECK(x.lower() == oracle::at(mpfr_div, 1.0, 3.0).below);
    x *= 3.0;
    CHECK(contains(x, 1.0));
    auto const before = detail::read_control();
    x += x;
    CHECK(detail::read_control() == before);
    CHECK(median(make(1, 2)) == 1.5);
}
