// SPDX-License-Identifier: MIT
#include <sivid/enclosure/normalised_unknowns.hpp>

#include "support/catch.hpp"

#include <sivid/space/box.hpp>

using namespace sivid;

TEST_CASE("sides with a width are variables, parameters before starts") {
    normalised_unknowns const u(box{interval(1.0), interval(0.0, 2.0)},
                                box{interval(-3.0, -1.0), interval(5.0)});
    CHECK(u.variables == 2);
    CHECK(u.parameters[0].variable == 0);
    CHECK(u.parameters[0].centre == -2);
    CHECK(u.parameters[0].radius == 1);
    CHECK(u.parameters[1].radius == 0);
    CHECK(u.initial[0].radius == 0);
    CHECK(u.initial[1].variable == 1);
    CHECK(u.initial[1].centre == 1);
}

TEST_CASE("decimals get no variable, and their width is kept") {
    double const upper = 0.1 * (1 + 4e-16);
    normalised_unknowns const u(box{}, box{interval(0.1, upper)});
    CHECK(u.variables == 0);
    CHECK(u.parameters[0].radius == 0);
    CHECK(u.parameters[0].centre - u.parameters[0].rest <= 0.1);
    CHECK(u.parameters[0].centre + u.parameters[0].rest >= upper);
}
