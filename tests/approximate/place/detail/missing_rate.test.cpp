// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/missing_rate.hpp>

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
