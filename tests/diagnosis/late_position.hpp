// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_DIAGNOSIS_LATE_POSITION_HPP
#define SIVID_TESTS_DIAGNOSIS_LATE_POSITION_HPP

#include "diagnosis/small_campaign.hpp"

#include <cmath>
#include <cstddef>

namespace diagnosis_support {

/// The cart, whose position is shown `steps` milliseconds late.
inline sivid::identification_problem with_late_position(int steps,
                                                        small_campaign::truth const& real = {}) {
    auto problem = small_campaign::problem(real);
    auto fine = real;
    fine.every = 1;
    for (std::size_t e = 0; e < 2; ++e) {
        auto const all = small_campaign::experiment(e, fine).measurements; // p, v, p, v, ...
        for (auto& m : problem.experiments[e].measurements) {
            if (m.channel != 0) continue;
            auto const past = static_cast<int>(std::lround(1000 * m.time)) - steps;
            m.bound = past > 0 ? all[2 * static_cast<std::size_t>(past - 1)].bound
                               : sivid::interval(-0.02, 0.02);
        }
    }
    return problem;
}

} // namespace diagnosis_support

#endif
