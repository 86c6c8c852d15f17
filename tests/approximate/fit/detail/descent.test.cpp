// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/descent.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("descents lower the norm that they are told to") {
    draws d(882);
    auto const problem =
        support::hovercraft_campaign(d, {}, {.truth = {{"Sv", 0.24}}, .share = 0.5});
    approximate_campaign c(problem);
    descent down(c);
    auto z = c.lower();
    z.for_each([](double& v, double hi) { v = 0.5 * (v + hi); }, c.upper());
    descent_point here;
    REQUIRE(down.evaluate(z, here));
    auto const before = here;
    down.run(here, 2, {}, {});
    auto const norm = [](descent_point const& p, double power) {
        double sum = 0;
        for (auto const& e : p.residuals) {
            for (double const r : e) sum += std::pow(std::abs(r), power);
        }
        return sum;
    };
    CHECK(norm(here, 2) < norm(before, 2));
    auto const squares = here;
    down.run(here, 12, {}, {});
    CHECK(norm(here, 12) < norm(squares, 12));
    CHECK(here.inflation < squares.inflation);
    // A stiff regularisation keeps the disturbance away.
    std::vector<std::vector<double>> knots(5, {0, 10});
    approximate_campaign disturbed(problem, knots);
    disturbed.release({0}, {true, true, true});
    auto smooth = regularisation(5, Eigen::MatrixXd::Identity(2, 2) * 1e9);
    descent stiff(disturbed, smooth);
    z = arrow_vector::like(disturbed.lower(), 0);
    z.global = here.at.global;
    REQUIRE(stiff.evaluate(z, here));
    stiff.run(here, 2, {}, {});
    for (auto const& l : here.at.local) CHECK(l.norm() < 1e-3);
}
