// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DETAIL_MANOEUVRE_SETTINGS_HPP
#define SIVID_DIAGNOSIS_DETAIL_MANOEUVRE_SETTINGS_HPP

#include <sivid/model/bound_model.hpp>

#include <functional>
#include <string>
#include <vector>

namespace sivid {

/// A number of a manoeuvre that may be chosen, with its limits.
struct manoeuvre_setting {
    std::string name;
    std::string unit;
    double lower = 0, upper = 0;
};

/// Something the robot can be told to do: inputs over a duration, perhaps with a few settings.
struct manoeuvre {
    std::string name;
    double duration = 1;                     ///< [s]
    std::vector<double> start;               ///< the states at its begin
    std::vector<manoeuvre_setting> settings; ///< none: a fixed manoeuvre
    std::function<std::vector<signal>(std::vector<double> const&)> inputs;
};

} // namespace sivid

#endif
