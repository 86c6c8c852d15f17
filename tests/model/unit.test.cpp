// SPDX-License-Identifier: MIT
#include <sivid/model/unit.hpp>

#include "support/catch.hpp"

using sivid::unit;

TEST_CASE("units are read, multiplied and written") {
    CHECK(unit("kg m^2/s").text() == "kg m^2/s");
    CHECK(unit("m kg m/s").text() == "kg m^2/s");
    CHECK(unit("1").text() == "1");
    CHECK(unit("").text() == "1");
    CHECK(unit("1/s").text() == "1/s");
    CHECK(unit("1/(m s)").text() == "1/(m s)");
    CHECK(unit("m/s/s").text() == "m/s^2");
    CHECK(unit("s^-2 m").text() == "m/s^2");
    CHECK(unit("m") == unit("m^1"));
    CHECK(unit("m/m").text() == "1");
    CHECK(unit("kg m/s").times(unit("s"), 1).text() == "kg m");
    CHECK(unit("m^2").times(unit("m"), -2).text() == "1");
    CHECK(unit("m").times(unit("kg/s^2"), 3).text() == "kg^3 m/s^6");
    CHECK_FALSE(unit("m") == unit("s"));
}

TEST_CASE("what is written is read again") {
    for (auto const* text : {"kg m^2/s", "1/(m s^2)", "A/(V s)", "rad", "1", "kg^3 m/s^6"}) {
        CHECK(unit(unit(text).text()) == unit(text));
    }
}
