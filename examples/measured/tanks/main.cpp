// SPDX-License-Identifier: MIT
// tanks FOLDER --out DIR: what a model of two cascaded tanks leaves out of their record.
#include "command.hpp"
#include "console/number_range.hpp"
#include "console/program.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace {

int parse_and_run(int argc, char** argv) {
    tanks::diagnose_command c;
    c.command_line = console::command_line("tanks", argc, argv);
    auto bound = c.bound.text();
    auto lower_start = c.lower_start.text();
    auto upper_start = c.upper_start.text();

    CLI::App app{"What a model of two cascaded tanks leaves out of their record"};
    app.add_option("folder", c.folder, "folder with the record")->required();
    app.add_option("--out", c.out, "folder for report.html and diagnosis.json")->required();
    app.add_option("--file", c.file,
                   "the record: a table with t_s, pump_voltage_V and level_lower_tank_V")
        ->capture_default_str();
    app.add_option("--holdout", c.holdout_file,
                   "a record that is held out: nothing is fitted to it")
        ->capture_default_str();
    app.add_option("--bound", bound, "of the level [V]")->capture_default_str();
    app.add_option("--lower-start", lower_start,
                   "bound of the lower level at the start about its first sample [V]")
        ->capture_default_str();
    app.add_option("--upper-start", upper_start, "largest upper level at the start [V]")
        ->capture_default_str();
    app.add_option("--budget", c.budget, "seconds, where the steps do not end by themselves before")
        ->check(console::number_between(0.0, 1e9))
        ->capture_default_str();
    app.add_flag("--quiet", c.quiet, "no progress");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    c.bound = console::positive_decimal(bound, "--bound");
    c.lower_start = console::positive_decimal(lower_start, "--lower-start");
    c.upper_start = console::positive_decimal(upper_start, "--upper-start");
    return tanks::run(c);
}

} // namespace

int main(int argc, char** argv) {
    return console::guarded("tanks", [&] { return parse_and_run(argc, argv); });
}
