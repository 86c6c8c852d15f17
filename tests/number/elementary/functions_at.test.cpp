// SPDX-License-Identifier: MIT
// What elementary functions of `interval` are made of.
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace own = sivid::detail;
namespace integers = sivid::detail::integers;
using sivid::detail::bounds_at;
using sivid::detail::direction;
using sivid::detail::full_product;
using sivid::detail::high_product;
using sivid::detail::product_by_halves;
using sivid::detail::quotient;
using sivid::detail::signed_two_words;
using sivid::detail::two_words;

namespace {

std::int64_t ordered(double x) {
    auto const magnitude =
        static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
    return x < 0.0 ? -magnitude : magnitude;
}

/// The value lies between the bounds, and each is at most `allowed` floats off.
void check(oracle::value const& v, double lower, double upper, std::int64_t allowed) {
    REQUIRE(lower <= v.below);
    REQUIRE(v.above <= upper);
    REQUIRE(ordered(v.below) - ordered(lower) <= allowed);
    REQUIRE(ordered(upper) - ordered(v.above) <= allowed);
}

bounds_at sine_at(double x) { return own::waves_at<0>(x, x); }
bounds_at cosine_at(double x) { return own::waves_at<1>(x, x); }
bounds_at tangent_at(double x) { return own::at_ends<own::tan_bounds>(x, x); }
double pow_down(double x, double y) { return own::pow_at<direction::down>(x, y); }
double pow_up(double x, double y) { return own::pow_at<direction::up>(x, y); }

double far_argument(oracle::inputs& in, int i) {
    if (i % 2 == 0) return in.magnitude(20, 1023);
    for (;;) {
        double const x = in.near_quarter_turn();
        if (std::abs(x) >= 0x1p20) return x;
    }
}

} // namespace

TEST_CASE("sin, cos and tan far from zero, and next to quarter turns there") {
    oracle::inputs in{2024};
    for (int i = 0; i < 40'000; ++i) {
        double const x = far_argument(in, i);
        INFO("argument " << x);
        auto const s = sine_at(x), c = cosine_at(x), t = tangent_at(x);
        check(oracle::at(mpfr_sin, x), s.lower, s.upper, 2);
        check(oracle::at(mpfr_cos, x), c.lower, c.upper, 2);
        check(oracle::at(mpfr_tan, x), t.lower, t.upper, 3);
    }
    // The double that is nearest to a multiple of pi/2, relative to its neighbours' distance.
    double const nearest = std::ldexp(6381956970095103.0, 797);
    for (double const x : {nearest, -nearest, 0x1p20, -0x1p20, std::nextafter(0x1p20, 1e9),
                           std::numeric_limits<double>::max()}) {
        auto const s = sine_at(x), c = cosine_at(x), t = tangent_at(x);
        check(oracle::at(mpfr_sin, x), s.lower, s.upper, 2);
        check(oracle::at(mpfr_cos, x), c.lower, c.upper, 2);
        check(oracle::at(mpfr_tan, x), t.lower, t.upper, 3);
    }
    CHECK(sine_at(inf).lower == -1.0);
    CHECK(tangent_at(-inf).upper == inf);
}

