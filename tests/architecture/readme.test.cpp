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

TEST_CASE("the guide's blocks are parts of programs that are compiled", "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const guide = text_of_file(root / "docs/your_own_robot.md");
    std::string const fence = "```cpp\n";
    std::size_t blocks = 0;
    for (auto at = guide.find(fence); at != std::string::npos; at = guide.find(fence, at + 1)) {
        auto const marker = guide.rfind("<!-- ", at);
        REQUIRE(marker != std::string::npos);
        auto const file = guide.substr(marker + 5, guide.find(" -->", marker) - marker - 5);
        auto const begin = at + fence.size();
        auto const block = guide.substr(begin, guide.find("```\n", begin) - begin);
        INFO(file << "\n" << block);
        CHECK(guide.substr(marker, at - marker) == "<!-- " + file + " -->\n");
        CHECK(text_of_file(root / file).find(block) != std::string::npos);
        ++blocks;
    }
    CHECK(blocks >= 6);
}
