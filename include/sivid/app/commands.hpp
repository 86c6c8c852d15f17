// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_COMMANDS_HPP
#define SIVID_APP_COMMANDS_HPP

#include <sivid/app/enclosing.hpp>
#include <sivid/app/generate.hpp>
#include <sivid/app/robot.hpp>
#include <sivid/compiled.hpp>
#include <sivid/io/dataset/outlier_rule.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// The commands of a robot's program, one value of options each. Every `run` does what its command
/// says for one robot, prints what it found, writes whole files or none, and returns the exit code
/// (`exit_code`).
/// @throws input_error, output_error, std::invalid_argument  with a message for people
namespace sivid::app {

class ranks; // <sivid/app/ranks.hpp>

/// What all commands are told.
struct command {
    std::filesystem::path out;
    bool quiet = false;
    std::string command_line;   ///< for the report's footer
    ranks const* job = nullptr; ///< that share the work, of those commands that can
};

/// `import`: recorded files of any form into a data set; the work is that of `import_files`.
struct import_command : command {
    std::filesystem::path mapping;
};

/// What `identify` and `online` have in common.
struct search_command : command {
    std::filesystem::path dataset;
    std::vector<std::string> effects; ///< of the catalogue, joined to the model
    /// What is allowed for: of equations v=0.8, of channels beyond their bounds y=0.1.
    std::vector<std::string> disturbed{}, errors{};
    enclosing how{.set = "taylor-model"};
    /// Least width of a box that is split, as a share of what is left, and then the only thing
    /// beside budgets that ends the search. Without it 0.003, and so much being proved inside.
    std::optional<double> accuracy;
    double budget = 50; ///< [s]
    std::optional<std::size_t> boxes;
    std::optional<outlier_rule> outliers; ///< instead of the data set's own fraction
    std::string picture;                  ///< a channel to draw on its own; empty: none
    bool identifiability = false;         ///< what the data can tell about the parameters at all
    bool verbose = false;                 ///< say what was tried before the search
};

struct identify_command : search_command {
    std::string algorithm = "contracting"; ///< or report-1, report-2
    bool fewest_outliers = false;          ///< the smallest budgets that explain the data
    std::optional<double> memory;          ///< [MB] for boxes and what is known about them
    std::optional<double> checkpoint;      ///< [s] between two checkpoints in `out`
    bool resume = false;                   ///< from the checkpoint in `out`
    std::size_t threads = 1;               ///< 0: as many as the machine has
    bool compare = false;
    bool verdict_only = false; ///< stop once the verdict is proved
    bool by_bounds = false;    ///< what half and twice the error bounds would leave
    std::size_t batches = 4;   ///< sets of boxes learnt about at a time; the result depends on it
};
[[nodiscard]] SIVID_DECL int run(robot const& r, identify_command const& c);

/// `online`: the measurements one after the other, as they would arrive.
struct online_command : search_command {};
[[nodiscard]] SIVID_DECL int run(robot const& r, online_command const& c);

/// `confidence`: a region in which the truth is with a stated probability.
struct confidence_command : search_command {
    double probability = 0.95;
    std::uint64_t seed = 1; ///< of the signs
    std::size_t sums = 100;
    std::vector<std::string> nominal{}; ///< k=0.5, where the middle of the prior is not taken
};
[[nodiscard]] SIVID_DECL int run(robot const& r, confidence_command const& c);

struct check_command : command {
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
[[nodiscard]] SIVID_DECL int run(robot const& r, check_command const& c);

/// `certificate`: an identification as a text that a program without sivid can check.
struct certificate_command : command { ///< `out`: the file; empty: certificate.txt of the result
    std::filesystem::path result;
    std::filesystem::path dataset; ///< empty: where the result says
    double budget = 20;            ///< [s]
};
/// Ends with 0 where verdict and hull are certified, else with `undecided`.
[[nodiscard]] SIVID_DECL int run(robot const& r, certificate_command const& c);

struct diagnose_command : command {
    std::filesystem::path dataset;
    enclosing how{.set = "taylor-model"};
    double budget = 60;      ///< [s]
    std::size_t threads = 0; ///< 0: as many as the machine has
    bool verbose = false;    ///< say what was tried to bound the parameters
};
/// Ends with 0 whatever it finds, with `undecided` when the answer is open or it ended early.
[[nodiscard]] SIVID_DECL int run(robot const& r, diagnose_command const& c);

struct generate_command : command {
    std::string scenario;
    generate_options options;
};
[[nodiscard]] SIVID_DECL int run(robot const& r, generate_command const& c);

struct simulate_command : command {
    std::string scenario;
    std::vector<std::string> effects;    ///< that act in it: wind, wind=0.2 or wind=0.1:0.3
    std::map<std::string, interval> set; ///< values or ranges, read outward
    double rate = 100;
    std::optional<double> input_rate; ///< of sampled inputs; without it the shapes are exact
    bool validated = false;
    enclosing how; ///< without a set: first-order, and of ranges taylor-model
};
[[nodiscard]] SIVID_DECL int run(robot const& r, simulate_command const& c);

enum class decision { predict, verify, control, design };

/// What `predict`, `verify`, `control` and `design` are told.
struct decision_command : command {
    std::filesystem::path result, dataset;
    std::string scenario;             ///< a name or a file; data:NAME is one of the data set
    std::vector<std::string> set;     ///< Ff=0.5 or Ff=0.3:0.7
    std::vector<std::string> effects; ///< that act in it, beside those of the result
    std::string requirement;          ///< of `verify` and `control`; limits of `design`
    std::string law;                  ///< "W = clamp(K * (2 - u), 0, 250)"; may be empty
    std::vector<std::string> gain;    ///< of the law: K=3 or K=0:50
    std::vector<std::string> sensor;  ///< error bounds of what the law reads: u=0.02
    double sampled = 0, delay = 0;    ///< of the law [s]; 0: it acts at every instant
    std::vector<std::string> slew;    ///< limits of a sampled law: delta=2
    std::vector<std::string> goal;    ///< of `design`: expressions of constants
    std::filesystem::path against;    ///< of `design`: a result of another model
    std::vector<std::string> vary;    ///< inputs and their limits: W=0:100
    std::vector<std::string> measure; ///< error bounds of what is measured: psi=0.01
    double duration = 0;              ///< of the experiment [s]; 0: as the scenario
    double period = 0;                ///< of measurements [s]; 0: as in the data
    std::string name;                 ///< of the designed experiment; empty: SCENARIO-design
    double target = 0.5;              ///< the share of its width that a goal may keep
    double budget = 10;               ///< [s]
    std::size_t boxes = 20'000;       ///< of gains
    run_options run{};                ///< how motions are enclosed
};
/// Of verify, control, design: `done` when proved or found, `refuted` when proved that it cannot
/// be, else `undecided`; of predict `done` where the tubes reach the end.
[[nodiscard]] SIVID_DECL int run(robot const& r, decision what, decision_command const& c);

struct rank_command : command {
    std::filesystem::path dataset;          ///< whose measurements are moved; or
    std::vector<std::string> effects;       ///< of a data set: joined to the model
    std::string scenario;                   ///< a name, a file, or all
    std::vector<unknown_parameter> unknown; ///< of a scenario: what is ranked; empty: usual ones
    std::vector<std::string> measure;       ///< of a scenario: error bounds; empty: the robot's
    double rate = 20;                       ///< of a scenario: measurements a unit of time
    std::vector<std::string> disturbed{}, errors{}; ///< as of `search_command`, for a data set
    enclosing how{.set = "taylor-model"};
    double budget = 10; ///< [s]
};
[[nodiscard]] SIVID_DECL int run(robot const& r, rank_command const& c);

/// `disturbance`: the least unknown functions of time with which the model explains a data set.
struct disturbance_command : command {
    std::filesystem::path dataset;
    std::vector<std::string> effects;    ///< of the catalogue, joined to the model
    std::vector<std::string> on, errors; ///< equations and channels with their scales: v=0.01
    std::size_t curve = 0;               ///< points of the trade-off between equations and channels
    double budget = 20;                  ///< [s], for all
};
/// `done` where both bounds are proved, the lower at least half of the upper one.
[[nodiscard]] SIVID_DECL int run(robot const& r, disturbance_command const& c);

/// `report`: the pages of a stored result anew, byte for byte.
struct report_command : command {
    std::filesystem::path result;
};
[[nodiscard]] SIVID_DECL int run(robot const& r, report_command const& c);

/// `export`: a parameter that explains the data, in a simulator's file.
struct export_command : command { ///< `out`: the file that is written, notes and ranges beside it
    std::filesystem::path result;
    std::filesystem::path dataset; ///< empty: where the result says
    std::filesystem::path into;    ///< the file to change
    std::filesystem::path map;     ///< sivid-export-1; empty only for JSON
    std::string to;                ///< mjcf, urdf, isaaclab or json
};
/// Proves the parameter anew before it is written.
/// Ends with 0 when it is written, else with `undecided`, `inconsistent` or `refuted`, as the
/// result.
[[nodiscard]] SIVID_DECL int run(robot const& r, export_command const& c);

struct describe_command : command {
    bool dot = false; ///< in the DOT language of Graphviz
    /// Of the bound model: its constants are folded, these stay; empty for the model as written.
    std::vector<std::string> unknown;
};
/// Writes to the standard output.
[[nodiscard]] SIVID_DECL int run(robot const& r, describe_command const& c);

struct fleet_command : command {
    std::vector<std::filesystem::path> folders; ///< data sets, or folders of data sets
    std::vector<std::string> words;             ///< the program's command, before the data set
    std::vector<std::string> options;           ///< behind it
    std::size_t jobs = 1;                       ///< processes at once, of each rank
    std::optional<std::pair<std::size_t, std::size_t>> task; ///< k of n: every n-th, from k on
    double within = std::numeric_limits<double>::infinity(); ///< seconds for all
    bool again = false;                                      ///< what is finished, too
};
/// Runs the program on every data set that has no result of this command yet, and writes the
/// summary of all: fleet.csv and fleet.json.
/// @returns  done where all have a result, undecided where some have none yet, else what the first
///           that failed ended with
[[nodiscard]] SIVID_DECL int run_fleet(fleet_command const& c);

} // namespace sivid::app

#endif
