// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

#include <climits>

using namespace sivid;

namespace {
template <class N>
concept takes_real_exponent = requires(interval const& x, N n) {
    pown(x, n);
};
auto const sqrt_of = [](interval const& x, bool& cut) { return sqrt(x, cut); };
} // namespace

TEST_CASE("sqr and sqrt are tight") {
    CHECK(equal(sqr(make(-3, 1)), make(0, 9)));
    CHECK(equal(sqr(make(-3, -2)), make(4, 9)));
    CHECK(equal(sqrt(make(4, 9)), make(2, 3)));
    CHECK(with_cut(sqrt_of, make(-1, 4)).second);
    CHECK(equal(with_cut(sqrt_of, make(-1, 4)).first, make(0, 2)));
    CHECK_FALSE(with_cut(sqrt_of, make(-0.0, 4)).second);
    CHECK(is_empty(sqrt(make(-2, -1))));
    CHECK(upper(sqrt(make(1, inf))) == inf);
    oracle::inputs in{1};
    for (int i = 0; i < 20'000; ++i) {
        double const x = in.mixed(), p = x < 0.0 ? -x : x;
        REQUIRE(equal(sqrt(interval{p}),
                      make(oracle::at(mpfr_sqrt, p).below, oracle::at(mpfr_sqrt, p).above)));
        REQUIRE(equal(sqr(interval{x}),
                      make(oracle::at(mpfr_sqr, x).below, oracle::at(mpfr_sqr, x).above)));
    }
}

TEST_CASE("integer powers") {
    CHECK(equal(pown(nothing(), 0), nothing()));
    CHECK(equal(pown(everything(), 0), make(1, 1)));
    CHECK(equal(pown(make(0, 0), 0), make(1, 1)));
    CHECK(equal(pown(make(-2, 3), 3), make(-8, 27)));
    CHECK(equal(pown(make(-2, 3), 4), make(0, 81)));
    CHECK(equal(pown(make(-3, -2), 4), make(16, 81)));
    CHECK(equal(pown(make(2, 4), -1), make(0.25, 0.5)));
    CHECK(equal(pown(make(-2, 4), -1), everything()));
    CHECK(equal(pown(make(0, 4), -1), make(0.25, inf)));
    CHECK(lower(pown(make(-2, 4), -2)) <= 0.0625);
    CHECK(upper(pown(make(-2, 4), -2)) == inf);
    CHECK(is_empty(pown(make(0, 0), -3)));
    CHECK(equal(pown(everything(), 5), everything()));
    CHECK(equal(pown(interval{-1.0}, INT_MIN), make(1, 1)));
    CHECK(equal(pown(interval{1.0}, INT_MAX), make(1, 1)));
    CHECK(equal(pown(interval{2.0}, INT_MAX), make(lower(pown(interval{2.0}, INT_MAX)), inf)));
    bool cut = false;
    static_cast<void>(pown(make(-1, 1), 3, cut));
    CHECK_FALSE(cut);
    static_cast<void>(pown(make(0, 1), -3, cut));
    CHECK(cut);
    oracle::inputs in{2};
    for (int i = 0; i < 40'000; ++i) {
        double const x = in.magnitude(-8, 8);
        int const n = static_cast<int>(in.below(240)) - 120;
        interval const y = pown(interval{x}, n);
        oracle::value const v = oracle::power(x, n);
        REQUIRE(v.in(lower(y), upper(y)));
        REQUIRE((v.above > 1e308 || v.above < -1e308 || detail::step(v.below, -6) <= lower(y)));
    }
}

TEST_CASE("real powers") {
    CHECK(equal(pow(make(0, 0), make(1, 2)), make(0, 0)));
    CHECK(is_empty(pow(make(0, 0), make(-2, 0))));
    CHECK(is_empty(pow(make(-3, -1), make(1, 2))));
    CHECK(equal(pow(make(-1, 1), make(0, 1)), make(0, 1)));
    CHECK(equal(pow(make(0, 2), make(-1, -1)), make(lower(pow(make(0, 2), make(-1, -1))), inf)));
    CHECK(lower(pow(make(1, 2), make(0, 3))) == 1.0);
    CHECK(upper(pow(make(0.5, 1), make(0, 3))) == 1.0);
    CHECK(equal(pow(make(1, 1), everything()), make(1, 1)));
    CHECK(equal(pow(make(2, 3), everything()), make(0, inf)));
    CHECK(is_empty(pow(nothing(), make(1, 2))));
    CHECK(equal(pow(make(2, 3), 2), make(4, 9)));
    bool cut = false;
    static_cast<void>(pow(make(0, 1), make(1, 2), cut));
    CHECK_FALSE(cut);
    static_cast<void>(pow(make(0, 1), make(0, 2), cut));
    CHECK(cut);
    cut = false;
    static_cast<void>(pow(make(-1, 1), make(1, 2), cut));
    CHECK(cut);
}

TEST_CASE("exponents are never cut off to integers") {
    CHECK(contains(pow(make(4, 4), 0.5), 2.0));
    CHECK(width(pow(make(4, 4), 0.5)) < 1e-14);
    CHECK(equal(pow(make(-2, -2), 3), make(-8, -8)));
    CHECK(equal(pow(make(-2, -2), 2u), make(4, 4)));
    CHECK(equal(pow(make(-2, -2), 1LL << 40), make(0, inf)));
    CHECK(equal(pow(make(-2, -2), (1LL << 40) + 1), everything()));
    STATIC_REQUIRE_FALSE(takes_real_exponent<double>);
    STATIC_REQUIRE(takes_real_exponent<int>);
}

TEST_CASE("hypot without overflow or underflow on the way") {
    CHECK(contains(hypot(interval{3.0}, interval{4.0}), 5.0));
    CHECK(contains(hypot(interval{3e300}, interval{4e300}), 5e300));
    CHECK(upper(hypot(interval{3e300}, interval{4e300})) < 5.000001e300);
    CHECK(upper(hypot(interval{3e-320}, interval{4e-320})) < 5.1e-320);
    CHECK(equal(hypot(make(-1, 1), interval{0.0}), make(0, 1)));
    CHECK(upper(hypot(interval{greatest}, interval{greatest})) == inf);
    CHECK(lower(hypot(interval{greatest}, interval{greatest})) == greatest);
    CHECK(equal(hypot(make(-inf, 1), make(-2, 2)), make(0, inf)));
    CHECK(is_empty(hypot(nothing(), interval{1.0})));
    oracle::inputs in{3};
    for (int i = 0; i < 20'000; ++i) {
        double const x = in.mixed(), y = in.below(2) == 0 ? x * in.uniform(0.1, 3.0) : in.mixed();
        if (y - y != 0.0) continue;
        interval const h = hypot(interval{x}, interval{y});
        oracle::value const v = oracle::at(mpfr_hypot, x, y);
        REQUIRE(v.in(lower(h), upper(h)));
        REQUIRE(detail::step(v.below, -4) <= lower(h));
        REQUIRE(upper(h) <= detail::step(v.above, 4));
    }
}
