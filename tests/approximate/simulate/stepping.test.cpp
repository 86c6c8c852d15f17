// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/stepping.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a state is assigned from expressions and keeps its size otherwise") {
    simulation_state const a = simulation_state::Constant(3, 2.0);
    simulation_state b;
    b = 0.5 * a + simulation_state::Ones(3);
    CHECK(b == simulation_state::Constant(3, 2.0));
    b.conservativeResize(5);
    CHECK(b[2] == 2);
}
