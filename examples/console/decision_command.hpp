// SPDX-License-Identifier: MIT
#ifndef EXAMPLES_CONSOLE_DECISION_COMMAND_HPP
#define EXAMPLES_CONSOLE_DECISION_COMMAND_HPP

#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace console {

enum class decision { predict, verify, control, design };

/// What `predict`, `verify`, `control` and `design` are told.
struct decision_command {
    std::filesystem::path result, dataset, out;
    std::string scenario;             ///< a name or a file; data:NAME is one of the data set
    std::vector<std::string> set;     ///< Ff=0.5 or Ff=0.3:0.7
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
    sivid::run_options run{};         ///< how motions are enclosed
    bool quiet = false;
    std::string command_line;
};

} // namespace console

#endif
