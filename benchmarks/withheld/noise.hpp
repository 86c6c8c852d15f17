// SPDX-License-Identifier: MIT
#ifndef WITHHELD_NOISE_HPP
#define WITHHELD_NOISE_HPP

#include "campaign.hpp"
#include "random.hpp"

namespace withheld {

/// Simulates the truth and writes what the sensors would say: noise within the bounds, then
/// outliers.
void measure(campaign& c, random_source& random);

/// What the sensors would say of a single run: uniform noise within the bounds.
/// @given  its truth
void add_uniform_noise(measured_scenario& s, random_source& random);

} // namespace withheld

#endif
