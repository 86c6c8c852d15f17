// SPDX-License-Identifier: MIT
#include <sivid/decision/design/promise_types.hpp>
#include <sivid/decision/promised_width.hpp>

#include "support/catch.hpp"

#include <stdexcept>
#include <vector>

using namespace sivid;

TEST_CASE("planned measurements begin a period after the start and include the end") {
    auto const plan = planned_measurements::every(0.4, 1, {0.1, 0, 0.2});
    CHECK(plan.times == std::vector<double>{0.4, 0.8, 1});
    CHECK(planned_measurements::every(0.5, 1, {0.1}).times == std::vector<double>{0.5, 1});
    std::vector<std::size_t> seen;
    plan.for_each([&](double, std::size_t channel, double) { seen.push_back(channel); });
    CHECK(seen == std::vector<std::size_t>{0, 2, 0, 2, 0, 2}); // the second channel is not measured
    CHECK_THROWS_AS(planned_measurements::every(0, 1, {0.1}), std::invalid_argument);
    CHECK_THROWS_AS(planned_measurements::every(1e-9, 1, {0.1}), std::invalid_argument);
}

TEST_CASE("a width that is not known to shrink promises nothing") {
    CHECK(promised_width{}.factor() == 1);
    CHECK(promised_width{0, 4, 1}.factor() == 1); // nothing is known of what it was
    CHECK(promised_width{2, 4, 1}.factor() == 0.5);
    CHECK(promised_width{2, 4, 4}.factor() == 1);
    CHECK(promised_width{3, 4, 1}.factor() > 1.0 / 3); // rounded up
}
