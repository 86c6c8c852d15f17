// SPDX-License-Identifier: MIT
#include <sivid/paving/identification.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;

TEST_CASE("an identification begins with nothing proved and all of the prior left") {
    box const prior{support::between(1, 2), support::between(-1, 1)};
    identification const fresh(prior);
    CHECK(fresh.verdict == verdict::undecided);
    CHECK(subset(prior, fresh.hull));
    CHECK(subset(fresh.hull, prior));
    CHECK_FALSE(fresh.witness);
    CHECK(fresh.paving.inner_volume().upper() == 0);
    CHECK_FALSE(fresh.fewest);
}
