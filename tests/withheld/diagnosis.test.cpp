// SPDX-License-Identifier: MIT
// The sealed check in short: a few campaigns are drawn, diagnosed without their labels, and scored.
#include "io/support.hpp"
#include "support/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#ifdef HOVERCRAFT_PROGRAM

namespace fs = std::filesystem;

namespace {

int shell(std::string const& command) { return std::system(command.c_str()); }
std::string quoted(fs::path const& p) { return "\"" + p.string() + "\""; }

} // namespace

TEST_CASE("campaigns whose effect is withheld are diagnosed, and nothing false is proved") {
    io_support::temporary_folder const folder;
    auto const& at = folder.path();
    REQUIRE(shell("\"" WITHHELD_GENERATE "\" --seed 77 --count 5 --out " +
                  quoted(at / "campaigns") + " --labels " + quoted(at / "labels.tsv") + " > " +
                  quoted(at / "log.txt")) == 0);
    for (auto const& campaign : fs::directory_iterator(at / "campaigns")) {
        INFO(campaign.path().filename());
        CHECK(shell("\"" HOVERCRAFT_PROGRAM "\" diagnose " + quoted(campaign.path()) +
                    " --quiet --out " + quoted(at / "results" / campaign.path().filename()) +
                    " > " + quoted(at / "log.txt")) == 0);
    }
    // Ends with 1 on any false proof.
    REQUIRE(shell("\"" WITHHELD_SCORE "\" --labels " + quoted(at / "labels.tsv") + " --results " +
                  quoted(at / "results") + " --data " + quoted(at / "campaigns") + " > " +
                  quoted(at / "score.txt")) == 0);
    std::ifstream score(at / "score.txt");
    std::string const text{std::istreambuf_iterator<char>(score), {}};
    INFO(text);
    CHECK_THAT(text, ContainsSubstring("false proofs by kind: none"));
    CHECK_THAT(text, ContainsSubstring("5/5 100%"));
}

#endif
