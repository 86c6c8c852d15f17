// SPDX-License-Identifier: MIT
#ifndef EXAMPLES_CONSOLE_DECISION_COMMAND_HPP
#define EXAMPLES_CONSOLE_DECISION_COMMAND_HPP

#include <filesystem>
#include <string>
#include <vector>

namespace console {

/// What `predict` and `verify` are told.
struct decision_command {
    std::filesystem::path result, dataset, out;
    std::string scenario;         ///< a name or a file; data:NAME is one of the data set
    std::vector<std::string> set; ///< Ff=0.5 or Ff=0.3:0.7
    std::string requirement;      ///< of `verify`
    double budget = 10;           ///< [s]
    bool quiet = false;
    std::string command_line;
};

} // namespace console

#endif
