// SPDX-License-Identifier: MIT
// What the sensors of a machine in MuJoCo show of a drawn motion, with bounds that hold.
#ifndef SIVID_BENCHMARKS_SIMULATOR_RECORDS_HPP
#define SIVID_BENCHMARKS_SIMULATOR_RECORDS_HPP

#include "machines.hpp"

#include <random>
#include <string>
#include <vector>

namespace simulator {

/// A case: a machine, its constants, and what is withheld of it.
struct drawn_case {
    std::string id;
    machine robot;
    values constants;
    withheld truth;
};

struct record {
    values times;
    std::vector<values> readings, commands; ///< one row a time of `times`
    values bounds;                          ///< of the channels
    double start = 0;                       ///< of the first position, exact
};

inline constexpr double sample = 0.02; ///< [s] of commands and readings

/// The integrator's part of a bound: MuJoCo runs with a step of 0.5 ms and with half of it on the
/// same commands; the second makes the record. A method of first order at least halves its error
/// when it halves its step, so that what is left is at most the difference of the two, here taken
/// twice. Dry friction is a constraint there that gives way within a time constant: what that
/// does to the record is bounded in the same way, by a run with twice the time constant.
[[nodiscard]] record simulate(drawn_case const&, std::mt19937_64&, double duration);

} // namespace simulator

#endif
