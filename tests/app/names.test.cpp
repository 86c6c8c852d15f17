// SPDX-License-Identifier: MIT
#include <sivid/app/names.hpp>

#include "support/catch.hpp"

#include <string>
#include <vector>

using namespace sivid::app;

TEST_CASE("an unknown name is refused with the nearest one") {
    std::vector<std::string> const known{"identify", "diagnose", "describe", "design"};
    CHECK(suggestion("diagnos", known) == ", did you mean 'diagnose'?");
    CHECK_NOTHROW(require_known("design", known, "command"));
    CHECK_THROWS_WITH(require_known("diagnse", known, "command"),
                      ContainsSubstring("unknown command 'diagnse', did you mean 'diagnose'?") &&
                          ContainsSubstring("there are: identify"));
}
