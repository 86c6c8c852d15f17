// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/missing_rate.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"

#include <Eigen/Eigenvalues>

using namespace sivid;

TEST_CASE("knots stand at every second sample, denser at the begin") {
    experiment e;
    for (int k = 1; k <= 60; ++k) e.measurements.push_back({0.1 * k, 0, interval(0.0)});
    auto const knots = missing_rate_knots(e);
    CHECK(knots.front() == 0);
    CHECK_THAT(knots.back(), WithinAbs(6, 0.11));
    CHECK_THAT(knots[1], WithinAbs(0.05, 1e-12));
    CHECK_THAT(knots[5], WithinAbs(0.3, 1e-12));
    CHECK(knots.size() > 30);
    CHECK(knots.size() < 45);
    for (std::size_t k = 1; k < knots.size(); ++k) CHECK(knots[k] - knots[k - 1] < 0.31);
    // Long records have few knots still.
    for (int k = 61; k <= 6000; ++k) e.measurements.push_back({0.1 * k, 0, interval(0.0)});
    CHECK(missing_rate_knots(e).size() < 80);
}

TEST_CASE("the prior charges size and change") {
    auto const r = missing_rate_prior({0, 0.5, 1}, {{2, 1}, {4, 3}}, 1);
    REQUIRE(r.rows() == 7);
    Eigen::VectorXd z(7);
    z << 9, 1, 2, 1, 2, 3, 2; // a start, then both equations' values in turn
    Eigen::MatrixXd const full = r.selfadjointView<Eigen::Lower>();
    double const expected = (1 + 1 + 9) / 4.0 + 3 * 4 / 16.0 + 4 / 0.5;
    CHECK_THAT(z.dot(full * z), WithinAbs(expected, 1e-12));
}

TEST_CASE("rates are as large as they are along the motion, for ten gaps of a short record") {
    auto const p = small_campaign::problem();
    CHECK_THAT(rate_time(p), WithinRel(1.0, 1e-9)); // of four seconds
    approximate_campaign c(p);
    auto const z =
        c.variables({1.0}, {mid(p.experiments[0].initial), mid(p.experiments[1].initial)});
    auto const scales = missing_rate_scales(c, z);
    REQUIRE(scales.size() == 3); // p, v, u
    // |u| <= 1 and |v| < 1.5: rates of some tenths to one, four times that and not more.
    CHECK(scales[0].size > 0.4);
    CHECK(scales[0].size < 6);
    CHECK(scales[1].size > 0.8);
    CHECK(scales[1].size < 6);
    double largest = 0;
    for (std::size_t e = 0; e < 2; ++e) {
        for (int k = 0; k <= 80; ++k) {
            largest = std::max(largest, std::abs(small_campaign::input(e, 0.05 * k)));
        }
    }
    CHECK(scales[2].size == largest);
}
