// SPDX-License-Identifier: MIT
// A pendulum on one joint: its model as a text, a user's MJCF file, data, and the program run on
// them.
#ifndef SIVID_TESTS_SIMULATOR_PENDULUM_HPP
#define SIVID_TESTS_SIMULATOR_PENDULUM_HPP

#include "app/cup.hpp"
#include "io/support.hpp"

#include <sivid/app/robot_of_text.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace simulator_test {

namespace fs = std::filesystem;

/// q'' (inertia + rotor ratio^2) = -m g l sin q - Fv q'. 0.5 kg at 0.2 m, and 0.002 kg m^2 about
/// its middle.
inline constexpr std::string_view model = R"toml(format = "sivid-model-1"
name = "pendulum"
states = { q = "4 rad", w = "30 rad/s" }
constants.weight = "0.981 N m"
constants.inertia = "0.022 kg m^2"
constants.ratio = "10"
constants.rotor = { value = "0 kg m^2", prior = "[0, 0.0002] kg m^2" }
constants.Fv = { value = "0 N m s", prior = "[0, 0.05] N m s" }
equations.q = "w"
equations.w = "-(weight*sin(q) + Fv*w)/(inertia + rotor*ratio^2)"
outputs.q = "q"
)toml";

/// The same, but what it lacks stands in a catalogue.
inline constexpr std::string_view incomplete = R"toml(format = "sivid-model-1"
name = "pendulum"
states = { q = "4 rad", w = "30 rad/s" }
constants.weight = { value = "0.981 N m", prior = "[0.97, 0.99] N m" }
constants.inertia = "0.022 kg m^2"
equations.q = "w"
equations.w = "-weight*sin(q)/inertia"
outputs.q = "q"
[effect.viscous]
constants.k = "[0, 0.05] N m s"
equations = "w' -= k*w/inertia"
[effect.push]
constants.k = "[-0.5, 0.5] N m"
equations = "w' += k/inertia"
)toml";

/// As people write them: comments, odd blanks, defaults, what refers to the joint.
inline constexpr std::string_view file = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- arm of 2021 - not to be touched ... --><mujoco model='pendulum'>
  <option timestep="0.0005"	integrator="RK4"/>
  <default><joint damping="0.001"/></default>
  <worldbody>
    <body name = "link">
      <inertial pos="0 0 -0.2"  mass="0.5" diaginertia="0.002 0.002 0.0001" />
      <joint   name="elbow" type="hinge" axis="0 1 0"   damping='0' />   <!-- greased -->
    </body>
  </worldbody>
  <actuator><motor name="m" joint="elbow" gear="50 0 0"
                   forcelimited="true" forcerange="-1 1"/></actuator>
  <sensor><jointpos name="elbow" joint="elbow"/></sensor>
</mujoco>
)";

inline sivid::app::robot robot_of(std::string_view text) {
    io_support::temporary_folder const folder;
    folder.write("pendulum.toml", text);
    return sivid::app::robot_of_text("sivid", "pendulum.toml",
                                     sivid::read_model(folder.path() / "pendulum.toml"));
}

/// A folder with a data set of a released pendulum, and the files of the user.
class bench {
public:
    explicit bench(std::string_view text = model) : robot{robot_of(text)} {
        folder.write("arm.xml", file);
        fs::copy_file(SIVID_SOURCE_DIR "/tests/simulator/map.json", at("map.json"));
    }
    /// @param readings  every 0.05 s, from 0.8 rad at rest
    void record(std::vector<double> const& readings, double error,
                std::string const& parameters = R"("Fv": {"prior": [0, 0.05], "unit": "N m s"},
                    "rotor": {"prior": [0, 0.0002], "unit": "kg m^2"})") const {
        std::string rows = "t,q,q_err\n";
        for (std::size_t k = 0; k < readings.size(); ++k)
            rows += sivid::nearest_text(0.05 * static_cast<double>(k), 6) + "," +
                    sivid::nearest_text(readings[k]) + "," + sivid::nearest_text(error) + "\n";
        folder.write("data/swing.measurements.csv", rows);
        folder.write("data/swing.inputs.csv", "t\n0\n2\n");
        folder.write("data/dataset.json",
                     R"({"format": "sivid-dataset-1", "id": "swing", "model": "pendulum",
              "parameters": {)" +
                         parameters +
                         R"(}, "max_outlier_fraction": 0, "scenarios": [{"name": "swing",
              "role": "fit", "duration": 2, "inputs": "swing.inputs.csv",
              "interpolation": "linear", "measurements": "swing.measurements.csv",
              "initial": {"q": [0.8, 0.8], "w": [0, 0]}}]})");
    }
    [[nodiscard]] std::string at(std::string const& name) const {
        return (folder.path() / name).string();
    }
    [[nodiscard]] app_test::finished run(std::vector<std::string> const& words) const {
        return app_test::run(words, robot);
    }
    /// `export` into the user's file.
    [[nodiscard]] app_test::finished write(std::string const& result = "out",
                                           std::string const& out = "new.xml") const {
        return run({"export", at(result), "--to", "mjcf", "--into", at("arm.xml"), "--map",
                    at("map.json"), "--out", at(out)});
    }

    io_support::temporary_folder folder;
    sivid::app::robot robot;
};

/// A swing by Runge-Kutta of fourth order, every 0.05 s for 2 s, and readings within an error, late
/// by whole milliseconds; before it begins the pendulum hangs still.
inline std::vector<double> swing(double damping, double rotor, double error, double late = 0) {
    double q = 0.8, w = 0;
    auto const rate = [&](double a, double v) {
        return -(0.981 * std::sin(a) + damping * v) / (0.022 + rotor);
    };
    std::vector<double> all;
    for (int k = 0; k <= 2000; ++k) {
        all.push_back(q);
        double const h = 0.001;
        double const a1 = w, v1 = rate(q, w);
        double const a2 = w + h / 2 * v1, v2 = rate(q + h / 2 * a1, a2);
        double const a3 = w + h / 2 * v2, v3 = rate(q + h / 2 * a2, a3);
        double const a4 = w + h * v3, v4 = rate(q + h * a3, a4);
        q += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        w += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    }
    std::vector<double> readings;
    for (int k = 0; k <= 40; ++k) {
        auto const at = std::max(0L, 50L * k - std::lround(late / 0.001));
        readings.push_back(all[static_cast<std::size_t>(at)] + error * std::sin(7.0 * k));
    }
    return readings;
}

} // namespace simulator_test

#endif
