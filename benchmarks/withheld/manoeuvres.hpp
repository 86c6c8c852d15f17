// SPDX-License-Identifier: MIT
// Seven manoeuvres: five to identify with, two held out. Inputs at 20 Hz, measurements at 10 Hz
// unless a campaign is sampled otherwise.
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
    /// Commands hold: every second knot begins one, the others end one a nanosecond before the
    /// next.
    bool held = false;
};

/// Six decimals, as in the files: what is simulated is what is written.
double six_decimals(double value);
std::string decimal_text(double value);

/// How a campaign is sampled, and what the rudder does beside its manoeuvre.
struct sampling {
    double period = 0.1;                             // s, of the measurements
    double dither = 0, dither_period = 1, phase = 0; // rad, s, rad
    bool calm_start = false;                         // S1 goes without
};

/// `variation` 0 gives the standard manoeuvres; 0.1 changes amplitudes and frequencies by up to 10
/// %.
std::vector<scenario> draw_manoeuvres(random_source& random, double variation,
                                      sampling const& how = {});

} // namespace withheld

#endif
