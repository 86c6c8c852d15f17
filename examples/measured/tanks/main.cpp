// SPDX-License-Identifier: MIT
// tanks FOLDER --out DIR: what a model of two cascaded tanks leaves out of their record.
#include "command.hpp"

#include <sivid/io/text_file.hpp>

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

sivid::exact_decimal positive(std::string const& text, std::string const& what) {
    auto const value = sivid::exact_decimal::parse(text);
    if (!value || !sivid::enclose(*value) || !value->is_positive())
        throw std::invalid_argument(what + ": " + sivid::in_quotes(text) +
                                    " is not a decimal number above 0");
    return *value;
}

int refuse(std::exception const& e) {
    std::cerr << "tanks: " << e.what() << "\n";
    return tanks::bad_input;
}

int parse_and_run(int argc, char** argv) {
    tanks::diagnose_command c;
    c.command_line = "tanks";
    for (int i = 1; i < argc; ++i) c.command_line += std::string{" "} + argv[i];
    auto bound = c.bound.text();
    auto lower_start = c.lower_start.text();
    auto upper_start = c.upper_start.text();

    CLI::App app{"What a model of two cascaded tanks leaves out of their record"};
    app.add_option("folder", c.folder, "folder with the record")->required();
    app.add_option("--out", c.out, "folder for report.html and diagnosis.json")->required();
    app.add_option("--file", c.file,
                   "the record: a table with t_s, pump_voltage_V and level_lower_tank_V")
        ->capture_default_str();
    app.add_option("--holdout", c.holdout_file, "a record that chooses nothing")
        ->capture_default_str();
    app.add_option("--bound", bound, "of the level [V]")->capture_default_str();
    app.add_option("--lower-start", lower_start,
                   "bound of the lower level at the start about its first sample [V]")
        ->capture_default_str();
    app.add_option("--upper-start", upper_start, "largest upper level at the start [V]")
        ->capture_default_str();
    app.add_option("--budget", c.budget, "seconds for the whole")
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
    app.add_flag("--quiet", c.quiet, "no progress");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(tanks::bad_input);
    }
    c.bound = positive(bound, "--bound");
    c.lower_start = positive(lower_start, "--lower-start");
    c.upper_start = positive(upper_start, "--upper-start");
    return tanks::run(c);
}

} // namespace

int main(int argc, char** argv) {
    try {
        return parse_and_run(argc, argv);
    } catch (sivid::input_error const& e) {
        return refuse(e);
    } catch (sivid::output_error const& e) {
        return refuse(e);
    } catch (std::invalid_argument const& e) {
        return refuse(e);
    } catch (std::exception const& e) {
        std::cerr << "tanks: internal error: " << e.what() << "\n";
        return tanks::internal_error;
    }
}
