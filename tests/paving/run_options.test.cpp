// SPDX-License-Identifier: MIT
#include <sivid/paving/run_options.hpp>

#include "support/catch.hpp"

TEST_CASE("experiments run with polynomial sets, and give up late enough for cuts to work") {
    sivid::run_options const o;
    CHECK(o.set == sivid::carried_set::taylor_model);
    CHECK(o.enclosure.minimum_step > 0);
    CHECK(o.hopeless > 1); // an output that says something is kept
}
