// SPDX-License-Identifier: MIT
#include <sivid/number/text/nearest_name.hpp>

#include "support/catch.hpp"

#include <string>
#include <vector>

using sivid::letters_apart;
using sivid::nearest_name;

TEST_CASE("letters that are put in, left out, replaced or interchanged count one each") {
    CHECK(letters_apart("", "abc") == 3);
    CHECK(letters_apart("wind", "wind") == 0);
    CHECK(letters_apart("wnd", "wind") == 1);
    CHECK(letters_apart("winnd", "wind") == 1);
    CHECK(letters_apart("wond", "wind") == 1);
    CHECK(letters_apart("wnid", "wind") == 1);
    CHECK(letters_apart("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is one of which at most a third of the letters is wrong") {
    std::vector<std::string> const known{"identify", "diagnose", "describe", "design"};
    CHECK(nearest_name("identfy", known) == "identify");
    CHECK(nearest_name("desgin", known) == "design");
    CHECK(nearest_name("fly", known).empty());
    CHECK(nearest_name("", known).empty());
    CHECK(nearest_name("x", {"y"}) == "y"); // one letter may always be wrong
    CHECK(nearest_name(std::string(5'000'000, 'x'), known).empty());
    CHECK(nearest_name("design", {std::string(5'000'000, 'd')}).empty());
}
