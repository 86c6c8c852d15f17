// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_COMMANDS_HPP
#define HOVERCRAFT_COMMANDS_HPP

#include "console/decision_command.hpp"
#include "enclosing.hpp"
#include "generate.hpp"
#include "model.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace console {
class ranks; // "console/ranks.hpp"
}

/// The commands of the program `hovercraft`, one value of options each. Every command returns the
/// exit code; it throws sivid::input_error, bad_request or sivid::output_error.
namespace hovercraft_example {

struct identify_command {
    hovercraft craft;
    std::filesystem::path dataset, out;
    std::vector<std::string> effects;      ///< of the catalogue, joined to the model
    std::string algorithm = "contracting"; ///< or report-1, report-2
    enclosing how{.set = "taylor-model"};
    /// Least width of a box that is split, as a share of what is left, and then the only thing
    /// beside budgets that ends the search. Without it 0.003, and so much being proved inside.
    std::optional<double> accuracy;
    double budget = 50; ///< [s]
    std::optional<std::size_t> boxes;
    std::optional<sivid::outlier_rule> outliers; ///< instead of the data set's own fraction
    bool fewest_outliers = false;                ///< the smallest budgets that explain the data
    std::optional<double> memory;                ///< [MB] for boxes and what is known about them
    std::optional<double> checkpoint;            ///< [s] between two checkpoints in `out`
    bool resume = false;                         ///< from the checkpoint in `out`
    std::size_t threads = 1;                     ///< 0: as many as the machine has
    bool compare = false;
    bool verdict_only = false;    ///< stop once the verdict is proved
    std::string picture;          ///< a channel to draw on its own; empty: none
    bool online = false;          ///< the measurements one after the other, as they would arrive
    bool identifiability = false; ///< what the data can tell about the parameters at all
    std::size_t batches = 4; ///< sets of boxes learnt about at a time; the result depends on it
    bool quiet = false;
    bool verbose = false;                  ///< say what was tried before the search
    std::string command_line;              ///< for the report's footer
    console::ranks const* ranks = nullptr; ///< that share the search
};
[[nodiscard]] int run(identify_command const& command);

struct check_command {
    hovercraft craft;
    std::filesystem::path result;
    std::filesystem::path dataset; ///< empty: where the result says
    bool all = false;              ///< every box instead of a sample
    std::size_t sample = 24;
    std::uint64_t seed = 1;
    enclosing how;                ///< without a set: it has its own
    std::optional<double> budget; ///< [s]; by default 10, or 3600 for all
    bool multiprecision = false;  ///< boxes too
};
/// Ends with 0 when every claim was proved anew, `refuted` when one is false, `undecided`
/// otherwise.
[[nodiscard]] int run(check_command const& command);

struct diagnose_command {
    hovercraft craft;
    std::filesystem::path dataset, out;
    enclosing how{.set = "taylor-model"};
    double budget = 60;      ///< [s]
    std::size_t threads = 0; ///< 0: as many as the machine has
    bool quiet = false;
    std::string command_line;              ///< for the report's footer
    console::ranks const* ranks = nullptr; ///< that share the fits
};
/// Ends with 0 whatever it finds, with `undecided` when the answer is open or it ended early.
[[nodiscard]] int run(diagnose_command const& command);

struct generate_command {
    hovercraft craft;
    std::string scenario;
    std::filesystem::path out;
    generate_options options;
    std::string command_line;
};
[[nodiscard]] int run(generate_command const& command);

struct simulate_command {
    hovercraft craft;
    std::string scenario;
    std::filesystem::path out;
    std::map<std::string, sivid::interval> set; ///< values or ranges, read outward
    double rate = 100;
    std::optional<double> input_rate; ///< of sampled inputs; without it the shapes are exact
    bool validated = false;
    enclosing how; ///< without a set: first-order, and of ranges taylor-model
    std::string command_line;
};
[[nodiscard]] int run(simulate_command const& command);

/// What a stored identification says of a scenario: tubes, or whether a requirement holds.
[[nodiscard]] int run_decision(console::decision what, hovercraft const& craft,
                               console::decision_command const& command);

struct rank_command {
    hovercraft craft;
    std::filesystem::path dataset;    ///< whose measurements are moved; or
    std::string scenario;             ///< a name, a file, or all; neither: the state equations
    std::vector<std::string> unknown; ///< of a scenario: the constants to rank
    std::filesystem::path out;
    enclosing how{.set = "taylor-model"};
    double budget = 10;            ///< [s]
    std::vector<std::string> free; ///< derived constants to take as independent
    bool quiet = false;
    std::string command_line;
};
[[nodiscard]] int run(rank_command const& command);

struct describe_command {
    hovercraft craft;
    bool dot = false; ///< in the DOT language of Graphviz
    /// Of the bound model: its constants are folded, these stay; empty for the model as written.
    std::vector<std::string> unknown;
};
/// Writes to the standard output.
[[nodiscard]] int run(describe_command const& command);

/// What the constants mean: Table 2.1 of the report.
[[nodiscard]] inline std::map<std::string, std::string> constant_meanings() {
    return {{"m", "mass"},
            {"Iz", "moment of inertia about the vertical axis"},
            {"rho", "density of the air"},
            {"Cd", "air resistance coefficient"},
            {"CL", "rudder lift coefficient"},
            {"Cdelta", "propulsion coefficient"},
            {"D", "propeller diameter"},
            {"Su", "front area"},
            {"Sv", "side area"},
            {"Sg", "rudder area"},
            {"A", "area swept by the propeller"},
            {"L", "distance between centre of gravity and rudder"},
            {"Ff", "dry friction force"},
            {"eps", "speed below which the dry friction fades"},
            {"D11", "linear damping in surge"},
            {"D22", "linear damping in sway"},
            {"D33", "linear damping in yaw"}};
}

} // namespace hovercraft_example

namespace sivid { // the craft's equations are compiled once, in describe.cpp
extern template recorded_model record_model(hovercraft const&);
} // namespace sivid

#endif
