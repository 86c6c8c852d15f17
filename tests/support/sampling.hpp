// SPDX-License-Identifier: MIT
// Containment by sampling: reference trajectories of random members against a tube, at random times
// (between steps too) and over random spans.
#ifndef SIVID_TESTS_SUPPORT_SAMPLING_HPP
#define SIVID_TESTS_SUPPORT_SAMPLING_HPP

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <sivid/enclosure/tube.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace support {

/// @param rough  whether the reference has to cross kinks; its error is larger then
template <class System>
void check_tube(System const& system, sivid::tube<interval> const& tube, draws& d, int members,
                int instants = 12, bool rough = false) {
    double const error = rough ? kinked_reference_error : reference_error;
    double const begin = tube.begin_time();
    double const end = tube.end_time();
    for (int member = 0; member < members; ++member) {
        auto const x0 = d.in(system.initial);
        auto const p = d.in(system.parameters);
        std::vector<double> times{begin, end};
        for (int k = 0; k < instants; ++k) times.push_back(d.uniform(begin, end));
        if (!tube.steps().empty()) { // and at an end of a step
            times.push_back(tube.steps()[d.below(tube.steps().size())].to);
        }
        std::sort(times.begin(), times.end());
        auto const states =
            rough
                ? reference_states<dormand_prince>(system.rate, extend(x0), extend(p), begin, times,
                                                   system.inputs, 1e-14L)
                : reference_states(system.rate, extend(x0), extend(p), begin, times, system.inputs);
        auto const a = d.below(times.size());
        auto const b = a + d.below(times.size() - a);
        auto const over = tube.over(times[a], times[b]);
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const at = tube.at(times[k]);
            for (std::size_t i = 0; i < x0.size(); ++i) {
                bool const good = encloses_reference(at[i], states[k][i], error);
                bool const swept =
                    k < a || k > b || encloses_reference(over[i], states[k][i], error);
                if (good && swept) continue;
                CAPTURE(system.name, member, times[k], i, static_cast<double>(states[k][i]),
                        at[i].lower(), at[i].upper(), over[i].lower(), over[i].upper());
                CHECK(good);
                CHECK(swept);
            }
        }
    }
}

} // namespace support

#endif
