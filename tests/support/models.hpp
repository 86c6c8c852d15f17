// SPDX-License-Identifier: MIT
// Models made at run time from one generic lambda, so that a test runs the same equations on the
// recording scalar, on doubles, and on the high-precision numbers of its oracle.
#ifndef SIVID_TESTS_SUPPORT_MODELS_HPP
#define SIVID_TESTS_SUPPORT_MODELS_HPP

#include "support/rates.hpp"

#include <sivid/enclosure/flow.hpp>
#include <sivid/model/model.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace support {

using sivid::box;
using sivid::interval;

/// [lo, hi] from two exact doubles.
inline interval between(double lo, double hi) {
    return sivid::interval_traits<interval>::bounds(lo, hi);
}
/// [x - r, x + r], rounded outward.
inline interval around(double x, double r) {
    using traits = sivid::interval_traits<interval>;
    return traits::add(traits::point(x), traits::bounds(-r, r));
}

struct shape {
    std::size_t states = 1;
    std::size_t constants = 0;
    std::size_t inputs = 0;
    double limit = 100; ///< own range of each state
};

/// Names "x0", "p0", "u0", "y0", ...
inline std::string numbered(char letter, std::size_t i) {
    std::string name(1, letter);
    name += std::to_string(i);
    return name;
}

inline std::vector<std::string> all_constants(std::size_t n) {
    std::vector<std::string> names;
    for (std::size_t j = 0; j < n; ++j) names.push_back(numbered('p', j));
    return names;
}

using recorded_rate = rate_on<sivid::expression>;

/// Records rate(t, x, p, u) and observe(t, x, p, u), both from vectors to a vector; without
/// `observe` every state is a channel.
sivid::recorded_model model_of(shape const& s, recorded_rate const& rate,
                               recorded_rate const& observe = {});

/// The flow with every constant unknown.
inline std::shared_ptr<sivid::flow const> flow_of(sivid::recorded_model const& m,
                                                  std::vector<sivid::signal> const& inputs = {}) {
    return std::make_shared<sivid::flow const>(
        m, sivid::parameter_choice{all_constants(m.about.constants.size()), {}}, inputs);
}

} // namespace support

#endif
