// SPDX-License-Identifier: MIT
#include <sivid/number/text/nearest_text.hpp>

#include "support/catch.hpp"

#include <cstdlib>
#include <limits>

using sivid::nearest_text;

TEST_CASE("numbers in names are short and rounded to nearest") {
    CHECK(nearest_text(0.25, 6) == "0.25");
    CHECK(nearest_text(0.2149999, 2) == "0.21");
    CHECK(nearest_text(-3, 6) == "-3");
    CHECK(sivid::rounded_to(0.2149999, 2) == 0.21);
    CHECK(sivid::rounded_to(-4321, 1) == -4000);
    CHECK(sivid::rounded_to(3.2e-7, 1) == 3e-7);
    CHECK(nearest_text(1.0 / 3, 3) == "0.333");
    CHECK(nearest_text(1e-5, 3) == "1e-05");
    CHECK(nearest_text(0, 3) == "0");
    CHECK(nearest_text(-1.7976931348623157e308, 17) == "-1.7976931348623157e+308");
    CHECK(nearest_text(std::numeric_limits<double>::infinity(), 3) == "inf");
}

TEST_CASE("without a number of digits the same double is read back") {
    for (double const x : {0.1, 1.0 / 3, -2.5, 1e300, 5e-324, 0.30000000000000004}) {
        CHECK(std::strtod(nearest_text(x).c_str(), nullptr) == x);
    }
    CHECK(nearest_text(0.1) == "0.1");
    CHECK(nearest_text(-3) == "-3");
}
