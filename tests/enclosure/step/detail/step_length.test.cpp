// SPDX-License-Identifier: MIT
#include <sivid/enclosure/step/detail/step_length.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;
using enclosure_detail::length_for;
using enclosure_detail::power_of;

TEST_CASE("lengths of steps follow a unit of time that is a power of two bit for bit") {
    support::draws d(91);
    for (int round = 0; round < 400; ++round) {
        std::size_t const k = 1 + d.below(16);
        int const unit = static_cast<int>(d.below(40)) - 20, n = static_cast<int>(k);
        double const most = std::pow(10, d.uniform(-20, 3)), c = std::pow(10, d.uniform(-8, 8));
        double const h = length_for(most, c, k);
        CHECK(std::abs(c * power_of(h, k) - most) <= 1e-13 * most);
        CHECK(length_for(most, std::ldexp(c, -n * unit), k) == std::ldexp(h, unit));
        CHECK(power_of(std::ldexp(h, unit), k) == std::ldexp(power_of(h, k), n * unit));
    }
    CHECK(length_for(0, 1, 3) == 0);
    CHECK(length_for(1e300, 1e-300, 2) == HUGE_VAL);
}
