// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

#include <cmath>
#include <cstdint>

using namespace sivid;

namespace {
auto const tan_of = [](interval const& x, bool& cut) { return tan(x, cut); };
} // namespace

TEST_CASE("quarter turns in fixed point are as near as stated") {
    oracle::inputs in{1};
    oracle::number x, turns, error;
    mpfr_set_prec(turns.raw(), 400);
    mpfr_set_prec(error.raw(), 400);
    for (int i = 0; i < 50'000; ++i) {
        double const value = in.below(3) == 0 ? in.mixed() : in.magnitude(-80, 56);
        if (std::fabs(value) >= 0x1p57) continue;
        // value 2/pi 2^64
        mpfr_const_pi(turns.raw(), MPFR_RNDN);
        mpfr_set_d(x.raw(), value, MPFR_RNDN);
        mpfr_div(turns.raw(), x.raw(), turns.raw(), MPFR_RNDN);
        mpfr_mul_2ui(turns.raw(), turns.raw(), 65, MPFR_RNDN);
        detail::wide_integer const got = detail::quarter_turns(value);
        mpfr_set_zero(error.raw(), 1);
        for (int part = 0; part < 4; ++part) { // 32 bits at a time: `long` has no more everywhere
            detail::wide_integer const rest = got >> 32 * (3 - part);
            auto const bits = static_cast<std::uint32_t>(rest);
            mpfr_mul_2ui(error.raw(), error.raw(), 32, MPFR_RNDN);
            if (part == 0)
                mpfr_set_si(error.raw(), static_cast<std::int32_t>(bits), MPFR_RNDN);
            else
                mpfr_add_ui(error.raw(), error.raw(), bits, MPFR_RNDN);
        }
        mpfr_sub(error.raw(), error.raw(), turns.raw(), MPFR_RNDN);
        REQUIRE(std::fabs(mpfr_get_d(error.raw(), MPFR_RNDN)) <=
                static_cast<double>(detail::turns_error));
    }
}

TEST_CASE("extrema between the ends are found") {
    CHECK(equal(sin(everything()), make(-1, 1)));
    CHECK(upper(sin(make(1, 2))) == 1.0);
    CHECK(lower(sin(make(1, 2))) > 0.84);
    CHECK(lower(sin(make(4, 5))) == -1.0);
    CHECK(equal(sin(make(0, 6.3)), make(-1, 1)));
    CHECK(lower(cos(make(3, 4))) == -1.0);
    CHECK(upper(cos(make(-1, 1))) == 1.0);
    CHECK(upper(cos(make(1, 3))) < 0.541);
    CHECK(equal(cos(interval{0.0}), make(1, 1)));
    CHECK(equal(sin(interval{0.0}), make(0, 0)));
    CHECK(equal(sin(make(0x1p60, 0x1.8p60)), make(-1, 1)));
    CHECK(equal(cos(make(-0x1p60, 1)), make(-1, 1)));
    CHECK(is_empty(sin(nothing())));
    CHECK(is_empty(cos(nothing())));
    // Points are never wide.
    for (double const x : {1e22, 0x1p1000, greatest, -1e300}) {
        CHECK(width(sin(interval{x})) < 1e-14);
        CHECK(width(cos(interval{x})) < 1e-14);
    }
    // Neighbouring doubles around pi/2.
    interval const s = sin(make(0x1.921fb54442d17p0, 0x1.921fb54442d1ap0));
    CHECK(upper(s) == 1.0);
    CHECK(lower(s) > 1.0 - 1e-15);
}

TEST_CASE("narrow intervals are not made wide") {
    oracle::inputs in{2};
    for (int i = 0; i < 20'000; ++i) {
        double const x = in.magnitude(-6, 40), y = oracle::inputs::moved(x, 1);
        interval const box = make(x < y ? x : y, x < y ? y : x);
        double const w = width(box) > 2.0 ? 2.0 : width(box);
        REQUIRE(width(sin(box)) <= w + 1e-15);
        REQUIRE(width(cos(box)) <= w + 1e-15);
    }
}

TEST_CASE("poles of the tangent are reported") {
    CHECK_FALSE(with_cut(tan_of, make(-1.5, 1.5)).second);
    CHECK(with_cut(tan_of, make(1.5, 1.6)).second);
    CHECK(equal(with_cut(tan_of, make(1.5, 1.6)).first, everything()));
    CHECK(with_cut(tan_of, make(-1.6, -1.5)).second);
    CHECK(with_cut(tan_of, make(0, 3.2)).second);
    CHECK(with_cut(tan_of, everything()).second);
    // The doubles on both sides of pi/2.
    double const below = 0x1.921fb54442d18p0, above = 0x1.921fb54442d19p0;
    CHECK_FALSE(with_cut(tan_of, interval{below}).second);
    CHECK(lower(tan(interval{below})) > 1.6e16);
    CHECK(with_cut(tan_of, make(below, above)).second);
    CHECK_FALSE(with_cut(tan_of, make(above, 2)).second);
    CHECK_FALSE(with_cut(tan_of, make(1, below)).second);
    CHECK(equal(tan(interval{0.0}), make(0, 0)));
    CHECK(is_empty(tan(nothing())));
    CHECK_FALSE(with_cut(tan_of, nothing()).second);
}
