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

TEST_CASE("the blocks of the guides are parts of programs that are compiled", "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    std::string const fence = "```cpp\n";
    for (std::string const page : {"docs/your_own_robot.md", "docs/guide.md"}) {
        auto const guide = text_of_file(root / page);
        std::size_t blocks = 0;
        for (auto at = guide.find(fence); at != std::string::npos; at = guide.find(fence, at + 1)) {
            auto const marker = guide.rfind("<!-- ", at);
            REQUIRE(marker != std::string::npos);
            auto const file = guide.substr(marker + 5, guide.find(" -->", marker) - marker - 5);
            auto const begin = at + fence.size();
            auto const block = guide.substr(begin, guide.find("```\n", begin) - begin);
            INFO(page << ", " << file << "\n" << block);
            CHECK(guide.substr(marker, at - marker) == "<!-- " + file + " -->\n");
            CHECK(text_of_file(root / file).find(block) != std::string::npos);
            ++blocks;
        }
        CHECK(blocks >= 5);
    }
}

TEST_CASE("each short program is whole in the guide, in at most 40 lines", "[readme]") {
    std::filesystem::path const root{SIVID_SOURCE_DIR};
    auto const guide = text_of_file(root / "docs/guide.md");
    std::size_t programs = 0;
    for (auto const& entry : std::filesystem::directory_iterator{root / "examples/short"}) {
        if (entry.path().extension() != ".cpp") continue;
        auto const program = text_of_file(entry.path());
        INFO(entry.path());
        CHECK(guide.find("```cpp\n" + program.substr(program.find('\n') + 1) + "```") !=
              std::string::npos);
        CHECK(std::count(program.begin(), program.end(), '\n') <= 40);
        ++programs;
    }
    CHECK(programs >= 4);
}
