// SPDX-License-Identifier: MIT
#include "report/well_formed.hpp"
#include "support/catch.hpp"

#include <sivid/report/draw/missing_rate_plot.hpp>

#include <cmath>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

missing_rate_series small_rate() {
    missing_rate_series s{.equation = "yaw", .scenario = "S4", .unit = "rad/s^2"};
    for (int k = 0; k < 20; ++k) {
        double const y = -0.3 + 0.01 * k;
        s.estimate.push_back({0.1 * k, y, {y - 0.05, y + 0.05}});
    }
    s.certified = {{0.2, 0.8, {-0.42, -0.18}}, {1.0, 1.8, {-0.4, 0.1}}};
    return s;
}

} // namespace

TEST_CASE("missing rate: a window without zero looks different from one with it") {
    std::string const text = draw_missing_rate(small_rate(), {.title = "S4"}).str();
    CHECK(markup_error(text) == "");
    CHECK_THAT(text, ContainsSubstring("0.2 to 0.8\xC2\xA0s: [\xE2\x88\x92"
                                       "0.420, \xE2\x88\x92"
                                       "0.179]\xC2\xA0rad/s\xC2\xB2, proved"));
    CHECK(occurrences(text, palette::inside) == 2); // ground and outline of one box
    CHECK(occurrences(text, ", proved</title>") == 2);
    auto const legend = missing_rate_legend({small_rate()});
    REQUIRE(legend.size() == 4);
    CHECK_THAT(legend[1].label, ContainsSubstring("estimate"));
    CHECK_THAT(legend[2].label, ContainsSubstring("proved"));
}

TEST_CASE("missing rate: zero is always shown, wide bounds do not flatten the curve") {
    missing_rate_series s = small_rate();
    s.certified.push_back({0, 1, {-1e6, 1e6}});
    range const r = detail::rate_range(s);
    CHECK(r.lo < -0.3);
    CHECK(r.hi > 0);
    CHECK(r.lo > -2);
    CHECK(r.hi < 2);
}

TEST_CASE("missing rate: undefined and empty") {
    missing_rate_series s = small_rate();
    s.estimate[3] = {NAN, NAN, {NAN, NAN}};
    s.estimate[5].value = INFINITY;
    s.estimate[6].band = {-INFINITY, INFINITY};
    s.certified.push_back({2, 1, {0, 1}});
    s.certified.push_back({0, 1, {}});
    s.certified.push_back({0, INFINITY, {-INFINITY, INFINITY}});
    s.equation = "<yaw>";
    CHECK(markup_error(draw_missing_rate(s).str()) == "");
    CHECK(markup_error(draw_missing_rate({}).str()) == "");
    CHECK_THAT(draw_missing_rate({}).str(), ContainsSubstring("nothing known"));
    CHECK(missing_rate_legend({}).empty());
}
