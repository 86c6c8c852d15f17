// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string text_of_file(std::filesystem::path const& file) {
    std::ifstream in{file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

} // namespace

TEST_CASE("the README's first program is the one that is compiled", "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const readme = text_of_file(root / "README.md");
    auto program = text_of_file(root / "examples/first_steps/main.cpp");
    program.erase(0, program.find('\n') + 1); // the licence line
    REQUIRE(program.size() > 500);
    CHECK(readme.find("```cpp\n" + program + "```") != std::string::npos);
    CHECK(std::count(program.begin(), program.end(), '\n') <= 40);
}
