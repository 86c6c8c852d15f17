// SPDX-License-Identifier: MIT
#include <sivid/number/decimal_output.hpp>

#include "number/support.hpp"
#include "support/flushing.hpp"

#include <cfenv>
#include <cmath>
#include <string>

using namespace sivid;

TEST_CASE("texts on the safe side of chosen doubles") {
    CHECK(to_decimal_lower(0.1) == "0.1");
    CHECK(to_decimal_upper(0.1) == "0.10000000000000001");
    CHECK(to_decimal_lower(-0.1) == "-0.10000000000000001");
    CHECK(to_decimal_upper(-0.1) == "-0.1");
    CHECK(to_decimal_lower(1e22) == "1e22");
    CHECK(to_decimal_upper(1e22) == "1e22");
    CHECK(to_decimal_lower(0.0) == "0");
    CHECK(to_decimal_upper(-0.0) == "0");
    CHECK(to_decimal_lower(tiny) == "4e-324");
    CHECK(to_decimal_upper(tiny) == "5e-324");
    CHECK(to_decimal_lower(inf) == "inf");
    CHECK(to_decimal_upper(-inf) == "-inf");
    CHECK(to_decimal_lower(1234567.0) == "1234567");
    CHECK(to_decimal_upper(0.00025) == "0.00025000000000000001");
    CHECK(to_string(make(0.5, 2)) == "[0.5, 2]");
    CHECK(to_string(make(-inf, 2)) == "[-inf, 2]");
    CHECK(to_string(nothing()) == "[empty]");
}

TEST_CASE("texts contain, are less than one float away, and no shorter text is") {
    auto const check = [](double x) {
        std::string const lo = to_decimal_lower(x), hi = to_decimal_upper(x);
        INFO(lo << " <= " << to_hex(x) << " <= " << hi);
        // Exact comparison: a text t satisfies upper(enclose(t)) <= x exactly if t <= x.
        auto const below = parse_decimal(lo), above = parse_decimal(hi);
        REQUIRE((below.has_value() || std::abs(x) == greatest));
        if (below) REQUIRE((upper(*below) == x && lower(*below) >= detail::next_down(x)));
        if (above) REQUIRE((lower(*above) == x && upper(*above) <= detail::next_up(x)));
        // The nearest double to either text is x itself or a neighbour.
        if (below && above) REQUIRE(subset(interval{x}, make(lower(*below), upper(*above))));
    };
    oracle::inputs in{1};
    for (int i = 0; i < 5'000; ++i) check(in.mixed());
    for (int k = -323; k <= 308; ++k) { // where the counts of digits change
        double const ten = *parse_nearest("1e" + std::to_string(k));
        for (double const x : {detail::next_down(ten), ten, detail::next_up(ten)}) check(x);
    }
    for (int k = -1074; k < 1024; ++k) { // where the spacings of doubles change
        double const two = std::ldexp(1.0, k);
        for (double const x : {detail::next_down(two), two, detail::next_up(two)}) check(x);
    }
    for (int i = 0; i < 2'000; ++i) {
        // Decimals with few digits come out as they went in, on the side where they lie.
        std::string const text = std::to_string(1 + in.below(999'999)) + 'e' +
                                 std::to_string(static_cast<int>(in.below(40)) - 20);
        interval const x = *parse_decimal(text);
        interval const again = *parse_decimal(to_decimal_lower(upper(x)));
        REQUIRE(equal(again, x));
    }
}

TEST_CASE("texts do not depend on the caller's rounding mode, nor on flushing to zero") {
    auto const check = [](auto const& enter, auto const& leave) {
        enter();
        std::string const text = to_decimal_lower(0.1) + to_decimal_upper(0.1) +
                                 to_decimal_lower(tiny) + to_decimal_upper(1e22) +
                                 to_decimal_upper(-tiny);
        double const near = *parse_nearest("0.3"), large = *parse_nearest("123456789012345e9");
        leave();
        CHECK(text == "0.10.100000000000000014e-3241e22-4e-324");
        CHECK(near == 0.3);
        CHECK(large == 123456789012345e9);
    };
    for (int const mode : {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO})
        check([=] { std::fesetround(mode); }, [] { std::fesetround(FE_TONEAREST); });
    for (auto const flags : flushing::combinations()) {
        auto const before = flushing::read();
        check([=] { flushing::write(before | flags); }, [=] { flushing::write(before); });
    }
}

TEST_CASE("texts of few digits are rounded outward") {
    CHECK(to_string(make(0.123456, 0.123456), 3) == "[0.123, 0.124]");
    CHECK(to_string(make(-0.123456, 99.96), 3) == "[-0.124, 100]");
    CHECK(to_string(make(1e-10, 2e22), 2) == "[1e-10, 2e22]");
    CHECK(to_decimal_upper(9.999, 2) == "10");
    CHECK(to_decimal_lower(9.999, 2) == "9.9");
    oracle::inputs in{3};
    for (int i = 0; i < 5'000; ++i) {
        double const x = in.mixed();
        int const digits = 1 + static_cast<int>(in.below(20));
        auto const below = parse_decimal(to_decimal_lower(x, digits));
        auto const above = parse_decimal(to_decimal_upper(x, digits));
        if (below) REQUIRE(lower(*below) <= x);
        if (below) REQUIRE(upper(*below) <= x);
        if (above) REQUIRE(lower(*above) >= x);
    }
}

TEST_CASE("hexadecimal texts are exact") {
    CHECK(to_hex(1.5) == "0x1.8p+0");
    CHECK(to_hex(-0.0) == "-0x0p+0");
    CHECK(from_hex("-0x1.8p1") == -3.0);
    CHECK(from_hex("inf") == inf);
    CHECK(from_hex("-inf") == -inf);
    CHECK(detail::is_nan(from_hex("nan").value()));
    CHECK_FALSE(from_hex("1.5").has_value());
    CHECK_FALSE(from_hex("0x1.00000000000001p0").has_value());
    CHECK_FALSE(from_hex("0x1p1024").has_value());
    CHECK_FALSE(from_hex("0x1p-1080").has_value());
    oracle::inputs in{2};
    for (int i = 0; i < 20'000; ++i) {
        double const x = in.any();
        auto const y = from_hex(to_hex(x));
        REQUIRE(y.has_value());
        REQUIRE(detail::bits(*y) == detail::bits(x));
    }
}
