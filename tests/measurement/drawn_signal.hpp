// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_MEASUREMENT_DRAWN_SIGNAL_HPP
#define SIVID_TESTS_MEASUREMENT_DRAWN_SIGNAL_HPP

#include <sivid/measurement/signal.hpp>

#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace measurement_support {

/// A signal with knots of its own, going up, down and resting.
inline sivid::sampled_signal drawn(support::draws& d, sivid::interpolation kind, bool errors) {
    std::vector<double> times{d.uniform(-1, 0.2)}, values{d.uniform(-1, 1)}, bounds;
    for (auto n = d.below(12); n > 0; --n) {
        times.push_back(times.back() + std::exp(d.uniform(-4, 0)));
        values.push_back(d.below(4) == 0 ? values.back() : d.uniform(-1, 1));
    }
    if (errors) {
        for (std::size_t k = 0; k < times.size(); ++k)
            bounds.push_back(d.below(3) == 0 ? 0.0 : d.uniform(0, 0.1));
    }
    return {times, values, kind, bounds};
}

} // namespace measurement_support

#endif
