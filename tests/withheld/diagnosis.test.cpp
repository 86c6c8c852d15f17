// SPDX-License-Identifier: MIT
// The sealed check in short: a few campaigns are drawn, diagnosed without their labels, and scored.
#include "io/support.hpp"
#include "support/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>

#ifdef HOVERCRAFT_PROGRAM

namespace fs = std::filesystem;

namespace {

int shell(std::string const& command) { return std::system(command.c_str()); }
std::string quoted(fs::path const& p) { return "\"" + p.string() + "\""; }

/// Draws campaigns, diagnoses them, scores them.
/// @returns whether the scorer ended with 0: with any false proof or contradiction it does not
bool diagnosed(fs::path const& at, std::string const& which, std::string& score) {
    REQUIRE(shell("\"" WITHHELD_GENERATE "\" " + which + " --out " + quoted(at / "campaigns") +
                  " --labels " + quoted(at / "labels.tsv") + " > " + quoted(at / "log.txt")) == 0);
    for (auto const& campaign : fs::directory_iterator(at / "campaigns")) {
        INFO(campaign.path().filename());
        int const ended = shell(
            "\"" HOVERCRAFT_PROGRAM "\" diagnose " + quoted(campaign.path()) + " --quiet --out " +
            quoted(at / "results" / campaign.path().filename()) + " > " + quoted(at / "log.txt"));
        CHECK((WEXITSTATUS(ended) == 0 || WEXITSTATUS(ended) == 3)); // 3: something is left open
    }
    bool const passed = shell("\"" WITHHELD_SCORE "\" --labels " + quoted(at / "labels.tsv") +
                              " --results " + quoted(at / "results") + " --data " +
                              quoted(at / "campaigns") + " > " + quoted(at / "score.txt")) == 0;
    std::ifstream text(at / "score.txt");
    score.assign(std::istreambuf_iterator<char>(text), std::istreambuf_iterator<char>{});
    return passed;
}

void all_right(std::string const& which, std::string const& right) {
    io_support::temporary_folder const folder;
    std::string score;
    bool const passed = diagnosed(folder.path(), which, score);
    INFO(score);
    CHECK(passed);
    CHECK_THAT(score, ContainsSubstring("false proofs by kind: none"));
    CHECK_THAT(score, ContainsSubstring(right));
}

} // namespace

TEST_CASE("campaigns whose effect is withheld are diagnosed, and nothing false is proved") {
    all_right("--seed 77 --count 1 --families single", "1/1 100%");
}
TEST_CASE("campaigns of five families are diagnosed, and nothing false is proved", "[.long]") {
    all_right("--seed 77 --count 5 --families single,weak,wide,pair,none", "5/5 100%");
}

TEST_CASE("nothing false is proved where the rudder moves between samples", "[.long]") {
    io_support::temporary_folder const folder;
    std::string score;
    bool const passed = diagnosed(folder.path(), "--seed 3 --count 2 --families alias", score);
    INFO(score);
    CHECK(passed);
    CHECK_THAT(score, ContainsSubstring("false proofs by kind: none"));
    CHECK_THAT(score, ContainsSubstring("contradictions by kind: none"));
}

#endif
