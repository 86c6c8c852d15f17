// SPDX-License-Identifier: MIT
// The program of the hovercraft as a child process.
#ifndef SIVID_TESTS_HOVERCRAFT_CHILD_HPP
#define SIVID_TESTS_HOVERCRAFT_CHILD_HPP

#include "support/child_program.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace hovercraft_test {

namespace fs = std::filesystem;

class child : public support::child_program {
public:
    child(std::vector<std::string> arguments, fs::path const& folder, ::rlim_t largest_file = 0)
        : child_program(HOVERCRAFT_PROGRAM, std::move(arguments), folder, largest_file) {}
};

inline support::finished_program run(std::vector<std::string> const& arguments) {
    return support::run_program(HOVERCRAFT_PROGRAM, arguments);
}

inline nlohmann::json json_of(fs::path const& file) {
    std::ifstream in{file};
    return nlohmann::json::parse(in);
}

} // namespace hovercraft_test

#endif
