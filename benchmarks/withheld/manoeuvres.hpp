// SPDX-License-Identifier: MIT
// Seven manoeuvres: five to identify with, two held out. Inputs at 20 Hz, measurements at 10 Hz.
#ifndef WITHHELD_MANOEUVRES_HPP
#define WITHHELD_MANOEUVRES_HPP

#include "craft.hpp"
#include "random.hpp"

#include <string>
#include <vector>

namespace withheld {

struct range {
    double lo = 0, hi = 0;
    double middle() const { return lo + (hi - lo) / 2; }
};

struct scenario {
    std::string name;
    bool holdout = false;
    double duration = 0;
    polyline motor, rudder;
    std::array<range, channel_count> initial{};
    std::vector<double> sample_times;
};

/// Six decimals, as in the files: what is simulated is what is written.
double six_decimals(double value);
std::string decimal_text(double value);

/// `variation` 0 gives the standard manoeuvres; 0.1 changes amplitudes and frequencies by up to 10
/// %.
std::vector<scenario> draw_manoeuvres(random_source& random, double variation);

} // namespace withheld

#endif
