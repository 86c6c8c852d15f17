// SPDX-License-Identifier: MIT
#include <sivid/io/text/exact_decimal.hpp>

#include "support/catch.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

using sivid::exact_decimal;

namespace {
exact_decimal dec(std::string_view text) {
    auto const value = exact_decimal::parse(text);
    if (!value) throw std::logic_error{"not a decimal: " + std::string{text}};
    return *value;
}
} // namespace

TEST_CASE("exact_decimal reads decimals and nothing else") {
    for (auto good : {"0", "-0", "+1", "1.", ".5", "-.5", "1e3", "1E+3", "1e-3", "00012.500",
                      "1e4999", "0e5"}) {
        CAPTURE(good);
        CHECK(exact_decimal::parse(good));
    }
    for (auto bad : {"",
                     "+",
                     "-",
                     ".",
                     "e3",
                     "1e",
                     "1e+",
                     "1e-",
                     "1e+-3",
                     "--1",
                     "1,5",
                     "0x10",
                     "nan",
                     "inf",
                     "-inf",
                     " 1",
                     "1 ",
                     "1e3.5",
                     "1e999999999999999999999",
                     "1e5001",
                     "1_000",
                     "1f",
                     "½"}) {
        CAPTURE(bad);
        CHECK_FALSE(exact_decimal::parse(bad));
    }
    CHECK_FALSE(exact_decimal::parse(std::string(5001, '7')));
    CHECK(exact_decimal::parse(std::string(100000, '0') + "7") == dec("7"));
}

TEST_CASE("exact_decimal prints what it read, in one form") {
    for (auto [in, out] : {std::pair{"0.20", "0.2"},
                           {"-0", "0"},
                           {"1250", "1250"},
                           {"1e3", "1000"},
                           {"0.0042", "0.0042"},
                           {"-12.50", "-12.5"},
                           {"1e30", "1e30"},
                           {"123e30", "1.23e32"},
                           {"0.0000001", "1e-7"},
                           {"1.5e-9", "1.5e-9"},
                           {".000002", "0.000002"}}) {
        CHECK(dec(in).text() == out);
        CHECK(dec(dec(in).text()) == dec(in));
    }
}

TEST_CASE("sums and products are exact") {
    CHECK(dec("2.038474") - dec("0.02") == dec("2.018474"));
    CHECK(dec("0.1") + dec("0.2") == dec("0.3"));
    CHECK(dec("1") - dec("1.0") == dec("0"));
    CHECK(dec("-5") + dec("3") == dec("-2"));
    CHECK(dec("5") + dec("-7.5") == dec("-2.5"));
    CHECK(dec("1e20") + dec("1e-20") == dec("100000000000000000000.00000000000000000001"));
    CHECK(dec("999.9") + dec("0.1") == dec("1000"));
    CHECK(dec("0") - dec("0.03") == dec("-0.03"));
    CHECK(dec("0.29").times(100).floor() == 29); // 28 in double
    CHECK(dec("0.29").times(99).floor() == 28);
    CHECK(dec("0.999").times(1000000).floor() == 999000);
    CHECK(dec("1e-9").times(5).floor() == 0);
    CHECK(dec("12e2").times(3).floor() == 3600);
    CHECK(dec("0.5").times(0).floor() == 0);
    CHECK(dec("-0.25").times(18446744073709551615u) == dec("-4611686018427387903.75"));
}

TEST_CASE("exact_decimal agrees with integers in a random sample") {
    std::mt19937_64 random{7};
    std::uniform_int_distribution<std::int64_t> draw{-1000000000000, 1000000000000};
    for (int i = 0; i < 2000; ++i) {
        auto const a = draw(random) >> (i % 40), b = draw(random) >> (i % 37);
        auto const x = dec(std::to_string(a)), y = dec(std::to_string(b));
        CHECK(x + y == dec(std::to_string(a + b)));
        CHECK(x - y == dec(std::to_string(a - b)));
        auto const large = dec("1e20"); // more digits than an integer has
        CHECK((x + large) + (y - large) == dec(std::to_string(a + b)));
        CHECK((x < y) == (a < b));
        CHECK(x.is_negative() == (a < 0));
        CHECK(x.is_positive() == (a > 0));
        CHECK(x.times(37) == dec(std::to_string(37 * a)));
        if (a >= 0)
            CHECK((dec(std::to_string(a) + "e-3")).floor() == static_cast<std::size_t>(a / 1000));
    }
}

TEST_CASE("products of decimals are exact") {
    CHECK(dec("0.1").times(dec("0.2")) == dec("0.02"));
    CHECK(dec("-35.15065188").times(dec("2.538628")) == dec("-89.23442908082064"));
    CHECK(dec("0").times(dec("-3")) == dec("0"));
    CHECK(dec("99999999999999999999").times(dec("99999999999999999999e-20")) ==
          dec("99999999999999999998.00000000000000000001"));
    std::mt19937_64 random{5};
    std::uniform_int_distribution<std::int64_t> draw{-2000000000, 2000000000};
    for (int i = 0; i < 2000; ++i) {
        auto const a = draw(random), b = draw(random);
        CHECK(dec(std::to_string(a)).times(dec(std::to_string(b) + "e-7")) ==
              dec(std::to_string(a * b) + "e-7"));
    }
}

