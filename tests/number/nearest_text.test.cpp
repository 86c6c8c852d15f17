// SPDX-License-Identifier: MIT
#include <sivid/number/nearest_text.hpp>

#include "support/catch.hpp"

#include <limits>

using sivid::nearest_text;

TEST_CASE("numbers in names are short and rounded to nearest") {
    CHECK(nearest_text(0.25, 6) == "0.25");
    CHECK(nearest_text(0.2149999, 2) == "0.21");
    CHECK(nearest_text(-3, 6) == "-3");
    CHECK(nearest_text(1.0 / 3, 3) == "0.333");
    CHECK(nearest_text(1e-5, 3) == "1e-05");
    CHECK(nearest_text(0, 3) == "0");
    CHECK(nearest_text(-1.7976931348623157e308, 17) == "-1.7976931348623157e+308");
    CHECK(nearest_text(std::numeric_limits<double>::infinity(), 3) == "inf");
}
