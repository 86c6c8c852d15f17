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
