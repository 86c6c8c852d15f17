// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/missing_rate_scales.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("rates are as large as they are along the motion, for a second to twenty seconds") {
    auto const p = small_campaign::problem();
    CHECK(rate_time(p) == 1); // four seconds
    campaign c(p);
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
