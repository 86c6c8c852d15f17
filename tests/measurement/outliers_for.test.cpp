// SPDX-License-Identifier: MIT
// The count of violations that a probability leaves, against exact rational sums.
#include <sivid/measurement/outliers_for.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>

using namespace sivid;

namespace {

using rational = boost::multiprecision::cpp_rational;

/// The least q with P(more than q of n violated) <= 1 - wanted, exactly.
std::size_t exact(std::size_t n, rational const& each, rational const& wanted) {
    rational term = 1, sum = 0;
    for (std::size_t k = 0; k < n; ++k) term *= each; // no violation
    if (each == 0) return wanted == 0 ? 0 : n;
    for (std::size_t q = 0; q < n; ++q) {
        sum += term;
        if (sum >= wanted) return q;
        term *= (1 - each) / each * rational(n - q, q + 1);
    }
    return n;
}

} // namespace

TEST_CASE("outliers for a probability are those of the exact binomial sum") {
    support::draws d(31);
    for (int round = 0; round < 400; ++round) {
        auto const n = 1 + d.below(60);
        // Doubles are exact rationals.
        double const each = d.coin() ? d.uniform(0.5, 1) : 1 - std::pow(10, -d.uniform(0, 6));
        double const wanted = d.coin() ? d.uniform(0, 1) : 1 - std::pow(10, -d.uniform(1, 12));
        CAPTURE(n, each, wanted);
        CHECK(outliers_for(n, interval(each), interval(wanted)) ==
              exact(n, rational(each), rational(wanted)));
    }
}
TEST_CASE("outliers for a probability that is met exactly, and at its ends") {
    // Of two measurements none is violated with probability 1/4, at most one with 3/4.
    CHECK(outliers_for(2, interval(0.5), interval(0.25)) <= 1);
    CHECK(outliers_for(2, interval(0.5), interval(0.25)) >= 0);
    CHECK(outliers_for(2, interval(0.5), interval(std::nextafter(0.75, 1))) == 2);
    CHECK(outliers_for(10, interval(1.0), interval(1.0)) == 0);
    CHECK(outliers_for(10, interval(0.0), interval(0.5)) == 10);
    CHECK(outliers_for(10, interval(0.9), interval(1.0)) == 10);
    CHECK(outliers_for(0, interval(0.9), interval(0.9)) == 0);
    CHECK(outliers_for(1000, interval(0.997), interval(0.99)) == 8);
    // Ranges are taken at their worst, and nothing underflows.
    CHECK(outliers_for(50, interval(0.9, 0.99), interval(0.5, 0.9)) ==
          outliers_for(50, interval(0.9), interval(0.9)));
    auto const many = outliers_for(100'000, interval(0.5), interval(0.999));
    CHECK(many > 50'400);
    CHECK(many < 50'600);
    for (auto const& bad : {interval(-0.1, 0.5), interval(0.5, 1.1), interval(std::nan(""))}) {
        CHECK_THROWS_AS(outliers_for(5, bad, interval(0.5)), std::invalid_argument);
        CHECK_THROWS_AS(outliers_for(5, interval(0.5), bad), std::invalid_argument);
    }
}
