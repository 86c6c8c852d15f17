// SPDX-License-Identifier: MIT
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

/// A record of so many samples of 4 s with the pump at one voltage.
sivid::identification_problem constant_record(double voltage, int samples) {
    sivid::experiment e{"S", {}, 0, {sivid::interval(0, 15), sivid::interval(4, 6)}, {}, 0};
    for (int k = 1; k < samples; ++k)
        e.measurements.push_back({4.0 * k, 0, sivid::interval(4.8, 5.2)});
    e.inputs = {sivid::sampled_signal({0.0}, {voltage}, sivid::interpolation::hold)};
    sivid::interval const prior(0.02, 0.1);
    return {sivid::record_model(cascaded_tanks{}),
            {{"k1", "k3", "k4"}, {}},
            {prior, prior, prior},
            {e}};
}
double last_level(sivid::identification_problem const& problem, std::vector<double> const& p) {
    auto const fit = sivid::approximate_fitter(problem).at(p, {{6, 5}});
    return 5 + 0.2 * fit.residuals.at(0).back();
}

} // namespace

TEST_CASE("the outflow is a square root, and stays defined where a tank runs dry", "[tanks]") {
    // No pump: both tanks drain, and every level stays finite.
    CHECK(std::abs(last_level(constant_record(0, 300), {0.1, 0.1, 0.05})) < 0.01);
    for (double const x : {1.0, 4.0, 9.0}) {
        CHECK_THAT(x / std::sqrt(std::sqrt(x * x + 1e-4)), WithinRel(std::sqrt(x), 3e-5));
    }
}

TEST_CASE("water over a rim is lost but for its share", "[tanks]") {
    auto const problem = sivid::affected(constant_record(5, 600), {tanks::overflow()});
    // Inflow 0.25 V/s; the upper tank would settle at 25 V. With a rim at 9 V it spills 0.1 V/s.
    auto const level = [&](double share) {
        return last_level(problem, {0.05, 0.09, 0.05, 9, share, 19});
    };
    auto const root = [](double inflow) { return std::pow(inflow / 0.09, 2); };
    CHECK_THAT(level(0), WithinAbs(root(0.05 * std::sqrt(9.2)), 0.05));
    CHECK_THAT(level(1), WithinAbs(root(0.25), 0.05));
}

TEST_CASE("the mapping of the tanks reads records of their form") {
    temporary_folder const folder;
    for (auto const* name : {"estimation.csv", "validation.csv"})
        std::ofstream{folder.path() / name} << "t_s,pump_voltage_V,level_lower_tank_V\n"
                                               "0,3.2567,5.205\n4,3.1,5.2\n8,3.0,5.1\n";
    fs::copy(fs::path{SIVID_SOURCE_DIR} / "examples/measured/tanks/mapping.json", folder.path());
    auto const r = run_program(TANKS_PROGRAM, {"import", (folder.path() / "mapping.json").string(),
                                               "--out", (folder.path() / "data").string()});
    INFO(r.err);
    CHECK(r.code == 0);
}

TEST_CASE("the real tanks: where, which, and what stays", "[.long][measured]") {
    auto const record = fs::path{SIVID_MEASURED_DATA} / "cascaded_tanks";
    if (!fs::exists(record / "validation.csv"))
        SIVID_SKIP("no records of the tanks in '" << record.string() << "' (see docs/machines.md)");
    temporary_folder const folder;
    for (auto const* name : {"estimation.csv", "validation.csv"})
        fs::copy(record / name, folder.path());
    fs::copy(fs::path{SIVID_SOURCE_DIR} / "examples/measured/tanks/mapping.json", folder.path());
    auto const data = (folder.path() / "data").string();
    auto const out = folder.path() / "out";
    REQUIRE(run_program(TANKS_PROGRAM,
                        {"import", (folder.path() / "mapping.json").string(), "--out", data})
                .code == 0);
    REQUIRE(run_program(TANKS_PROGRAM,
                        {"diagnose", data, "--quiet", "--budget", "600", "--out", out.string()})
                .code == 0);
    auto const d = nlohmann::json::parse(text_of(out / "diagnosis.json"));
    CHECK(d["gap"]["verdict"] == "certified");
    CHECK(d["answer"]["kind"] == "unexplained");
    // The first overflow begins about 560 s; the sensor is full from 600 s on.
    bool there = false;
    for (auto const& w : d["where"]) there = there || (w["from"] < 640 && w["to"] > 540);
    CHECK(there);
    auto const closest = d["remainder"]["effects"];
    CHECK(std::find(closest.begin(), closest.end(), "overflow") != closest.end());
    CHECK(d["causes"][0]["holdout"]["rmse_after"]["y"] <
          d["causes"][0]["holdout"]["rmse_before"]["y"]);
}
