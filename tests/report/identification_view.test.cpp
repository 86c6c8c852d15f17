// SPDX-License-Identifier: MIT
#include "report/hovercraft_view.hpp"
#include "support/catch.hpp"

#include <sivid/report/identification_view.hpp>

using namespace sivid::report;

TEST_CASE("identification view: an empty one claims nothing") {
    identification_view const v;
    CHECK(v.verdict == outcome::undecided);
    CHECK(is_empty(v.volume_inner));
    CHECK(is_empty(v.volume_outer));
    CHECK_FALSE(v.witness);
    CHECK(is_empty(parameter_view{}.hull));
    CHECK(projected_box{}.verdict == region::undecided);
}

TEST_CASE("identification view: the made-up campaign moves like the reference") {
    auto const end = sivid_tests::hovercraft_motion(3, 600).back();
    double const expected[6] = {-1.184, 1.463, -0.315, 7.717, 1.581, -2.356};
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK_THAT(end[i], WithinAbs(expected[i], 2e-3));
    }
}
