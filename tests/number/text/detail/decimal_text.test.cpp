// SPDX-License-Identifier: MIT
#include <sivid/number/decimal.hpp>

#include "number/support.hpp"

#include <string>

using sivid::detail::round_text;
using sivid::detail::scan_number;

TEST_CASE("what is a number") {
    for (char const* good :
         {"0", "1", "-1", "+1", ".5", "5.", "1e5", "1E-5", "1e+5", "00012.50", "1'000", "0x1p3",
          "0X1.8P-3", "-0xaP0", "0x.8p1", "0x1'0p1", "0e999999999999999999999", "1e1'0"}) {
        INFO(good);
        CHECK(scan_number(good).valid);
    }
    for (char const* bad : {"",     "-",    "+",     ".",  "e5",   "1e",     "1e+", "1 ",  " 1",
                            "1,5",  "1..2", "1.2.3", "0x", "0xp1", "0x1p",   "inf", "nan", "1f",
                            "1e5x", "--1",  "'1",    "1'", "1'.5", "0x1e5p", "1p5", "1e'5"}) {
        INFO(bad);
        CHECK_FALSE(scan_number(bad).valid);
    }
    STATIC_REQUIRE(scan_number("0.1").valid);
}

TEST_CASE("exact rounding agrees with MPFR") {
    oracle::inputs in{1};
    oracle::number r;
    auto const random_text = [&] {
        std::string text;
        std::size_t const digits = 1 + in.below(in.below(4) == 0 ? 60 : 20);
        std::size_t const point = in.below(digits + 1);
        for (std::size_t i = 0; i < digits; ++i) {
            if (i == point) text += '.';
            text += static_cast<char>('0' + in.below(10));
        }
        int const reach = in.below(2) == 0 ? 20 : 340;
        text +=
            'e' + std::to_string(static_cast<int>(in.below(static_cast<std::uint64_t>(2 * reach))) -
                                 reach);
        return text;
    };
    for (int i = 0; i < 20'000; ++i) {
        std::string const text = random_text();
        INFO(text);
        auto const got = round_text(text, scan_number(text));
        mpfr_strtofr(r.raw(), text.c_str(), nullptr, 10, MPFR_RNDD);
        double const below = mpfr_get_d(r.raw(), MPFR_RNDD);
        mpfr_strtofr(r.raw(), text.c_str(), nullptr, 10, MPFR_RNDU);
        double const above = mpfr_get_d(r.raw(), MPFR_RNDU);
        REQUIRE(got.below == below);
        REQUIRE(got.exact == (below == above));
        REQUIRE(got.overflow == (above == inf));
    }
}

TEST_CASE("hard cases of rounding") {
    auto const at = [](std::string const& text) { return round_text(text, scan_number(text)); };
    // The middle of two doubles, and a digit 900 places later.
    std::string const middle = "9007199254740993";
    CHECK(at(middle).half == 0);
    CHECK(at(middle + '.' + std::string(900, '0') + '1').half == 1);
    CHECK(at("9007199254740992." + std::string(900, '9')).half == -1);
    CHECK(at("0x1.00000000000008p0").half == 0);
    CHECK(at("0x1.00000000000008p0").below == 1.0);
    CHECK(at("0x1p-1074").exact);
    CHECK(at("0x1p-1075").half == 0);
    CHECK(at("0x1p-1075").below == 0.0);
    CHECK(at("0x1.fffffffffffffp1023").exact);
    CHECK(at("0x1.fffffffffffff8p1023").overflow);
    CHECK(at("0x1p1024").overflow);
    CHECK(at("2.2250738585072011e-308").below < 0x1p-1022);
    CHECK(at("4.9406564584124655e-324").below == tiny);
    CHECK(at("2.4703282292062327e-324").below == 0.0);
}