TEST_CASE("quotients of decimals are enclosed as tightly as the digits allow") {
    auto const check = [](char const* x, std::size_t n, std::size_t digits, char const* lower,
                          char const* upper) {
        CAPTURE(x, n, digits);
        auto const [lo, hi] = dec(x).divided_by(n, digits);
        CHECK(lo == dec(lower));
        CHECK(hi == dec(upper));
    };
    check("0", 7, 3, "0", "0");
    check("1", 4, 3, "0.25", "0.25");
    check("1", 4, 2, "0.25", "0.25");
    check("1", 4, 1, "0.2", "0.3");
    check("5", 1023, 5, "0.0048875", "0.0048876");
    check("-5", 1023, 5, "-0.0048876", "-0.0048875");
    check("2", 3, 4, "0.6666", "0.6667");
    check("999999", 1, 3, "999000", "1000000");
    check("123456e3", 1, 6, "123456000", "123456000");
    check("123456e3", 1, 2, "120000000", "130000000");
    check("1e-300", 1000000000000000000, 1, "1e-318", "1e-318");
    std::mt19937_64 random{6};
    for (int i = 0; i < 2000; ++i) {
        auto const x = dec(std::to_string(static_cast<std::int64_t>(random() >> 14) - (1LL << 49)));
        auto const n = 1 + static_cast<std::size_t>(random() % 1000000);
        auto const [lo, hi] = x.divided_by(n, 20);
        CHECK_FALSE(x < lo.times(n));
        CHECK_FALSE(hi.times(n) < x);
        auto const size = x.is_negative() ? -x : x; // 20 digits: at most 1e-19 of the quotient
        CHECK_FALSE(size.times(dec("1e-19")) < (hi - lo).times(n));
    }
}

TEST_CASE("decimals become the tightest intervals") {
    auto const tenth = *sivid::enclose(dec("0.1"));
    CHECK(sivid::upper(tenth) == 0.1); // the double lies above the decimal
    CHECK(sivid::lower(tenth) == std::nextafter(0.1, 0.0));
    auto const half = *sivid::enclose(dec("0.5"));
    CHECK((sivid::lower(half) == 0.5 && sivid::upper(half) == 0.5));
    auto const range = *sivid::enclose(dec("0.1"), dec("0.3"));
    CHECK(sivid::lower(range) == std::nextafter(0.1, 0.0));
    CHECK(sivid::upper(range) == std::nextafter(0.3, 1.0)); // the double lies below the decimal
    CHECK_FALSE(sivid::enclose(dec("1e309")));
    CHECK_FALSE(sivid::enclose(dec("0"), dec("1e309")));
    CHECK(*sivid::nearest(dec("0.1")) == 0.1);
    auto const tiny = *sivid::enclose(dec("1e-400"));
    CHECK((sivid::lower(tiny) == 0 &&
           sivid::upper(tiny) == std::numeric_limits<double>::denorm_min()));
}

TEST_CASE("doubles become decimals") {
    CHECK(exact_decimal::shortest(0.1) == dec("0.1"));
    CHECK(exact_decimal::shortest(-1e-7).text() == "-1e-7");
    CHECK(exact_decimal::shortest(0) == dec("0"));
    CHECK(exact_decimal::rounded(2.0384741, 6) == dec("2.038474"));
    CHECK(exact_decimal::rounded(-0.04, 1) == dec("0"));
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> draw{-40, 40};
    for (int i = 0; i < 1000; ++i) {
        double const value = std::pow(10.0, draw(random));
        CHECK(*sivid::nearest(exact_decimal::shortest(value)) == value);
    }
}

TEST_CASE("a double's own decimal has all of its digits") {
    CHECK(exact_decimal::of(0.5) == dec("0.5"));
    CHECK(exact_decimal::of(0.1) ==
          dec("0.1000000000000000055511151231257827021181583404541015625"));
    CHECK(exact_decimal::of(-3) == dec("-3"));
    CHECK(exact_decimal::of(0) == dec("0"));
    std::mt19937_64 random{3};
    for (int k = 0; k < 3000; ++k) {
        std::uint64_t const bits = k < 40 ? 1u + static_cast<std::uint64_t>(k) : random();
        double const x = std::bit_cast<double>(bits); // the least ones first, then any
        if (!std::isfinite(x)) continue;
        char all[800];
        auto const end =
            std::to_chars(all, all + sizeof all, x, std::chars_format::scientific, 766).ptr;
        REQUIRE(exact_decimal::of(x) == *exact_decimal::parse({all, end}));
    }
}

TEST_CASE("a whole number is told from one that is none, or is too large") {
    CHECK(dec("0").whole() == 0u);
    CHECK(dec("-0").whole() == 0u);
    CHECK(dec("12e2").whole() == 1200u);
    CHECK(dec("7.0").whole() == 7u);
    CHECK(dec("1e18").whole() == 1'000'000'000'000'000'000u);
    CHECK(dec("18446744073709551615").whole() == 18446744073709551615u);
    for (auto const* none : {"-1", "1.9", "1e-3", "18446744073709551616", "1e20", "1e30"}) {
        CAPTURE(none);
        CHECK_FALSE(dec(none).whole());
    }
}
