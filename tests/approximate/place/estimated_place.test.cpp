// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/estimated_place.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the stretch over which a missing rate is clearest, and its mean there") {
    estimated_place p;
    estimated_rate quiet{"E1", {}, {}, {}}, loud{"E2", {}, {}, {}};
    for (int k = 0; k <= 10; ++k) {
        quiet.times.push_back(0.1 * k);
        quiet.values.push_back(0.01);
        loud.times.push_back(0.1 * k);
        loud.values.push_back(k >= 4 && k <= 7 ? 2.0 : 0.0);
    }
    p.rates = {quiet, loud};
    Eigen::MatrixXd const covariance = 0.04 * Eigen::MatrixXd::Identity(11, 11);
    locate(p, {covariance, covariance}, 1, 0);
    CHECK(p.scenario == "E2");
    CHECK_THAT(p.from, WithinAbs(0.4, 1e-12));
    CHECK_THAT(p.to, WithinAbs(0.7, 0.1 + 1e-12));
    CHECK(p.missing > 1.2);
    CHECK(p.deviation > 0);
    CHECK(p.deviation < 0.2);
}

TEST_CASE("nothing known: nothing is located") {
    estimated_place p;
    locate(p, {}, 1, 0);
    CHECK(p.scenario.empty());
}
