// SPDX-License-Identifier: MIT
// Data sets as they are read back: what a diagnosis may know, nothing more.
#ifndef WITHHELD_RECORDED_HPP
#define WITHHELD_RECORDED_HPP

#include "campaign.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace withheld {

struct sample {
    std::size_t time = 0, channel = 0; // indices
    double value = 0, error = 0;
};

struct recorded_scenario {
    scenario plan;
    std::vector<sample> samples; // missing cells are left out
    std::size_t budget = 0;      // how many samples may break their bound
};

struct recording {
    std::string id;
    std::vector<unknown_constant> unknown;
    constants fixed;
    double outlier_fraction = 0;
    std::vector<recorded_scenario> scenarios;
};

recording read_recording(std::filesystem::path const& folder);

/// |value - model|/error of each sample, given what the sensors of the model show.
/// @param modulus  what is read is what is left modulo this; 0: all of it
std::vector<double> misfits(recorded_scenario const& s, std::vector<channels> const& model,
                            channels const& modulus = {});

} // namespace withheld

#endif
