// SPDX-License-Identifier: MIT
#include <sivid/number/decimal.hpp>

#include "number/support.hpp"

#include <cstdlib>
#include <string>
#include <type_traits>

using namespace sivid;

namespace {
constexpr decimal tenth = 0.1_dec;

interval strict(std::string const& text) {
    auto const x = parse_decimal(text);
    REQUIRE(x.has_value());
    return *x;
}
/// The tightest enclosure by MPFR.
interval expected(std::string const& text) {
    oracle::number r;
    mpfr_strtofr(r.raw(), text.c_str(), nullptr, 10, MPFR_RNDD);
    double const below = mpfr_get_d(r.raw(), MPFR_RNDD);
    mpfr_strtofr(r.raw(), text.c_str(), nullptr, 10, MPFR_RNDU);
    return make(below, mpfr_get_d(r.raw(), MPFR_RNDU));
}
} // namespace

TEST_CASE("a literal is the decimal, not the double") {
    STATIC_REQUIRE(std::is_trivially_copyable_v<decimal>);
    CHECK(equal(enclose(tenth), expected("0.1")));
    CHECK(lower(enclose(tenth)) < upper(enclose(tenth)));
    CHECK(equal(enclose(-tenth), expected("-0.1")));
    CHECK(equal(enclose(+0.5_dec), interval{0.5}));
    CHECK(equal(enclose(42_dec), interval{42.0}));
    CHECK(equal(enclose(0x1.8p3_dec), interval{12.0}));
    CHECK(equal(enclose(1e400_dec), make(greatest, inf)));
    CHECK(equal(enclose(-1e400_dec), make(-inf, -greatest)));
    CHECK(equal(enclose(1'234.5_dec), interval{1234.5}));
    CHECK(nearest(tenth) == 0.1);
    CHECK(nearest(-tenth) == -0.1);
}

TEST_CASE("hulls and arithmetic with decimals") {
    CHECK(equal(hull(0.10_dec, 0.12_dec), make(lower(expected("0.1")), upper(expected("0.12")))));
    CHECK(equal(hull(0.1_dec, 3), make(lower(expected("0.1")), 3)));
    CHECK(equal(hull(3, 0.5_dec), make(0.5, 3)));
    CHECK(equal(hull(1, 2), make(1, 2)));
    CHECK(equal(hull(interval{1.0}, 0.5_dec), make(0.5, 1)));
    CHECK(equal(interval{1.0} * 0.5_dec, interval{0.5}));
    CHECK(equal(1.5_dec - interval{1.0}, interval{0.5}));
    interval const third = interval{1.0} / 3_dec;
    CHECK(lower(third) < upper(third));
}

TEST_CASE("texts of any length give the tightest enclosure") {
    oracle::inputs in{1};
    for (int i = 0; i < 20'000; ++i) {
        std::string text = in.below(2) == 0 ? "-" : "";
        std::size_t const digits = 1 + in.below(25);
        std::size_t const point = in.below(digits);
        for (std::size_t k = 0; k < digits; ++k) {
            text += static_cast<char>('0' + in.below(10));
            if (k == point) text += '.';
        }
        if (in.below(2) == 0) text += 'e' + std::to_string(static_cast<int>(in.below(60)) - 30);
        INFO(text);
        REQUIRE(equal(strict(text), expected(text)));
        oracle::number r;
        mpfr_strtofr(r.raw(), text.c_str(), nullptr, 10, MPFR_RNDN);
        REQUIRE(parse_nearest(text) == mpfr_get_d(r.raw(), MPFR_RNDN));
    }
}

TEST_CASE("the nearest double is that of the standard library") {
    oracle::inputs in{5};
    for (int i = 0; i < 20'000; ++i) {
        // up to 15 digits and a power of ten that is a double take a short way
        std::string const text = (i % 2 == 0 ? "" : "-") +
                                 std::to_string(in.below(~0ull >> (i % 60))) + 'e' +
                                 std::to_string(static_cast<int>(in.below(60)) - 30);
        INFO(text);
        REQUIRE(parse_nearest(text) == std::strtod(text.c_str(), nullptr));
    }
}

TEST_CASE("malformed texts and overflows give nothing") {
    for (char const* bad :
         {"", "x", "1.2.3", "1e", "inf", "nan", "1e309", "-1e309", "1e999999999999999999999"}) {
        INFO(bad);
        CHECK_FALSE(parse_decimal(bad).has_value());
        CHECK_FALSE(parse_nearest(bad).has_value());
    }
    CHECK(equal(strict("1e-400"), make(0, tiny)));
    CHECK(equal(strict("-1e-999999999"), make(-tiny, 0)));
    CHECK(equal(strict("-0"), make(0, 0)));
    CHECK(equal(strict("0x1p-1075"), make(0, tiny)));
}

TEST_CASE("hostile texts are read like others") {
    std::string const nines(10'000, '9');
    CHECK(equal(strict("0." + nines), make(detail::next_down(1.0), 1.0)));
    CHECK_FALSE(parse_decimal(nines).has_value());
    CHECK(equal(strict(nines + "e-10000"), make(detail::next_down(1.0), 1.0)));
    CHECK(equal(strict("1e-999999999"), make(0, tiny)));
    CHECK_FALSE(parse_decimal("1e999999999").has_value());
    CHECK(equal(strict('0' + std::string(100'000, '0') + '1'), interval{1.0}));
    CHECK(equal(strict("0." + std::string(100'000, '0') + "1e100001"), interval{1.0}));
    CHECK_FALSE(parse_decimal("1e" + nines).has_value());
}
