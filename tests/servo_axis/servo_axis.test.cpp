// SPDX-License-Identifier: MIT
#include "axis_effects.hpp"
#include "io/support.hpp"
#include "linear_axis.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"
#include "windows.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/bound_model.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using support::run_program;
using support::text_of;

namespace {

fs::path real_record() { return fs::path{SIVID_MEASURED_DATA} / "emps"; }

/// Seven seconds of an axis with M and F_v, under a force that changes its sign.
std::string simulated_record(std::vector<double> const& truth) {
    std::vector<double> time, force;
    for (int k = 0; k <= 1400; ++k) {
        time.push_back(k / 200.0);
        force.push_back(std::round(1e6 * std::sin(4.2 * k / 200.0)) / 1e4);
    }
    std::vector<sivid::signal> const inputs{
        sivid::sampled_signal(time, force, sivid::interpolation::linear)};
    auto const motion = sivid::simulate(
        std::make_shared<sivid::approximate_model const>(
            sivid::record_model(linear_axis{}), sivid::parameter_choice{{"M", "F_v"}, {}}, inputs),
        inputs, {0.1, 0.05}, truth, 0, time, {1e-11});
    std::string text = "force_N,extra,position_m,t_s\n"; // columns are found by their headings
    for (std::size_t k = 0; k < time.size(); ++k) {
        auto const q = sivid::exact_decimal::shortest(std::round(1e8 * motion.states[k][0]) / 1e8);
        text += sivid::exact_decimal::shortest(force[k]).text() + ",x," + q.text() + "," +
                sivid::exact_decimal::shortest(time[k]).text() + "\n";
    }
    return text;
}

} // namespace

TEST_CASE("the mapping of whole records reads records of their form") {
    temporary_folder const folder;
    for (auto const* name : {"estimation_200Hz.csv", "validation_200Hz.csv"})
        std::ofstream{folder.path() / name} << "t_s,motor_voltage_V,force_N,position_m\n"
                                               "0.000,2.5,89.2,0.00000745\n"
                                               "0.005,2.9,103.9,0.00004955\n";
    auto const mapping =
        std::filesystem::path{SIVID_SOURCE_DIR} / "examples/measured/servo_axis/whole_record.json";
    std::filesystem::copy(mapping, folder.path());
    auto const r =
        run_program(SERVO_AXIS_PROGRAM, {"import", (folder.path() / "whole_record.json").string(),
                                         "--out", (folder.path() / "data").string()});
    INFO(r.err);
    CHECK(r.code == 0);
}

TEST_CASE("the velocity filter is exact on cubics", "[servo_axis]") {
    servo::recording r;
    auto const motion = [](double t) { return 1 + 2 * t - 3 * t * t + 5 * t * t * t; };
    for (int k = 0; k <= 40; ++k) {
        r.time.push_back(sivid::exact_decimal::shortest(0.005 * k));
        r.position.push_back(sivid::exact_decimal::shortest(motion(0.005 * k)));
    }
    CHECK_THAT(servo::approximate_velocity(r, 20), WithinAbs(2 - 6 * 0.1 + 15 * 0.01, 1e-10));
}

TEST_CASE("a simulated axis is identified from its windows", "[servo_axis]") {
    temporary_folder const folder;
    std::vector<double> const truth{90, 210};
    folder.write("estimation_200Hz.csv", simulated_record(truth));
    auto const data = (folder.path() / "data").string(), out = (folder.path() / "out").string();
    REQUIRE(
        run_program(SERVO_AXIS_PROGRAM, {"windows", folder.path().string(), "--out", data}).code ==
        0);
    auto const found = run_program(SERVO_AXIS_PROGRAM,
                                   {"diagnose", data, "--out", out, "--budget", "20", "--quiet"});
    INFO(found.err);
    auto const result = nlohmann::json::parse(text_of(fs::path{out} / "model/result.json"));
    CHECK(result["verdict"] == "consistent");
    std::size_t j = 0;
    for (auto const* name : {"M", "F_v"}) {
        auto const hull = result["parameters"][name]["hull"];
        CHECK(hull[0].get<double>() <= truth[j]);
        CHECK(truth[j] <= hull[1].get<double>());
        CHECK(hull[1].get<double>() - hull[0].get<double>() < 0.3 * truth[j]);
        ++j;
    }
    CHECK_THAT(text_of(fs::path{out} / "model/result.json"),
               ContainsSubstring("stands for the model error over a window of a second"));
}

TEST_CASE("a bad record is refused with file, line and column", "[servo_axis]") {
    temporary_folder const folder;
    auto const refused = [&](std::string const& text, std::string const& reason) {
        folder.write("estimation_200Hz.csv", text);
        auto const out = (folder.path() / "out").string();
        auto const r =
            run_program(SERVO_AXIS_PROGRAM, {"windows", folder.path().string(), "--out", out});
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring(reason));
        CHECK_FALSE(fs::exists(out));
    };
    refused("t_s,position_m\n0,1\n", "'force_N'");
    refused("t_s,force_N,position_m\n0,1,1\n0,2,1\n", "line 3, column 1");
    refused("t_s,force_N,position_m\n0,1,1\n0.005,nan,1\n", "line 3, column 2");
    CHECK(run_program(SERVO_AXIS_PROGRAM, {"windows", "/nowhere", "--out", "/tmp/x"}).code == 2);
}

TEST_CASE("the real axis: offset and friction explain most, the direction the rest",
          "[.long][measured]") {
    if (!fs::exists(real_record() / "validation_200Hz.csv"))
        SIVID_SKIP("no EMPS records in '" << real_record().string() << "' (see docs/machines.md)");
    temporary_folder const folder;
    auto const data = (folder.path() / "data").string();
    auto const out = folder.path() / "out";
    REQUIRE(
        run_program(SERVO_AXIS_PROGRAM, {"windows", real_record().string(), "--out", data}).code ==
        0);
#ifdef SIVID_SANITIZED
    auto const patience = "1200";
#else
    auto const patience = "300";
#endif
    REQUIRE(run_program(SERVO_AXIS_PROGRAM,
                        {"diagnose", data, "--quiet", "--budget", patience, "--out", out.string()})
                .code == 0);
    auto const d = nlohmann::json::parse(text_of(out / "diagnosis.json"));
    CHECK(d["gap"]["verdict"] == "certified");
    CHECK(d["where"][0]["name"] == "force balance");
    CHECK(d["where"][0]["proved"] == false);
    CHECK(d["answer"]["kind"] == "effects");
    std::vector<std::string> effects = d["answer"]["effects"];
    std::sort(effects.begin(), effects.end());
    CHECK(effects == std::vector<std::string>{"directional_friction", "dry_friction", "offset"});
    // Least squares over 1 s: 6.23 mm and 1.39 mm on the validation record.
    auto const& kept = d["causes"][0]["holdout"];
    CHECK(kept["rmse_before"]["q"] < 1.1 * 6.23e-3);
    CHECK(kept["rmse_after"]["q"] < 1.1 * 1.39e-3);
}
