// SPDX-License-Identifier: MIT
#include <sivid/io/result/stored_identification.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a motion is stated with the weights of its parameters in the order of their names") {
    CHECK(io_detail::motion_claim("scaling", {{"Sg", -1}, {"L", 1}}) == "scaling L 1 Sg -1");
    CHECK(io_detail::motion_claim("shift", {}) == "shift");
}
