// SPDX-License-Identifier: MIT
// servo_axis COMMAND ...: what M v' = F - F_v v leaves out of the records of a real servo axis
// (EMPS); servo_axis windows FOLDER --out DATASET cuts them into windows.
#include "axis_effects.hpp"
#include "linear_axis.hpp"
#include "windows.hpp"

#include <sivid/app/app.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/dataset_writer.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <string>

namespace {

int cut_windows(int argc, char** argv) {
    std::filesystem::path folder, out;
    std::string bound = "0.001";
    CLI::App app{"Windows of estimation_200Hz.csv, and of validation_200Hz.csv to hold out"};
    app.add_option("folder", folder, "folder with the records")->required();
    app.add_option("--out", out, "folder for the data set")->required();
    app.add_option("--bound", bound, "of the position: it stands for the model error [m]")
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(sivid::app::bad_input);
    }
    servo::window_bounds bounds;
    bounds.model_error = sivid::app::positive_decimal(bound, "--bound");
    auto data = servo::axis_dataset(bounds);
    auto const add = [&](char const* file, char const* name, sivid::scenario_role role) {
        servo::add_windows(data, servo::read_recording(folder / file), name, role, bounds);
    };
    add("estimation_200Hz.csv", "estimation", sivid::scenario_role::fit);
    if (std::filesystem::exists(folder / "validation_200Hz.csv"))
        add("validation_200Hz.csv", "validation", sivid::scenario_role::holdout);
    sivid::write_dataset(data, sivid::names_of(sivid::record_model(linear_axis{}).about), out);
    sivid::app::result_stream() << "written: " << data.scenarios.size() << " windows in "
                                << out.string() << "\n";
    return sivid::app::done;
}

} // namespace

int main(int argc, char** argv) {
    auto robot = sivid::app::robot_of("servo_axis", "What a mass with viscous friction leaves out",
                                      linear_axis{}, servo::axis_catalogue());
    robot.commands = {{"windows", "cut the records of the axis into windows", cut_windows}};
    return sivid::app::run(robot, argc, argv, {std::cout, std::cerr});
}
