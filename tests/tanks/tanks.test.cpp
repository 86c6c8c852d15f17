// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "effects.hpp"
#include "io/support.hpp"
#include "model.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/affected_problem.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using support::run_program;
using support::text_of;

namespace {

fs::path real_record() { return fs::path{SIVID_MEASURED_DATA} / "cascaded_tanks"; }

/// A record of so many samples with the pump at one voltage.
std::string constant_record(double voltage, int samples) {
    std::string text = "t_s,pump_voltage_V,level_lower_tank_V\n";
    for (int k = 0; k < samples; ++k) {
        text += std::to_string(4 * k) + "," + std::to_string(voltage) + ",5.0\n";
    }
    return text;
}

} // namespace

TEST_CASE("the outflow is a square root, and stays defined where a tank runs dry", "[tanks]") {
    temporary_folder const folder;
    auto const file = folder.path() / "dry.csv";
    std::ofstream{file} << constant_record(0, 300);
    tanks::diagnose_command c;
    auto const problem = tanks::tank_problem(tanks::read_experiment(file, c));
    // No pump: both tanks drain, and every level stays finite.
    auto const fit = sivid::approximate_fitter(problem).at({0.1, 0.1, 0.05}, {{6, 5}});
    REQUIRE(fit.residuals.size() == 1);
    double const last = 5 + 0.2 * fit.residuals[0].back();
    CHECK(std::abs(last) < 0.01);
    for (double const x : {1.0, 4.0, 9.0}) {
        CHECK_THAT(x / std::sqrt(std::sqrt(x * x + 1e-4)), WithinRel(std::sqrt(x), 3e-5));
    }
}

TEST_CASE("water over a rim is lost but for its share", "[tanks]") {
    temporary_folder const folder;
    auto const file = folder.path() / "full.csv";
    std::ofstream{file} << constant_record(5, 600);
    tanks::diagnose_command c;
    auto const base = tanks::tank_problem(tanks::read_experiment(file, c));
    auto const problem = sivid::affected(base, {tanks::overflow()});
    // Inflow 0.25 V/s; the upper tank would settle at 25 V. With a rim at 9 V it spills 0.1 V/s.
    auto const level = [&](double share) {
        auto const fit =
            sivid::approximate_fitter(problem).at({0.05, 0.09, 0.05, 9, share, 19}, {{6, 5}});
        return 5 + 0.2 * fit.residuals.at(0).back();
    };
    auto const root = [](double inflow) { return std::pow(inflow / 0.09, 2); };
    CHECK_THAT(level(0), WithinAbs(root(0.05 * std::sqrt(9.2)), 0.05));
    CHECK_THAT(level(1), WithinAbs(root(0.25), 0.05));
}

TEST_CASE("the real tanks: where, which, and what stays", "[.long][measured]") {
    if (!fs::exists(real_record() / "validation.csv"))
        SIVID_SKIP("no records of the tanks in '" << real_record().string()
                                                  << "' (see docs/tanks.md)");
    temporary_folder const folder;
    auto const out = folder.path() / "out";
    REQUIRE(run_program(TANKS_PROGRAM, {real_record().string(), "--quiet", "--out", out.string()})
                .code == 0);
    auto const d = nlohmann::json::parse(text_of(out / "diagnosis.json"));
    CHECK(d["gap"]["verdict"] == "certified");
    CHECK_FALSE(d["interrupted"]);
    CHECK(d["answer"]["kind"] == "unexplained");
    // The first overflow begins about 560 s; the sensor is full from 600 s on.
    bool there = false;
    for (auto const& w : d["where"]) there = there || (w["from"] < 640 && w["to"] > 540);
    CHECK(there);
    auto const closest = d["remainder"]["effects"];
    CHECK(std::find(closest.begin(), closest.end(), "overflow") != closest.end());
    CHECK(closest.size() == 2);
    CHECK_FALSE(d["remainder"]["where"].empty());
    CHECK(d["causes"][0]["holdout"]["rmse_before"]["y"] < 0.80);
    CHECK(d["causes"][0]["holdout"]["rmse_after"]["y"] < 1.1 * 0.329);
    auto const page = text_of(out / "report.html");
    CHECK_THAT(page, ContainsSubstring("What stays unexplained"));
    CHECK_THAT(page, ContainsSubstring("an unexplained remainder of"));
    CHECK_THAT(page, ContainsSubstring("How long the model holds"));
}

TEST_CASE("bad input gives one message and exit code 2", "[tanks]") {
    temporary_folder const folder;
    std::ofstream{folder.path() / "bad.csv"} << "t_s,pump_voltage_V\n0,1\n";
    auto const refused = [&](std::vector<std::string> arguments, std::string const& reason) {
        arguments.insert(arguments.end(), {"--out", (folder.path() / "out").string()});
        auto const r = run_program(TANKS_PROGRAM, arguments);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring(reason));
    };
    refused({(folder.path() / "nowhere").string()}, "nowhere");
    refused({folder.path().string(), "--file", "bad.csv"}, "level_lower_tank_V");
    refused({folder.path().string(), "--bound", "0"}, "--bound");
    CHECK_FALSE(fs::exists(folder.path() / "out"));
}
