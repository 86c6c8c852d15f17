// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_RELATION_TERMS_HPP
#define SIVID_PAVING_RELATION_DETAIL_RELATION_TERMS_HPP

#include <sivid/number/interval.hpp>
#include <sivid/paving/relation/channel_tube.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// How the integrals of a relation are enclosed.
enum class window_way {
    direct,   ///< from the tubes of the states in the row alone
    damped,   ///< about the middle of the coefficients, weighted (see `combine`)
    by_parts, ///< also by parts, with q' = r for states r in the row: one more sensor, sharper
    weak,     ///< under a bump, where the state itself was not measured but its integral was
    /// The same where what the model proves of its motions is known: the equation as it is stated,
    /// under weights that are linear between samples (see `weak_equation`).
    stated,
    stated_middle ///< the same about the middle of the coefficients
};

[[nodiscard]] constexpr bool is_stated(window_way way) {
    return way == window_way::stated || way == window_way::stated_middle;
}

/// By what the states are known between the samples.
enum class tube_source {
    declared, ///< declared variations of the rates, above what the model does by itself
    proved    ///< what the model proves of its own motions over the prior: nothing is assumed
};

/// A sensor that may be faulty, in a problem whose model takes what it shows for the state: see
/// `sensor_discharge.hpp`. The state changes by what is shown times 1 + scale, plus drift times the
/// time, plus shares of what the sensors of other states show.
struct suspected_sensor {
    std::size_t state = 0; ///< that it shows
    interval scale{0.0}, drift{0.0};
    std::vector<std::pair<std::size_t, interval>> mixing;
    /// Declared variations of what is shown, per experiment.
    std::map<std::string, std::vector<rate_variation>> laws;
};

} // namespace sivid

#endif
