// SPDX-License-Identifier: MIT
// Effects for the cart of small_campaign.hpp.
#ifndef SIVID_TESTS_DIAGNOSIS_SMALL_CATALOGUE_HPP
#define SIVID_TESTS_DIAGNOSIS_SMALL_CATALOGUE_HPP

#include "diagnosis/small_campaign.hpp"

#include <vector>

namespace small_campaign {

inline std::vector<sivid::effect> catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {any::quadratic_damping("quadratic", "v", "1/m", {0_dec, 1_dec}),
            any::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec}),
            any::sensor_scale("scale", {"p"}, {-0.5_dec, 0.5_dec}),
            any::input_delay("late", "u", {0_dec, 0.5_dec})};
}
/// Drag that grows with the square of the speed.
inline truth with_drag(double k) {
    truth t;
    t.missing = [k](double, double v, double) { return -k * std::abs(v) * v; };
    return t;
}
inline truth with_slope(double a) {
    truth t;
    t.missing = [a](double, double, double) { return a; };
    return t;
}
inline truth with_scale(double k) {
    truth t;
    t.seen_position = [k](double p) { return (1 + k) * p; };
    return t;
}
inline truth with_delay(double tau) {
    truth t;
    t.delay = tau;
    return t;
}

/// An effect of something that is remembered, of which size in the truth, from what to what.
struct memory {
    sivid::effect e;
    double truth::*size;
    double least, most;
};
inline std::vector<memory> memories() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {
        {any::input_delay("late", "u", {0_dec, 0.6_dec}), &truth::delay, 0.2, 0.4},
        {any::input_backlash("gap", "u", "N", {0_dec, 0.6_dec}), &truth::play, 0.2, 0.4},
        {any::input_rate_limit("slow", "u", "N/s", {0.1_dec, 5_dec}), &truth::limit, 0.4, 0.7},
        {any::sensor_latency("sensor", {"p"}, {0_dec, 0.6_dec}), &truth::sensor_delay, 0.2, 0.4},
        {any::input_clock_drift("clock", "u", {0_dec, 0.4_dec}), &truth::drift, 0.1, 0.25},
        {any::sensor_clock_drift("stamps", {"p"}, {0_dec, 0.4_dec}), &truth::sensor_drift, 0.1,
         0.25},
        {any::input_lag("lag", "u", "N", {0_dec, 0.8_dec}, 5), &truth::lag, 0.2, 0.4}};
}
/// It is seen in each experiment from one time until another one.
inline sivid::identification_problem seen_within(truth real, std::vector<double> const& from,
                                                 std::vector<double> const& until) {
    auto result = problem();
    result.experiments.clear();
    for (std::size_t e = 0; e < from.size(); ++e) {
        real.from = from[e];
        real.until = until[e];
        result.experiments.push_back(experiment(e, real));
    }
    return result;
}

inline truth with_play(double b) {
    truth t;
    t.play = b;
    return t;
}

inline truth with_rate_limit(double limit) {
    truth t;
    t.limit = limit;
    return t;
}

} // namespace small_campaign

#endif
