// SPDX-License-Identifier: MIT
#include <sivid/number/text/nearest_text.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <limits>

TEST_CASE("numbers of few digits stay near and within their range") {
    CHECK(sivid::few_digits(0, 1, 0.3141, 0.05) == 0.3);
    CHECK(sivid::few_digits(0.31, 0.32, 0.3141, 0.05) == 0.31);
    CHECK(sivid::few_digits(-2, 2, -1.9999, 0.001) == -2);
    CHECK(sivid::few_digits(0.4000001, 1, 0.4000001, 1e-3) == 0.4000001);
    CHECK(sivid::few_digits(0, 1, 7, 1) == 1);
    double const infinity = std::numeric_limits<double>::infinity();
    CHECK(sivid::few_digits(-infinity, infinity, 0.30000000000000004, 1e-15) == 0.3);
    support::draws d{5};
    for (int n = 0; n < 1000; ++n) {
        double const low = d.uniform(-10, 10), high = low + d.uniform(0, 3);
        double const at = d.uniform(low, high), tolerance = d.uniform(0, 0.5);
        double const x = sivid::few_digits(low, high, at, tolerance);
        CHECK((low <= x && x <= high && std::abs(x - at) <= tolerance));
    }
}
