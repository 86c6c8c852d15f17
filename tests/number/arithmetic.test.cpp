// SPDX-License-Identifier: MIT
#include <sivid/number/interval.hpp>

#include "laws/containment.hpp"
#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <cfenv>
#include <limits>

using sivid::interval;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

interval make(double lo, double hi) { return sivid::detail::bounded(lo, hi); }

/// The tightest interval around the four corner values; 0 * inf counts as 0.
interval corners(oracle::binary f, interval const& x, interval const& y) {
    double lo = inf, hi = -inf;
    for (double const s : {lower(x), upper(x)}) {
        for (double const t : {lower(y), upper(y)}) {
            oracle::value v = oracle::at(f, s, t);
            if (!v.defined()) v = {0.0, 0.0};
            lo = v.below < lo ? v.below : lo;
            hi = v.above > hi ? v.above : hi;
        }
    }
    return make(lo, hi);
}

interval random_interval(oracle::inputs& in) {
    laws::argument const x = laws::random_argument(in, in.mixed());
    return make(x.lo, x.hi);
}

} // namespace

TEST_CASE("interval + - * / are tight, in every rounding mode of the caller") {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    oracle::inputs in{static_cast<std::uint64_t>(mode) + 1};
    for (int i = 0; i < 20'000; ++i) {
        interval const x = random_interval(in), y = random_interval(in);
        bool cut = false;
        std::fesetround(mode);
        interval const product = sivid::detail::mul(x, y), sum = sivid::detail::add(x, y);
        interval const difference = sivid::detail::sub(x, y),
                       quotient = sivid::detail::div(x, y, cut);
        interval const square = sivid::detail::sqr(x);
        std::fesetround(FE_TONEAREST);
        INFO("[" << lower(x) << ", " << upper(x) << "] [" << lower(y) << ", " << upper(y) << "]");
        REQUIRE(equal(product, corners(mpfr_mul, x, y)));
        REQUIRE(equal(sum, make(oracle::at(mpfr_add, lower(x), lower(y)).below,
                                oracle::at(mpfr_add, upper(x), upper(y)).above)));
        REQUIRE(equal(difference, make(oracle::at(mpfr_sub, lower(x), upper(y)).below,
                                       oracle::at(mpfr_sub, upper(x), lower(y)).above)));
        REQUIRE(cut == contains(y, 0.0));
        if (!cut) REQUIRE(equal(quotient, corners(mpfr_div, x, y)));
        REQUIRE(equal(square, make(oracle::at(mpfr_mul, mig(x), mig(x)).below,
                                   oracle::at(mpfr_mul, mag(x), mag(x)).above)));
    }
}

TEST_CASE("products whose ends are zeros of either sign, or infinite") {
    double const ends[] = {-inf, -2.0, -0.0, 0.0, 3.0, inf};
    for (double const a : ends)
        for (double const b : ends)
            for (double const c : ends)
                for (double const d : ends) {
                    if (!(a <= b && c <= d) || a == inf || b == -inf || c == inf || d == -inf)
                        continue;
                    interval const x = make(a, b), y = make(c, d);
                    CHECK(equal(sivid::detail::mul(x, y), corners(mpfr_mul, x, y)));
                }
}

TEST_CASE("division by intervals with zero") {
    auto const quotient = [](interval const& x, interval const& y) {
        bool cut = false;
        interval const q = sivid::detail::div(x, y, cut);
        CHECK(cut);
        return q;
    };
    CHECK(equal(quotient(make(1, 2), make(0, 4)), make(0.25, inf)));
    CHECK(equal(quotient(make(1, 2), make(-4, 0)), make(-inf, -0.25)));
    CHECK(equal(quotient(make(-2, -1), make(0, 4)), make(-inf, -0.25)));
    CHECK(equal(quotient(make(-2, -1), make(-4, 0)), make(0.25, inf)));
    CHECK(equal(quotient(make(-30, 0), make(0, 3)), make(-inf, 0)));
    CHECK(equal(quotient(make(0, 0), make(-1, 1)), make(0, 0)));
    CHECK(is_entire(quotient(make(1, 2), make(-1, 1))));
    CHECK(is_entire(quotient(make(-1, 2), make(0, 1))));
    CHECK(is_empty(quotient(make(1, 2), make(0, 0))));
    CHECK(equal(quotient(make(1, 2), make(0, inf)), make(0, inf)));
    bool cut = false;
    CHECK(is_empty(sivid::detail::div(sivid::detail::empty_interval(), make(0, 1), cut)));
    CHECK_FALSE(cut);
}

TEST_CASE("operations on the empty set are empty") {
    interval const none = sivid::detail::empty_interval(), all = sivid::detail::entire_interval();
    CHECK(is_empty(sivid::detail::add(none, all)));
    CHECK(is_empty(sivid::detail::sub(all, none)));
    CHECK(is_empty(sivid::detail::mul(none, make(0, 0))));
    CHECK(is_empty(sivid::detail::sqr(none)));
    CHECK(is_empty(sivid::detail::neg(none)));
}
