// SPDX-License-Identifier: MIT
#include <sivid/paving/identify_options.hpp>

#include "support/catch.hpp"

TEST_CASE("identification contracts, draws what it finds, and begins at the beginning") {
    sivid::identify_options const o;
    CHECK(o.algorithm == sivid::algorithm::contracting);
    CHECK_FALSE(o.only_hulls);
    CHECK(o.drawn_boxes > 0);
    CHECK_FALSE(o.checkpoint);
    CHECK(o.resume == nullptr);
}
