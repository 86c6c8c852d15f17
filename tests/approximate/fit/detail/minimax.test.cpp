// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/minimax.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

using namespace sivid;
using support::draws;

TEST_CASE("Chebyshev steps end at an optimum: no point nearby is better") {
    draws d(883);
    for (bool const uncertain : {false, true}) {
        auto const problem = support::hovercraft_campaign(
            d, {}, {.truth = {{"D22", 0.25}}, .uncertain_starts = uncertain, .share = 0.5});
        approximate_campaign c(problem);
        descent down(c);
        auto z = c.lower();
        z.for_each([](double& v, double hi) { v = 0.5 * (v + hi); }, c.upper());
        descent_point here;
        REQUIRE(down.evaluate(z, here));
        down.run(here, 2, {}, {});
        double const squares = here.inflation;
        auto unit = c.upper();
        unit.for_each([](double& u, double lo) { u -= lo; }, c.lower());
        minimax(c).run(here, unit, {.rounds = 20, .enough = 1e-4});
        CHECK(here.inflation < squares);
        for (int trial = 0; trial < 300; ++trial) {
            auto near = here.at;
            double const size = std::pow(10, d.uniform(-4, -1));
            near.for_each([&](double& v, double u) { v += size * u * d.uniform(-1, 1); }, unit);
            descent_point other;
            REQUIRE(down.evaluate(near, other));
            CHECK(other.inflation > 0.995 * here.inflation);
        }
    }
}
