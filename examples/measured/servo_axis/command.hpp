// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_COMMAND_HPP
#define SERVO_AXIS_COMMAND_HPP

#include "record.hpp"

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/paving/identify.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace servo {

/// What the user states about the record: bounds, none of which can be read off the file.
struct stated_bounds {
    sivid::exact_decimal model_error = *sivid::exact_decimal::parse("0.003");    ///< of q [m]
    sivid::exact_decimal start_position = *sivid::exact_decimal::parse("2e-6");  ///< [m]
    sivid::exact_decimal start_velocity = *sivid::exact_decimal::parse("0.001"); ///< [m/s]
};

struct command {
    std::filesystem::path folder, out;
    std::string file = "estimation_200Hz.csv";
    window_choice windows;
    stated_bounds bounds;
    double accuracy = 0.03; ///< least width of a box that is split, as a share of the prior
    double budget = 40;     ///< [s]
    bool quiet = false;
    std::string command_line;
};

struct diagnose_command {
    std::filesystem::path folder, out;
    std::string file = "estimation_200Hz.csv";
    std::string holdout_file = "validation_200Hz.csv"; ///< left out when it is not there
    window_choice windows{.every = 1};
    stated_bounds bounds{.model_error = *sivid::exact_decimal::parse("0.001")};
    std::size_t every_sample = 5; ///< of a window: every so many are compared
    double budget = 60;           ///< [s]
    bool quiet = false;
    std::string command_line;
};
/// Diagnoses what M v' = F - F_v v leaves out. Ends with 0 whatever it finds.
/// @throws sivid::input_error, sivid::output_error
[[nodiscard]] int run(diagnose_command const& c);

/// The problem that the windows pose.
struct posed_problem {
    sivid::identification_problem problem;
    std::vector<sample_range> used;
    std::vector<sample_range> kept_back; ///< windows of the same length in the gaps
    std::size_t filter_half = 5;         ///< of the velocity filter, in samples
    double share_used = 0;               ///< of the record's time
    /// Largest difference of the velocity filter from one 3/5 as wide, at the starts [m/s].
    double filter_difference = 0;
};
[[nodiscard]] posed_problem pose(recording const& r, command const& c);

/// How far the model's position is from the record in one window, by plain simulation.
struct misfit {
    double start = 0;   ///< [s]
    double largest = 0; ///< [m]
    double mean_square = 0;
    std::size_t samples = 0;
};
[[nodiscard]] std::vector<misfit> approximate_misfits(posed_problem const& posed,
                                                      recording const& r,
                                                      std::vector<sample_range> const& windows,
                                                      std::vector<double> const& parameters);

/// Fits, verifies the fit by a validated run, and paves the prior with the balance's contraction.
/// @guarantee  as of sivid::identify
[[nodiscard]] sivid::identification
identify_axis(posed_problem const& posed, double accuracy, double budget,
              std::function<void(std::string const&)> const& note,
              std::function<bool(sivid::paving_progress const&)> const& progress);

/// Whether the literature's values, taken together, are proved not to explain the windows.
[[nodiscard]] bool refutes(posed_problem const& posed, std::vector<double> const& parameters);

/// M, F_v, F_c, offset of the benchmark's own model, by name of the parameters.
[[nodiscard]] std::vector<double> literature();

/// @returns the exit code
/// @throws sivid::input_error, sivid::output_error
[[nodiscard]] int run(command const& c);

} // namespace servo

#endif
