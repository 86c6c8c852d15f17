// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/draw/channel_series.hpp>

#include <cmath>

using namespace sivid::report;

TEST_CASE("channel series: one wild value does not flatten the others") {
    channel_series c{.name = "r", .unit = "rad/s"};
    for (int k = 0; k < 10; ++k) {
        c.measured.push_back({0.1 * k, {-1, 1}});
    }
    range const calm = detail::value_range(c);
    CHECK(calm.lo < -1);
    CHECK(calm.hi < 1.3);
    c.measured.push_back({0.5, {1e6, 1e6 + 1}, sample_state::forced_outlier});
    c.tube.push_back({0, 1, {-INFINITY, 1e9}});
    range const wild = detail::value_range(c);
    CHECK(wild.hi < 8);
    CHECK(wild.hi > 3);
}

TEST_CASE("channel series: nothing known still has ranges") {
    CHECK(is_finite(detail::value_range({})));
    CHECK(is_finite(detail::time_range({})));
    channel_series c;
    c.measured.push_back({NAN, {NAN, NAN}});
    CHECK(is_finite(detail::value_range(c)));
    CHECK(is_finite(detail::time_range(c)));
}

TEST_CASE("channel series: a sample's tip says what is known") {
    channel_series const c{.name = "r", .unit = "rad/s"};
    std::string const tip =
        detail::sample_tip(c, {0.5, {1, 2}, sample_state::forced_outlier, {3, 4}});
    CHECK_THAT(tip, ContainsSubstring("t = 0.5\xC2\xA0s"));
    CHECK_THAT(tip, ContainsSubstring("[1.00, 2.00] rad/s"));
    CHECK_THAT(tip, ContainsSubstring("model within [3.00, 4.00]"));
    CHECK_THAT(tip, ContainsSubstring("outlier (proved)"));
}
