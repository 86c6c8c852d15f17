// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/number_text.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

using namespace sivid::report;

namespace {

std::string text(double x, int quantum, rounding way) {
    return plain_text(round_decimal(x, quantum, way));
}

// Nearest double of a text of ours; the mapping is monotonic, so it can be compared.
double value(std::string s) {
    bool const negative = s.starts_with("\xE2\x88\x92");
    s = negative ? s.substr(3) : s;
    double const out = std::strtod(s.c_str(), nullptr);
    return negative ? -out : out;
}

} // namespace

TEST_CASE("rounded decimal: the exact binary value decides, not its decimal name") {
    // The double 0.1 lies above one tenth, the double 0.3 below three tenths.
    CHECK(text(0.1, -1, rounding::down) == "0.1");
    CHECK(text(0.1, -1, rounding::up) == "0.2");
    CHECK(text(0.3, -1, rounding::down) == "0.2");
    CHECK(text(0.3, -1, rounding::up) == "0.3");
    CHECK(text(-0.1, -1, rounding::down) == "\xE2\x88\x92"
                                            "0.2");
    CHECK(text(-0.1, -1, rounding::up) == "\xE2\x88\x92"
                                          "0.1");
    CHECK(text(0.5, -1, rounding::up) == "0.5");
    CHECK(text(9.99, -1, rounding::up) == "10.0");
    CHECK(text(1234, 2, rounding::down) == "1200");
    CHECK(text(1234, 2, rounding::up) == "1300");
    CHECK(text(3, 2, rounding::up) == "100");
    CHECK(text(3, 2, rounding::down) == "0");
    CHECK(text(-3, 2, rounding::up) == "0");
    CHECK(text(0, -2, rounding::up) == "0.00");
    CHECK(text(5e-324, -3, rounding::up) == "0.001");
    CHECK(text(5e-324, -3, rounding::down) == "0.000");
    CHECK(text(0.25, -1, rounding::nearest) == "0.3");
}

TEST_CASE("rounded decimal: down and up enclose the number within one unit") {
    std::uint64_t seed = 42;
    for (int i = 0; i < 4000; ++i) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double const x = std::ldexp(static_cast<double>(static_cast<std::int64_t>(seed)),
                                    -static_cast<int>(seed >> 58) - 30);
        int const quantum = detail::leading_exponent(x) - static_cast<int>(seed % 10);
        double const low = value(text(x, quantum, rounding::down)),
                     high = value(text(x, quantum, rounding::up));
        REQUIRE(low <= x);
        REQUIRE(x <= high);
        REQUIRE(high - low <= std::pow(10.0, quantum) * (1 + 1e-9) + std::fabs(x) * 1e-15);
    }
}

TEST_CASE("rounded decimal: leading digit and powers") {
    CHECK(detail::leading_exponent(0.00123) == -3);
    CHECK(detail::leading_exponent(999.999) == 2);
    CHECK(detail::leading_exponent(std::numeric_limits<double>::max()) == 308);
    CHECK(power_text(-12) == " \xC3\x97 10\xE2\x81\xBB\xC2\xB9\xC2\xB2");
}
