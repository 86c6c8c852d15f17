// SPDX-License-Identifier: MIT
// Causes that a diagnosis cannot tell apart are told apart by the experiment that was designed for
// it, whichever of them the robot has; and the whole story, to a robot that obeys its laws.
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

#ifdef SIVID_SANITIZED
constexpr auto patience = " --budget 200";
#else
constexpr auto patience = " --budget 15";
#endif

std::string const source = SIVID_SOURCE_DIR;

struct told {
    bool well = false;
    std::string text;
};

/// A command and what it prints.
told shell(std::string const& command, fs::path const& log) {
    told result;
    result.well = std::system((command + " > \"" + log.string() + "\" 2>&1").c_str()) == 0;
    std::ifstream in(log);
    result.text.assign(std::istreambuf_iterator<char>{in}, {});
    return result;
}

std::string robot(fs::path const& labels) {
    return "\"" WITHHELD_ROBOT "\" --labels \"" + labels.string() + "\"";
}

told story(fs::path const& at, fs::path const& labels, fs::path const& data,
           std::string const& more) {
    return shell("\"" + source +
                     "/benchmarks/withheld/story\" --program \"" HOVERCRAFT_PROGRAM
                     "\" --robot \"" WITHHELD_ROBOT "\" --labels \"" +
                     labels.string() + "\" --dataset \"" + data.string() + "\" --out \"" +
                     (at / "story").string() + "\" " + more + patience,
                 at / "log.txt");
}

/// The robot makes a run, and the story goes on until one cause is left.
/// @param effect  as in labels
void told_apart(std::string const& effect, std::string const& constants,
                std::string const& scenario, std::string const& seed) {
    INFO(effect << ", " << constants << ", seed " << seed);
    io_support::temporary_folder const folder;
    auto const labels = folder.path() / "labels.tsv";
    std::ofstream(labels) << "case\tfamily\teffects\tparams\ncraft\tsingle\t" << effect << '\t'
                          << constants << '\n';
    auto const data = folder.path() / "data";
    auto const recorded =
        shell(robot(labels) + " --scenario \"" + source + "/examples/hovercraft/scenarios/" +
                  scenario + ".json\" --out \"" + data.string() + "\" --seed " + seed,
              folder.path() / "log.txt");
    INFO(recorded.text);
    REQUIRE(recorded.well);
    auto const tale = story(folder.path(), labels, data, "--until separated");
    INFO(tale.text);
    CHECK(tale.well);
    CHECK_THAT(tale.text, ContainsSubstring("not told apart from it: "));
    CHECK_THAT(tale.text, ContainsSubstring("Refuted, as was promised: "));
    CHECK_THAT(tale.text,
               ContainsSubstring("One cause is left: " + effect.substr(0, effect.find('(')) + "."));
}

} // namespace

TEST_CASE("two causes of too little speed are told apart, whichever it is", "[.long]") {
    told_apart("linear_surge_damping(0.3)", "Sv=0.23 Sg=0.042 L=0.31", "S1", "1");
    told_apart("thrust_loss_with_speed(0.06)", "Sv=0.214 Sg=0.051 L=0.28", "S1", "2");
    told_apart("linear_surge_damping(0.17)", "Sv=0.241 Sg=0.038 L=0.33", "S1", "3");
}

TEST_CASE("two causes of a turn that is not commanded are told apart, whichever it is, and a dead "
          "band from a trim",
          "[.long]") {
    told_apart("thrust_offset(0.002)", "Sv=0.23 Sg=0.042 L=0.31", "S3", "1");
    told_apart("dry_yaw_friction(0.003)", "Sv=0.23 Sg=0.042 L=0.31", "S3", "1");
    told_apart("rudder_deadband(0.03)", "Sv=0.23 Sg=0.042 L=0.31", "S3", "1");
}

TEST_CASE("the bundled story ends with a robot that obeys laws that were proved", "[.long]") {
    io_support::temporary_folder const folder;
    auto const data = source + "/examples/hovercraft/data";
    auto const tale =
        story(folder.path(), data + "/labels.tsv", data + "/straight_run", "--case straight_run");
    INFO(tale.text);
    CHECK(tale.well);
    // The first answer was wrong; what was promised of the experiment came true.
    CHECK_THAT(tale.text, ContainsSubstring("answer: thrust_loss_with_speed"));
    CHECK_THAT(tale.text, ContainsSubstring("Refuted, as was promised: thrust_loss_with_speed."));
    CHECK_THAT(tale.text, ContainsSubstring("an experiment for Sv, Sg * L is found"));
    CHECK_THAT(tale.text, ContainsSubstring("quay, straight_run: gains are proved"));
    CHECK_THAT(tale.text, ContainsSubstring("S3, straight_run: gains are proved"));
    CHECK_THAT(tale.text, ContainsSubstring("abs(u) < 0.05 at the end, by 0.0"));
    CHECK_THAT(tale.text, ContainsSubstring("psi in [0.25, 0.75] at the end, by 0."));
    CHECK_THAT(tale.text, ContainsSubstring("abs(delta) < 0.6 always, by 0."));
    CHECK_THAT(tale.text, ContainsSubstring("the gap shrinks by"));
    CHECK(fs::file_size(folder.path() / "story" / "story.html") > 100000);
    // A robot that does not obey ends it: the same law on a heavier craft.
    std::ofstream(folder.path() / "heavy.tsv")
        << "case\tfamily\teffects\tparams\nheavy\tsingle\tpayload(0.2)\tSv=0.23 Sg=0.042 L=0.31\n";
    auto const heavy = shell(robot(folder.path() / "heavy.tsv") + " --scenario \"" + source +
                                 "/examples/hovercraft/scenarios/quay.json\" --law \"W = 137 * "
                                 "during(0, 1); delta = 0.102 * during(0, 1)\" --at-end \"(x - "
                                 "4)^2 + (y - 1)^2 < 0.04\"",
                             folder.path() / "log.txt");
    CHECK(!heavy.well);
    CHECK_THAT(heavy.text, ContainsSubstring("is violated"));
}

#endif
