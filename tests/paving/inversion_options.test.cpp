// SPDX-License-Identifier: MIT
#include <sivid/paving/inversion_options.hpp>

#include "support/catch.hpp"

TEST_CASE("by default a search ends and runs alone") {
    sivid::inversion_options const o;
    CHECK(o.accuracy > 0);
    CHECK(o.seconds > 0);
    CHECK(o.boxes > 0);
    CHECK(o.memory > 0);
    CHECK(o.batches == 1);
    CHECK(o.workers.threads == 1);
    CHECK_FALSE(o.checkpoint);
    CHECK_FALSE(o.resume);
}
