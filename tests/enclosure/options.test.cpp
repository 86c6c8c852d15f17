// SPDX-License-Identifier: MIT
#include <sivid/enclosure/options.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("an enclosure is cancelled when who is asked says so and never when nobody is") {
    enclosure_options options;
    CHECK_FALSE(options.cancelled());
    bool go = true;
    options.keep_going = [&go] { return go; };
    CHECK_FALSE(options.cancelled());
    go = false;
    CHECK(options.cancelled());
    CHECK(enclosure_options{options}.cancelled());
}
