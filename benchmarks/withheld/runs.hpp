// SPDX-License-Identifier: MIT
// Single runs of a craft that a label describes: of scenarios that somebody else has planned, or
// under a control law. They are added to the records that there are.
#ifndef WITHHELD_RUNS_HPP
#define WITHHELD_RUNS_HPP

#include "campaign.hpp"
#include "labels.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace withheld {

/// A scenario's file (sivid-scenario-1). Constants and lines between samples are taken as they are,
/// other shapes at 20 Hz; a start with a range is its middle.
/// @param period  of the measurements [s]
scenario read_plan(std::filesystem::path const& file, double period);

/// The run with its noise.
measured_scenario performed(label const& truth, scenario plan, random_source& random);

/// What commands W and delta, of the time and of what the sensors show.
using control_law = std::function<command(double t, channels const& shown)>;

/// The run under a law that is computed from a sample every `period`; its command acts `delay`
/// later and is held. Before the first one acts, the inputs are what it says of the first.
/// @returns  with the commands as the plan's inputs: lines that jump within a nanosecond
measured_scenario performed(label const& truth, scenario plan, control_law const& law,
                            double period, double delay, random_source& random);

/// u, v, r, x, y, psi of a run at increasing times, without sensors.
std::vector<channels> true_channels(label const& truth, measured_scenario const& run,
                                    std::vector<double> const& times);

/// Writes the records of `dataset` (none when empty) and these into `out`, as one data set.
/// @param id  its name; empty: that of `dataset`
void write_records(std::filesystem::path const& dataset, std::filesystem::path const& out,
                   std::string const& id, std::vector<measured_scenario> const& runs);

} // namespace withheld

#endif
