// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/relation_finding.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("findings begin with nothing proved") {
    relation_finding const f;
    CHECK_FALSE(f.proved);
    CHECK(f.windows.empty());
    CHECK_FALSE(f.missing);
    CHECK(relation_window{"S", 0, 1} == relation_window{"S", 0, 1});
    CHECK_FALSE(relation_window{"S", 0, 1} == relation_window{"T", 0, 1});
    relation_options const options;
    CHECK(options.shortest_gaps >= 1);
    CHECK(options.shortest_share < 1);
    CHECK(options.least_margin > 0);
}