TEST_CASE("the words of 2/pi, and a reduction that is known to more digits") {
    oracle::number exact;
    mpfr_set_prec(exact.raw(), 4000);
    mpfr_const_pi(exact.raw(), MPFR_RNDN);
    mpfr_ui_div(exact.raw(), 2, exact.raw(), MPFR_RNDN);
    for (std::uint64_t const word : integers::two_by_pi) {
        for (int half = 1; half >= 0; --half) { // 32 bits at a time: `long` has no more everywhere
            mpfr_mul_2ui(exact.raw(), exact.raw(), 32, MPFR_RNDN);
            unsigned long const bits = mpfr_get_ui(exact.raw(), MPFR_RNDD);
            REQUIRE(bits == (word >> 32 * half & 0xffff'ffff));
            mpfr_sub_ui(exact.raw(), exact.raw(), bits, MPFR_RNDN);
        }
    }
    oracle::inputs in{7};
    oracle::number turn, rest, off;
    for (auto* x : {&turn, &rest, &off}) mpfr_set_prec(x->raw(), 1400);
    mpfr_const_pi(turn.raw(), MPFR_RNDN);
    mpfr_div_2ui(turn.raw(), turn.raw(), 1, MPFR_RNDN);
    for (int i = 0; i < 20'000; ++i) {
        double const x = std::abs(far_argument(in, i));
        integers::reduced_turns const a = integers::reduce_far(x);
        // |(head + tail) - (x - n pi/2)| <= 2^-68 |rest|
        mpfr_set_d(rest.raw(), x, MPFR_RNDN);
        mpfr_div(off.raw(), rest.raw(), turn.raw(), MPFR_RNDN);
        mpfr_rint(off.raw(), off.raw(), MPFR_RNDN);
        mpfr_mul(off.raw(), off.raw(), turn.raw(), MPFR_RNDN);
        mpfr_sub(rest.raw(), rest.raw(), off.raw(), MPFR_RNDN);
        mpfr_sub_d(off.raw(), rest.raw(), a.head, MPFR_RNDN);
        mpfr_sub_d(off.raw(), off.raw(), a.tail, MPFR_RNDN);
        mpfr_div(off.raw(), off.raw(), rest.raw(), MPFR_RNDN);
        REQUIRE(std::abs(mpfr_get_d(off.raw(), MPFR_RNDN)) < 0x1p-68);
        REQUIRE(std::abs(a.tail) <= 0x1p-53 * std::abs(a.head));
    }
}

TEST_CASE("powers of any positive numbers") {
    oracle::inputs in{2025};
    auto const test = [](double x, double y) {
        if (!(x > 0.0) || x == 1.0 || y == 0.0) return;
        INFO("powers of " << x << ", " << y);
        check(oracle::at(mpfr_pow, x, y), pow_down(x, y), pow_up(x, y), 2);
    };
    for (int i = 0; i < support::swept(30'000, 100'000); ++i) {
        double const x = std::abs(in.mixed());
        test(x, in.mixed());
        // Exponents for which the result is an ordinary number, or just over- or underflows.
        double const reach = std::log2(x);
        if (reach != 0.0 && std::isfinite(reach)) test(x, in.uniform(-1090, 1040) / reach);
        test(oracle::inputs::moved(1.0, static_cast<int>(in.below(200)) - 100),
             in.magnitude(40, 61));
        test(x, static_cast<double>(in.below(60)) - 30.0);
    }
    // Exact ones stay exact where the base is a power of two.
    CHECK(pow_down(8.0, 2.0) == 64.0);
    CHECK(pow_up(8.0, 2.0) == 64.0);
    CHECK(pow_down(0.25, 0.5) == 0.5);
    CHECK(pow_up(0.25, -0.5) == 2.0);
    CHECK(pow_up(2.0, 1024.0) == inf);
    CHECK(pow_down(2.0, 1e300) == std::numeric_limits<double>::max());
    CHECK(pow_up(2.0, -1e300) == std::numeric_limits<double>::denorm_min());
    CHECK(pow_down(2.0, -1e300) == 0.0);
    CHECK(pow_down(2.0, -1074.0) == std::numeric_limits<double>::denorm_min());
}

TEST_CASE("powers with whole exponents") {
    oracle::inputs in{2026};
    auto const test = [](double x, unsigned n) {
        if (!(x > 0.0) || x == inf) return;
        INFO("power of " << x << ", " << n);
        double const y = static_cast<double>(n);
        check(oracle::at(mpfr_pow, x, y), own::pown_at<direction::down>(x, n),
              own::pown_at<direction::up>(x, n), 2);
        check(oracle::at(mpfr_pow, x, -y), own::reciprocal_pown_at<direction::down>(x, n),
              own::reciprocal_pown_at<direction::up>(x, n), 3);
    };
    for (int i = 0; i < 100'000; ++i) {
        test(std::abs(in.mixed()), 1 + static_cast<unsigned>(in.below(12)));
        auto const n = 1 + static_cast<unsigned>(in.below(integers::most_whole + 100));
        test(std::exp2(in.uniform(-1090, 1040) / n), n); // just over- or underflows
        test(oracle::inputs::moved(1.0, static_cast<int>(in.below(200)) - 100), n);
    }
    CHECK(own::pown_at<direction::down>(3.0, 33) == 5559060566555523.0);
    CHECK(own::pown_at<direction::up>(3.0, 33) == 5559060566555523.0);
    CHECK(own::pown_at<direction::down>(2.0, 500) == 0x1p500);
    CHECK(own::reciprocal_pown_at<direction::up>(2.0, 500) == 0x1p-500);
    CHECK(own::reciprocal_pown_at<direction::down>(0x1p-1074, 5) ==
          std::numeric_limits<double>::max());
}

TEST_CASE("what logarithm and exponential in integers are short by") {
    oracle::inputs in{11};
    oracle::number exact, off;
    mpfr_set_prec(exact.raw(), 300);
    mpfr_set_prec(off.raw(), 300);
    double most_log = 0.0, most_exp = 0.0;
    // value 2^bits - computed
    auto const missing = [&](two_words computed, unsigned bits) {
        mpfr_mul_2ui(exact.raw(), exact.raw(), bits, MPFR_RNDN);
        unsigned long shift = 128;
        for (std::uint64_t const part : {computed.high >> 32, computed.high & 0xffff'ffff,
                                         computed.low >> 32, computed.low & 0xffff'ffff}) {
            mpfr_set_ui(off.raw(), static_cast<unsigned long>(part), MPFR_RNDN);
            mpfr_mul_2ui(off.raw(), off.raw(), shift -= 32, MPFR_RNDN);
            mpfr_sub(exact.raw(), exact.raw(), off.raw(), MPFR_RNDN);
        }
        return mpfr_get_d(exact.raw(), MPFR_RNDN);
    };
    for (int i = 0; i < 20'000; ++i) {
        std::uint64_t n = (std::uint64_t{3} << 51) + in.below(std::uint64_t{3} << 51);
        if (n >> 53 != 0) n &= ~std::uint64_t{1}; // in [3/4, 3/2) 2^53, 53 bits
        mpfr_set_d(exact.raw(), static_cast<double>(n), MPFR_RNDN);
        mpfr_div_2ui(exact.raw(), exact.raw(), 53, MPFR_RNDN);
        mpfr_log2(exact.raw(), exact.raw(), MPFR_RNDN);
        mpfr_abs(exact.raw(), exact.raw(), MPFR_RNDN);
        double const log_off = missing(integers::log2_of(n), 124);
        REQUIRE(log_off >= 0.0);
        most_log = std::max(most_log, log_off);

        std::uint64_t const high = in.bits() >> 16;
        mpfr_set_d(exact.raw(), static_cast<double>(high), MPFR_RNDN);
        mpfr_div_2ui(exact.raw(), exact.raw(), 48, MPFR_RNDN);
        mpfr_exp2(exact.raw(), exact.raw(), MPFR_RNDN);
        double const exp_off = missing(integers::exp2_of({high, 0}), 127);
        REQUIRE(exp_off >= 0.0);
        most_exp = std::max(most_exp, exp_off);
    }
    CHECK(most_log < integers::log2_short);
    CHECK(most_exp < integers::exp2_short);
    CHECK(integers::exp2_of({}) == two_words{std::uint64_t{1} << 63, 0});
}

TEST_CASE("area functions and angles are near their values") {
    oracle::inputs in{5};
    for (int i = 0; i < 50'000; ++i) {
        double const x = in.mixed(), y = std::abs(in.mixed());
        INFO("arguments " << x << ", " << y);
        check(oracle::at(mpfr_asinh, x), own::asinh_at::down(x), own::asinh_at::up(x), 8);
        if (std::abs(x) >= 1.0)
            check(oracle::at(mpfr_acosh, std::abs(x)), own::acosh_at::down(std::abs(x)),
                  own::acosh_at::up(std::abs(x)), 8);
        double const part = in.uniform(-1.0, 1.0);
        check(oracle::at(mpfr_atanh, part), own::atanh_at::down(part), own::atanh_at::up(part), 8);
        if (y > 0.0 && x != 0.0) {
            oracle::value const v = oracle::at(mpfr_atan2, y, x);
            REQUIRE(own::atan2_at::down(y, x) <= v.below);
            REQUIRE(v.above <= own::atan2_at::up(y, x));
            if (v.below > 0x1p-1000)
                check(v, own::atan2_at::down(y, x), own::atan2_at::up(y, x), 6);
        }
    }
}

TEST_CASE("integers of two words are those of 128 bits") {
    STATIC_REQUIRE(two_words{1, 0} - two_words{0, 1} == two_words{0, ~std::uint64_t{0}});
    STATIC_REQUIRE((signed_two_words{-3} >> 1) == signed_two_words{-2});
    STATIC_REQUIRE(signed_two_words{-3} < signed_two_words{2});
    STATIC_REQUIRE(signed_two_words{-3} * signed_two_words{5} == signed_two_words{-15});
    using sivid::detail::checked_product;
    using sivid::detail::checked_sum;
    constexpr auto least = std::numeric_limits<std::int64_t>::min();
    STATIC_REQUIRE(checked_product(-(std::int64_t{1} << 31), std::int64_t{1} << 32) == least);
    STATIC_REQUIRE(!checked_product(least, -1));
    STATIC_REQUIRE(!checked_product(std::int64_t{1} << 32, std::int64_t{1} << 31));
    STATIC_REQUIRE(checked_sum(least, 5) == least + 5);
    STATIC_REQUIRE(!checked_sum(least, -1));
#if defined(__SIZEOF_INT128__)
    __extension__ using wide = __int128;
    __extension__ using wide_unsigned = unsigned __int128;
    auto const unsigned_of = [](two_words x) {
        return static_cast<wide_unsigned>(x.high) << 64 | x.low;
    };
    auto const signed_of = [&](signed_two_words x) {
        return static_cast<wide>(unsigned_of(x.bits()));
    };
    oracle::inputs in{1};
    for (int i = 0; i < 100'000; ++i) {
        two_words const a = two_words{in.bits(), in.bits()} >> static_cast<int>(in.below(129));
        two_words const b = two_words{in.bits(), in.bits()} >> static_cast<int>(in.below(129));
        int const n = static_cast<int>(in.below(128));
        REQUIRE(unsigned_of(a + b) == unsigned_of(a) + unsigned_of(b));
        REQUIRE(unsigned_of(a - b) == unsigned_of(a) - unsigned_of(b));
        REQUIRE(unsigned_of(a << n) == unsigned_of(a) << n);
        REQUIRE(unsigned_of(a >> n) == unsigned_of(a) >> n);
        REQUIRE((a < b) == (unsigned_of(a) < unsigned_of(b)));
        REQUIRE(unsigned_of(full_product(a.low, b.low)) ==
                static_cast<wide_unsigned>(a.low) * b.low);
        REQUIRE(full_product(a.low, b.low) == product_by_halves(a.low, b.low));
        std::uint64_t const divisor = (b.low >> 1) + 1;
        REQUIRE(unsigned_of(quotient(a, divisor)) == unsigned_of(a) / divisor);
        // The upper half of a product by its four parts, another way round.
        wide_unsigned const low = static_cast<wide_unsigned>(a.low) * b.low,
                            m1 = static_cast<wide_unsigned>(a.high) * b.low + (low >> 64),
                            m2 = static_cast<wide_unsigned>(a.low) * b.high +
                                 static_cast<std::uint64_t>(m1);
        REQUIRE(unsigned_of(high_product(a, b)) ==
                static_cast<wide_unsigned>(a.high) * b.high + (m1 >> 64) + (m2 >> 64));

        auto const x = static_cast<std::int64_t>(a.low), y = static_cast<std::int64_t>(b.low);
        signed_two_words const s = signed_two_words{x} * signed_two_words{y};
        wide const t = static_cast<wide>(x) * y;
        REQUIRE(signed_of(s) == t);
        REQUIRE(signed_of(-s) == -t);
        REQUIRE(signed_of(s >> n) == t >> n);
        REQUIRE(signed_of(s - signed_two_words{y}) == t - y);
        REQUIRE(signed_of(s + signed_two_words{x}) == t + x);
        REQUIRE((s <= signed_two_words{y}) == (t <= y));
    }
#endif
}
