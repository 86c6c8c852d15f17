// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/unit_conversion.hpp>

#include "io/import_support.hpp"

#include <cstdint>
#include <random>

using namespace sivid;
using io_support::dec;

TEST_CASE("decimal conversions are exact") {
    unit_conversion c;
    CHECK(c(dec("0.1"))->value == dec("0.1"));
    CHECK(c(dec("0.1"))->rounding.is_zero());
    CHECK(c.text().empty());
    c.factor_lower = c.factor_upper = dec("35.15065188");
    c.offset = dec("-0.5");
    auto const y = c(dec("2.538628"));
    CHECK(y->value == dec("35.15065188").times(dec("2.538628")) - dec("0.5"));
    CHECK(y->rounding.is_zero());
    CHECK(c.text() == "reading * 35.15065188 - 0.5");
    c.divisor = 1024;
    CHECK(c(dec("1024"))->value == dec("34.65065188"));
    CHECK(c(dec("1024"))->rounding.is_zero());
    CHECK(c.text() == "reading * 35.15065188 / 1024 - 0.5");
}

TEST_CASE("what no decimal is, is enclosed") {
    std::mt19937_64 random{3};
    for (int i = 0; i < 3000; ++i) {
        unit_conversion c;
        auto const f =
            dec(std::to_string(static_cast<std::int64_t>(random() % 2000001) - 1000000) + "e-5");
        auto const width = dec(std::to_string(random() % 3) + "e-9");
        c.factor_lower = f;
        c.factor_upper = f + width;
        c.divisor = 1 + static_cast<std::size_t>(random() % 5000);
        c.offset = dec(std::to_string(static_cast<std::int64_t>(random() % 2001) - 1000) + "e-3");
        auto const x =
            dec(std::to_string(static_cast<std::int64_t>(random() % 200001) - 100000) + "e-2");
        auto const y = c(x);
        REQUIRE(y);
        // Multiplied by the divisor everything is exact.
        for (auto const& factor : {c.factor_lower, c.factor_upper}) {
            auto const truth = x.times(factor) + c.offset.times(c.divisor);
            CHECK_FALSE(truth < (y->value - y->rounding).times(c.divisor));
            CHECK_FALSE((y->value + y->rounding).times(c.divisor) < truth);
        }
        // And not much is given away.
        CHECK_FALSE(magnitude(x).times(width).times(dec("0.51")) + dec("1e-20") <
                    y->rounding.times(c.divisor));
    }
}

TEST_CASE("error bounds are scaled upward") {
    unit_conversion c;
    c.factor_lower = dec("-5");
    c.factor_upper = dec("-4.9");
    c.divisor = 1023;
    c.offset = dec("100"); // has no part in a bound
    auto const e = c.bound(dec("2"));
    CHECK_FALSE(e.times(1023) < dec("10"));
    CHECK(e.times(1023) < dec("10.00000000001"));
    CHECK(c.bound(dec("1e-400")).is_positive());
    CHECK(enclose(c.bound(dec("1e-400"))));
    CHECK(c.text() == "reading * [-5, -4.9] / 1023 + 100");
}

TEST_CASE("extremes stay within the range of double or are refused") {
    unit_conversion c;
    c.factor_lower = c.factor_upper = dec("1e200");
    CHECK_FALSE(c(dec("1e200")));
    CHECK_FALSE(c(dec("-1e200")));
    CHECK(c(dec("1e100"))->value == dec("1e300"));
    c.factor_lower = c.factor_upper = dec("1e-300");
    auto const y = c(dec("1e-4000"));
    REQUIRE(y);
    CHECK(y->value.is_zero());
    CHECK(y->rounding.is_positive()); // zero stands for it, and says so
    auto const longer = c(dec("1." + std::string(400, '3') + "e300"));
    REQUIRE(longer);
    CHECK(longer->value.text().size() <= 32);
    CHECK(longer->rounding.is_positive());
}

TEST_CASE("helpers") {
    CHECK(magnitude(dec("-2")) == dec("2"));
    CHECK(magnitude(dec("2")) == dec("2"));
    CHECK(rounded_up(dec("0.12345"), 3) == dec("0.124"));
    CHECK(rounded_up(dec("0.123"), 3) == dec("0.123"));
}
