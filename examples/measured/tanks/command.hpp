// SPDX-License-Identifier: MIT
#ifndef TANKS_COMMAND_HPP
#define TANKS_COMMAND_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/problem.hpp>

#include <filesystem>
#include <string>

namespace tanks {

struct diagnose_command {
    std::filesystem::path folder, out;
    std::string file = "estimation.csv";
    std::string holdout_file = "validation.csv"; ///< left out when it is not there
    sivid::exact_decimal bound = *sivid::exact_decimal::parse("0.2");      ///< of the level [V]
    sivid::exact_decimal lower_start = *sivid::exact_decimal::parse("1");  ///< [V]
    sivid::exact_decimal upper_start = *sivid::exact_decimal::parse("15"); ///< at most [V]
    double budget = 600;                                                   ///< [s], at most
    bool quiet = false;
    std::string command_line;
};

/// A record as one experiment: t_s, pump_voltage_V (held), level_lower_tank_V.
/// @throws sivid::input_error with file, line and column
[[nodiscard]] sivid::experiment read_experiment(std::filesystem::path const& file,
                                                diagnose_command const& c);

/// k1, k3 and k4 to be found from one record.
[[nodiscard]] sivid::identification_problem tank_problem(sivid::experiment record);

/// Diagnoses what two tanks without rims leave out. Ends with 0 whatever it finds.
/// @throws sivid::input_error, sivid::output_error
[[nodiscard]] int run(diagnose_command const& c);

} // namespace tanks

#endif
