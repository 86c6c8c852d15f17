// SPDX-License-Identifier: MIT
#include <sivid/enclosure/step/detail/tube_step.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/enclosure/tube.hpp>

using namespace sivid;
using support::between;

TEST_CASE("the steps of a tube follow each other without a gap") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * abs(x[0])) - 0.25};
        }));
    auto const tube = integrate<interval>(f, box{between(0.2, 0.3)}, box{between(0.9, 1.1)}, 0, 2);
    REQUIRE(tube.complete());
    REQUIRE(tube.steps().size() > 2);
    bool rough = false;
    bool smooth = false;
    double time = 0;
    for (auto const& s : tube.steps()) {
        CHECK(s.from == time);
        CHECK(s.to > s.from);
        CHECK(s.start.time == s.from);
        CHECK(subset(s.start.hull, s.tube));
        CHECK(subset(s.swept, s.tube));
        CHECK(s.variation.rows() == 1);
        CHECK(s.variation.cols() == 2);
        CHECK(s.variation.minCoeff() >= 0);
        CHECK_FALSE(s.jumps);
        rough = rough || !s.smooth;
        smooth = smooth || s.smooth;
        time = s.to;
    }
    CHECK(time == 2);
    CHECK(rough); // x passes through the kink
    CHECK(smooth);
}
