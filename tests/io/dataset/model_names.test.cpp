// SPDX-License-Identifier: MIT
#include <sivid/io/dataset/model_names.hpp>
#include <sivid/number/text/joined.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

TEST_CASE("names are found by their exact text") {
    auto const names = io_support::hovercraft_names();
    CHECK(sivid::index_of(names.constants, "Sv") == 8u);
    CHECK(sivid::index_of(names.inputs, "delta") == 1u);
    CHECK_FALSE(sivid::index_of(names.constants, "sv"));
    CHECK_FALSE(sivid::index_of(names.constants, ""));
    CHECK(sivid::joined_names(names.inputs) == "W, delta");
}

TEST_CASE("the names come from a model's description, in its order") {
    sivid::model_description model;
    model.name = "tank";
    model.states = {{"h1", "m", 2}, {"h2", "m", 3}};
    model.inputs = {{"pump", "V"}};
    model.channels = {{"level", "m"}};
    model.constants = {{"k", "m^2", {}}, {"a", "", {}}};
    auto const names = sivid::names_of(model);
    CHECK(names.name == "tank");
    CHECK(sivid::joined_names(names.states) == "h1, h2");
    CHECK(sivid::joined_names(names.inputs) == "pump");
    CHECK(sivid::joined_names(names.channels) == "level");
    CHECK(sivid::joined_names(names.constants) == "k, a");
    CHECK(names.constants[0].unit == "m^2");
    REQUIRE(names.state_ranges.size() == 2);
    CHECK((sivid::lower(names.state_ranges[1]) == -3 && sivid::upper(names.state_ranges[1]) == 3));
}
