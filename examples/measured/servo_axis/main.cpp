// SPDX-License-Identifier: MIT
// servo_axis FOLDER --out DIR: identifies a real servo axis (EMPS) from windows of its record;
// servo_axis diagnose FOLDER --out DIR: what M v' = F - F_v v leaves out of it.
#include "command.hpp"
#include "console/number_range.hpp"
#include "console/program.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace {

/// Options of both commands; the texts become exact decimals after parsing.
struct common_options {
    std::string bound, start_position, start_velocity;

    template <class Command>
    common_options(CLI::App& app, Command& c)
        : bound{c.bounds.model_error.text()},
          start_position{c.bounds.start_position.text()},
          start_velocity{c.bounds.start_velocity.text()} {
        app.add_option("folder", c.folder, "folder with the record")->required();
        app.add_option("--out", c.out, "folder for what is written")->required();
        app.add_option("--file", c.file, "the record: a table with t_s, force_N and position_m")
            ->capture_default_str();
        app.add_option("--bound", bound, "of the position: it stands for the model error [m]")
            ->capture_default_str();
        app.add_option("--start-position", start_position, "bound of a start's position [m]")
            ->capture_default_str();
        app.add_option("--start-velocity", start_velocity,
                       "bound of a start's velocity about the filter's [m/s]")
            ->capture_default_str();
        app.add_option("--window", c.windows.length, "length of a window [s]")
            ->check(console::number_between(0.05, 1000.0))
            ->capture_default_str();
        app.add_option("--first", c.windows.first, "start of the first window [s]")
            ->check(console::number_between(0.0, 1e6))
            ->capture_default_str();
        app.add_option("--every", c.windows.every,
                       "from the start of a window to the next one's [s]")
            ->check(console::number_between(0.05, 1e6))
            ->capture_default_str();
        app.add_option("--budget", c.budget, "seconds for the whole")
            ->check(console::number_between(0.0, 1e9))
            ->capture_default_str();
        app.add_flag("--quiet", c.quiet, "no progress");
    }
    [[nodiscard]] servo::stated_bounds bounds() const {
        return {console::positive_decimal(bound, "--bound"),
                console::positive_decimal(start_position, "--start-position"),
                console::positive_decimal(start_velocity, "--start-velocity")};
    }
};

int diagnose(int argc, char** argv) {
    servo::diagnose_command c;
    c.command_line = console::command_line("servo_axis", argc, argv);
    CLI::App app{"What the linear model of a real servo axis (EMPS) leaves out",
                 "servo_axis diagnose"};
    common_options const common(app, c);
    app.add_option("--holdout", c.holdout_file,
                   "a record that is held out: nothing is fitted to it")
        ->capture_default_str();
    app.add_option("--every-sample", c.every_sample, "compare every so many samples of a window")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    try {
        app.parse(argc - 1, argv + 1);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    c.bounds = common.bounds();
    return servo::run(c);
}

int parse_and_run(int argc, char** argv) {
    if (argc > 1 && std::string{argv[1]} == "diagnose") return diagnose(argc, argv);
    servo::command c;
    c.command_line = console::command_line("servo_axis", argc, argv);
    CLI::App app{"Validated identification of a real servo axis (EMPS)\n"
                 "servo_axis diagnose FOLDER --out DIR: what a linear model leaves out"};
    common_options const common(app, c);
    app.add_option("--accuracy", c.accuracy,
                   "leave boxes undecided when no side is wider than this share of the prior")
        ->check(console::number_between(1e-6, 1.0))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    c.bounds = common.bounds();
    return servo::run(c);
}

} // namespace

int main(int argc, char** argv) {
    return console::guarded("servo_axis", [&] { return parse_and_run(argc, argv); });
}
