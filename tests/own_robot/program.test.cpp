// SPDX-License-Identifier: MIT
// A robot's program from its log to a control law.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;

namespace {

support::finished_program run(std::vector<std::string> const& arguments) {
    return support::run_program(OWN_ROBOT_PROGRAM, arguments);
}

} // namespace

TEST_CASE("from a robot's log to gains that are proved for all that it leaves", "[robot]") {
    temporary_folder const folder;
    auto const data = (folder.path() / "data").string(), out = (folder.path() / "out").string();
    auto const mapping = std::string{SIVID_SOURCE_DIR} + "/examples/own_robot/mapping.json";
    REQUIRE(run({"import", mapping, "--out", data}).code == 0);
    auto const found = run({"diagnose", data, "--out", out, "--budget", "20", "--quiet"});
    CHECK_THAT(found.out, ContainsSubstring("dry_friction"));
    auto const result = out + "/model";
    REQUIRE(fs::exists(result + "/result.json"));
    CHECK(run({"report", result, "--out", (folder.path() / "page").string()}).code == 0);
    folder.write("push.json",
                 R"({ "format": "sivid-scenario-1", "name": "push", "duration": 0.5,
                      "initial": { "theta": 0, "w": 5 },
                      "inputs": { "u": { "shape": "constant", "value": 4 } } })");
    auto const scenario = (folder.path() / "push.json").string();
    auto const asked = [&](char const* what, std::vector<std::string> more) {
        std::vector<std::string> all{what,      result,     "--scenario", scenario,
                                     "--quiet", "--budget", "25"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    auto const proved = asked("verify", {"--require", "theta at end in [1, 5]"});
    CHECK(proved.code == 0);
    CHECK(asked("verify", {"--require", "theta at end > 9"}).code == 5);
    auto const tubes = asked("predict", {"--out", (folder.path() / "tubes").string()});
    CHECK(tubes.code == 0);
    auto const gains = (folder.path() / "gains").string();
    auto const law = asked("control", {"--law", "u = K", "--gain", "K=1:12", "--require",
                                       "theta at end in [2, 3]", "--out", gains});
    CHECK(law.code == 0);
    CHECK_THAT(law.out, ContainsSubstring("push, geared motor: gains are proved"));
    CHECK(fs::exists(gains + "/control.html"));
    CHECK(asked("control", {"--law", "u = K", "--gain", "K=1:12", "--require", "theta at end > 99"})
              .code == 5);
    CHECK(asked("control", {"--require", "theta > 0"}).code == 2);
    auto const next = (folder.path() / "next").string();
    auto const experiment =
        asked("design", {"--halve", "a", "--share", "1", "--vary", "u=1:12", "--out", next});
    CHECK(experiment.code == 0);
    CHECK_THAT(experiment.out, ContainsSubstring("an experiment for a is found"));
    CHECK(fs::exists(next + "/design.html"));
    CHECK(run({"verify", result, "--scenario", next + "/scenario.json", "--require",
               "theta at end in [-99, 99]", "--quiet"})
              .code == 0);
    CHECK(
        run({"rank", data, "--out", (folder.path() / "rank").string(), "--budget", "2", "--quiet"})
            .code != 2);
}
