// SPDX-License-Identifier: MIT
// The program as a user runs it: exit codes, files, messages, Ctrl-C.
#include "io/support.hpp"
#include "simulated_axis.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using support::text_of;

namespace {

class child : public support::child_program {
public:
    child(std::vector<std::string> arguments, fs::path const& folder)
        : child_program(SERVO_AXIS_PROGRAM, std::move(arguments), folder) {}
};

double side(nlohmann::json const& result, char const* name, int end) {
    return result["parameters"][name]["hull"][static_cast<std::size_t>(end)];
}
bool covers(nlohmann::json const& result, char const* name, double value) {
    return side(result, name, 0) <= value && value <= side(result, name, 1);
}
double width_of(nlohmann::json const& result, char const* name) {
    return side(result, name, 1) - side(result, name, 0);
}

/// A folder with the record of a simulated axis.
struct simulated_folder {
    temporary_folder folder;
    std::vector<double> truth{90, 210, 18, -4};
    simulated_folder() {
        std::ofstream{folder.path() / "estimation_200Hz.csv"}
            << servo_test::simulated_axis(truth, 7.0).csv();
    }
};

} // namespace

TEST_CASE("a simulated axis is identified", "[servo_axis][program]") {
    simulated_folder const data;
    auto const out = data.folder.path() / "out";
    child const c({data.folder.path().string(), "--out", out.string(), "--accuracy", "0.06",
                   "--budget", "120"},
                  data.folder.path());
    int const code = c.wait();
    INFO(c.err());
    REQUIRE(code == 0);
    auto const result = nlohmann::json::parse(text_of(out / "result.json"));
    CHECK(result["format"] == "sivid-identification-1");
    CHECK(result["verdict"] == "consistent");
    CHECK(covers(result, "M", data.truth[0]));
    CHECK(covers(result, "F_v", data.truth[1]));
    CHECK(covers(result, "F_c", data.truth[2]));
    CHECK(covers(result, "offset", data.truth[3]));
    CHECK(width_of(result, "M") < 75);
    CHECK(result["witness"]["initial"].size() == 3);
    std::string assumptions;
    for (auto const& a : result["assumptions"]) assumptions += a.get<std::string>() + "\n";
    CHECK_THAT(assumptions, ContainsSubstring("inputs exact"));
    CHECK_THAT(assumptions, ContainsSubstring("force linear between samples"));
    CHECK_THAT(assumptions, ContainsSubstring("position bound 3 mm stands for the model error"));
    CHECK_THAT(c.err(), ContainsSubstring("not excluded"));
    CHECK_THAT(text_of(out / "report.html"), ContainsSubstring("Beside the literature"));
    CHECK(fs::exists(out / "boxes.csv"));
    CHECK(fs::exists(out / "outputs.csv"));
}

TEST_CASE("a bound that is too small is refuted", "[servo_axis][program]") {
    // A constant force of 60 N more than the record says is beyond the prior of the offset.
    simulated_folder const data;
    auto axis = servo_test::simulated_axis(data.truth, 7.0);
    for (auto& f : axis.force) f += 60;
    std::ofstream{data.folder.path() / "shifted.csv"} << axis.csv();
    auto const out = data.folder.path() / "out";
    child const c({data.folder.path().string(), "--file", "shifted.csv", "--out", out.string(),
                   "--budget", "120", "--quiet"},
                  data.folder.path());
    CHECK(c.wait() == 4);
    CHECK(c.err().empty());
    auto const result = nlohmann::json::parse(text_of(out / "result.json"));
    CHECK(result["verdict"] == "inconsistent");
    CHECK(result["parameters"]["M"]["hull"].is_null());
}

TEST_CASE("no time: what is left is pending, and the verdict is still sound",
          "[servo_axis][program]") {
    simulated_folder const data;
    auto const out = data.folder.path() / "out";
    child const c({data.folder.path().string(), "--out", out.string(), "--budget", "0"},
                  data.folder.path());
    int const code = c.wait();
    auto const result = nlohmann::json::parse(text_of(out / "result.json"));
    CHECK(result["stop_reason"] == "time budget spent");
    CHECK(result["volume"]["outer"][1] == 1.0);
    CHECK(code == (result["verdict"] == "consistent" ? 0 : 3));
}

TEST_CASE("Ctrl-C ends with what is proved until then", "[servo_axis][program]") {
    simulated_folder const data;
    auto const out = data.folder.path() / "out";
    child const c({data.folder.path().string(), "--out", out.string(), "--accuracy", "1e-5",
                   "--budget", "600"},
                  data.folder.path());
    for (int i = 0; i < 1200 && c.err().find("not excluded") == std::string::npos; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    c.signal(SIGINT);
    CHECK(c.wait() == 0);
    auto const result = nlohmann::json::parse(text_of(out / "result.json"));
    CHECK(result["stop_reason"] == "cancelled");
    CHECK(result["verdict"] == "consistent");
    CHECK(covers(result, "M", data.truth[0]));
}

TEST_CASE("bad input gives one message, exit code 2 and no output", "[servo_axis][program]") {
    simulated_folder const data;
    auto const folder = data.folder.path().string();
    auto const out = data.folder.path() / "out";
    std::vector<std::vector<std::string>> const cases{
        {folder + "/nowhere", "--out", out.string()},
        {folder, "--out", out.string(), "--file", "missing.csv"},
        {folder, "--out", out.string(), "--bound", "0"},
        {folder, "--out", out.string(), "--bound", "three"},
        {folder, "--out", out.string(), "--start-velocity", "-1"},
        {folder, "--out", out.string(), "--window", "20"},
        {folder, "--out", out.string(), "--first", "100"},
        {folder, "--out", out.string(), "--budget", "-1"},
        {folder},
        {"--out", out.string()},
        {folder, "--out", out.string(), "--unknown"}};
    for (auto const& arguments : cases) {
        child const c(arguments, data.folder.path());
        INFO(arguments.back());
        CHECK(c.wait() == 2);
        CHECK_FALSE(c.err().empty());
        CHECK_FALSE(fs::exists(out));
    }
}

TEST_CASE("the real axis: consistent, narrow hulls, the literature within", "[servo_axis][real]") {
    fs::path const data = fs::path{SIVID_MEASURED_DATA} / "emps";
    if (!fs::exists(data / "estimation_200Hz.csv"))
        SIVID_SKIP("no EMPS record in '" << data.string() << "' (see docs/servo_axis.md)");
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    child const c({data.string(), "--out", out.string(), "--accuracy", "0.06", "--budget", "200"},
                  folder.path());
    int const code = c.wait();
    INFO(c.err());
    REQUIRE(code == 0);
    auto const result = nlohmann::json::parse(text_of(out / "result.json"));
    CHECK(result["verdict"] == "consistent");
    CHECK(result["witness"]["initial"].size() == 12);
    CHECK(width_of(result, "M") <= 0.5 * 150);
    CHECK(width_of(result, "F_v") <= 0.5 * 450);
    CHECK(width_of(result, "F_c") <= 0.5 * 50);
    CHECK(covers(result, "M", 95.1089));
    CHECK(covers(result, "F_v", 203.5034));
    CHECK(covers(result, "F_c", 20.3935));
    CHECK(covers(result, "offset", -3.1648));
}
