// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/approximate_campaign.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("a campaign differentiates its residuals by all its variables") {
    draws d(881);
    support::hover_options options;
    options.uncertain_starts = true;
    options.share = 0.3;
    auto const problem = support::hovercraft_campaign(d, {}, options);
    std::vector<std::vector<double>> knots(5, {0, 0.1, 0.2, 5});
    approximate_campaign c(problem, knots);
    c.release({2}, {true, false, true});
    CHECK(c.free_parameters() == std::vector<std::size_t>{0, 2});
    CHECK(c.local_sizes() == std::vector<Eigen::Index>(5, 3 + 4));
    CHECK(c.free_starts(3) == 3);
    auto z = arrow_vector::like(c.lower(), 0);
    z.for_each(
        [](double& v, double lo, double hi) { v = std::isfinite(lo) ? 0.4 * lo + 0.6 * hi : 0.1; },
        c.lower(), c.upper());
    residual_lists r, up, down;
    REQUIRE(c.linearise(z, r));
    CHECK(r[0].size() == problem.experiments[0].measurements.size());
    CHECK(c.disturbance(1, z).size() == 4);
    std::vector<Eigen::MatrixXd> j;
    for (std::size_t e = 0; e < 5; ++e) j.emplace_back(c.derivatives(e));
    c.set_accuracy(1e-4);
    for (Eigen::Index k = 0; k < 9; ++k) {
        auto high = z, low = z;
        double const h = 1e-5;
        (k < 2 ? high.global[k] : high.local[4][k - 2]) += h;
        (k < 2 ? low.global[k] : low.local[4][k - 2]) -= h;
        REQUIRE(c.residuals(high, up));
        REQUIRE(c.residuals(low, down));
        for (std::size_t i = 0; i < r[4].size(); ++i) {
            double const slope = (up[4][i] - down[4][i]) / (2 * h);
            CHECK(std::abs(j[4](static_cast<Eigen::Index>(i), k) - slope) <
                  1e-3 * (1 + std::abs(slope)));
        }
    }
    simulated_trace seen;
    REQUIRE(c.trace(0, z, seen));
    CHECK(seen.times.size() == seen.rates.size());
}
