// SPDX-License-Identifier: MIT
#include <sivid/model/best_settings.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

TEST_CASE("settings near the best are found, within their limits") {
    std::vector<sivid::manoeuvre_setting> const limits{{"a", "1", -1, 3}, {"b", "s", 10, 20}};
    int asked = 0;
    auto const best = sivid::best_settings(limits, [&](std::vector<double> const& s) {
        ++asked;
        CHECK((s[0] >= -1 && s[0] <= 3 && s[1] >= 10 && s[1] <= 20));
        return -std::pow(s[0] - 2.2, 2) - std::pow((s[1] - 25) / 5, 2);
    });
    CHECK(std::abs(best.settings[0] - 2.2) < 0.3);
    CHECK(best.settings[1] == 20);
    CHECK(asked < 40);
}

TEST_CASE("settings without a value are passed over") {
    double const infinity = std::numeric_limits<double>::infinity();
    std::vector<sivid::manoeuvre_setting> const limits{{"a", "1", 0, 1}};
    auto const none = sivid::best_settings(limits, [&](auto const&) { return -infinity; });
    CHECK(none.settings.empty());
    auto const some = sivid::best_settings(
        limits, [](std::vector<double> const& s) { return s[0] < 0.6 ? NAN : s[0]; });
    CHECK(some.settings[0] > 0.9);
    auto const fixed = sivid::best_settings({}, [](auto const&) { return 2.0; });
    CHECK(fixed.settings.empty());
    CHECK(fixed.value == 2);
}
