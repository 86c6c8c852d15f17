// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "laws/containment.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>

using namespace sivid;

namespace {
constexpr double inf = std::numeric_limits<double>::infinity();
interval make(double lo, double hi) { return detail::bounded(lo, hi); }
} // namespace

TEST_CASE("abs, min, max, sign, saturate at chosen intervals") {
    CHECK(equal(abs(make(-2, -1)), make(1, 2)));
    CHECK(equal(abs(make(-2, 1)), make(0, 2)));
    CHECK(is_empty(abs(detail::empty_interval())));
    CHECK(equal(min(make(1, 5), make(2, 3)), make(1, 3)));
    CHECK(equal(max(make(1, 5), make(2, 3)), make(2, 5)));
    CHECK(is_empty(min(make(1, 2), detail::empty_interval())));
    CHECK(equal(sign(make(-2, 3)), make(-1, 1)));
    CHECK(equal(sign(make(0, 3)), make(0, 1)));
    CHECK(equal(sign(make(0, 0)), make(0, 0)));
    CHECK(equal(sign(make(1e-320, 3)), make(1, 1)));
    CHECK(equal(saturate(make(-5, 0.5), interval{-1.0}, interval{1.0}), make(-1, 0.5)));
    CHECK(equal(saturate(make(-5, 5), make(-2, -1), make(1, 2)), make(-2, 2)));
}

TEST_CASE("the dead band") {
    interval const w = interval{1.0};
    CHECK(equal(deadband(make(-0.5, 0.75), w), make(0, 0)));
    CHECK(equal(deadband(make(-3, 0.5), w), make(-2, 0)));
    CHECK(equal(deadband(make(2, 3), w), make(1, 2)));
    CHECK(equal(deadband(make(2, 3), make(0.5, 1)), make(1, 2.5)));
    CHECK(equal(deadband(make(-3, 3), make(0.5, 1)), make(-2.5, 2.5)));
    CHECK(equal(deadband(make(-inf, inf), w), make(-inf, inf)));
    CHECK(is_empty(deadband(make(1, 2), make(-2, -1))));
    CHECK(equal(deadband(make(1, 2), make(0, inf)), make(0, 2)));
}

TEST_CASE("saturate and deadband contain every value") {
    oracle::inputs in{5};
    for (int i = 0; i < 20'000; ++i) {
        auto const x = laws::random_argument(in, in.uniform(-4.0, 4.0));
        auto const w = laws::random_argument(in, in.uniform(0.0, 2.0));
        if (w.member < 0.0) continue;
        double const t = x.member, m = w.member;
        interval const d = deadband(make(x.lo, x.hi), make(w.lo, w.hi));
        if (t > m) {
            REQUIRE(oracle::at(mpfr_sub, t, m).in(lower(d), upper(d)));
        } else if (t < -m) {
            REQUIRE(oracle::at(mpfr_add, t, m).in(lower(d), upper(d)));
        } else {
            REQUIRE(contains(d, 0.0));
        }
        interval const s = saturate(make(x.lo, x.hi), interval{-m}, make(w.lo, w.hi));
        REQUIRE(contains(s, std::fmin(std::fmax(t, -m), m)));
    }
}
