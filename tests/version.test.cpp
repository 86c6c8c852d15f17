// SPDX-License-Identifier: MIT
#include <sivid/version.hpp>

#include "support/catch.hpp"

#include <fstream>
#include <string>

TEST_CASE("the version text agrees with its numbers and with the change log") {
    std::string const numbers = std::to_string(SIVID_VERSION_MAJOR) + "." +
                                std::to_string(SIVID_VERSION_MINOR) + "." +
                                std::to_string(SIVID_VERSION_PATCH);
    CHECK(sivid::version == numbers);

    std::ifstream log{SIVID_SOURCE_DIR "/CHANGELOG.md"};
    REQUIRE(log);
    std::string line;
    bool listed = false;
    while (std::getline(log, line)) listed = listed || line.rfind("## [" + numbers + "]", 0) == 0;
    CHECK(listed);
}
