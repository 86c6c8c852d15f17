// SPDX-License-Identifier: MIT
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/requirement/requirement_types.hpp>

#include "support/catch.hpp"

#include <string>

using Catch::Matchers::ContainsSubstring;

TEST_CASE("an error in a requirement says where it is, what is wrong, and what to do") {
    sivid::requirement_error const e("requirement", "u > : 3", 4, "no number", "write one");
    CHECK(e.position() == 4);
    std::string const text = e.what();
    CHECK_THAT(text, ContainsSubstring("requirement: character 5") && ContainsSubstring("': 3'") &&
                         ContainsSubstring("behind 'u > '") && ContainsSubstring("no number") &&
                         ContainsSubstring("write one"));
}
