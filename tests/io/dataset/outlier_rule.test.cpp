// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/outlier_rule.hpp>

#include "support/catch.hpp"

#include <string>

using namespace sivid;

namespace {

exact_decimal dec(std::string const& text) { return exact_decimal::parse(text).value(); }
/// k / 10^places as a decimal.
exact_decimal scaled(std::size_t k, int places) {
    return dec(std::to_string(k) + "e-" + std::to_string(places));
}

} // namespace

TEST_CASE("the printed tests of Algorithm 2 are the rule for ceil(dim threshold) - 1 outliers") {
    // In whole numbers: threshold = t / scale, so that nothing is rounded.
    std::size_t differences = 0, compared = 0;
    for (int const places : {2, 3}) {
        std::size_t const scale = places == 2 ? 100 : 1000;
        for (std::size_t t = 1; t <= scale; t += places == 2 ? 1 : 7) {
            auto const rule = outlier_rule::threshold(scaled(t, places));
            for (std::size_t n = 1; n <= 60; ++n) {
                auto const q = rule.of(n);
                REQUIRE(q < n);
                for (std::size_t in = 0; in <= n; ++in) {
                    for (std::size_t out = 0; in + out <= n; ++out) {
                        bool const printed_inside = scale * in > n * (scale - t);
                        bool const printed_outside = scale * out >= n * t;
                        differences += printed_inside != (in >= n - q) ? 1 : 0;
                        differences += printed_outside != (out > q) ? 1 : 0;
                        ++compared;
                    }
                }
            }
        }
    }
    CHECK(differences == 0);
    CHECK(compared > 5'000'000);
}

TEST_CASE("budgets from counts, shares and thresholds are exact") {
    CHECK(outlier_rule(7).of(3) == 7);
    CHECK(outlier_rule::share(dec("0.29")).of(100) == 29);
    CHECK(outlier_rule::share(dec("0")).of(100) == 0);
    CHECK(outlier_rule::share(dec("0.299")).of(100) == 29);
    // The report's 10 %: one less than its prose, where the product is whole.
    CHECK(outlier_rule::threshold(dec("0.1")).of(40) == 3);
    CHECK(outlier_rule::threshold(dec("0.1")).of(41) == 4);
    CHECK(outlier_rule::threshold(dec("0.29")).of(100) == 28);
    CHECK(outlier_rule::threshold(dec("0.29000000000000000000000001")).of(100) == 29);
    CHECK(outlier_rule::threshold(dec("1")).of(12) == 11);
    CHECK(outlier_rule::threshold(dec("1e-300")).of(12) == 0);
    CHECK(outlier_rule::threshold(dec("0.1")).of(0) == 0);
}

TEST_CASE("thresholds not between 0 and 1 and negative shares are refused") {
    CHECK_THROWS_AS(outlier_rule::threshold(dec("0")), std::invalid_argument);
    CHECK_THROWS_AS(outlier_rule::threshold(dec("-0.1")), std::invalid_argument);
    CHECK_THROWS_AS(outlier_rule::threshold(dec("1.0000001")), std::invalid_argument);
    CHECK_THROWS_AS(outlier_rule::share(dec("-0.1")), std::invalid_argument);
}
