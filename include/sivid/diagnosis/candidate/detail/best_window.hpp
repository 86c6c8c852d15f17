// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_BEST_WINDOW_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_BEST_WINDOW_HPP

#include <sivid/diagnosis/candidate/detail/soft_switch.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// Where a switch is on, as shares of an experiment: below 0 at its start, above 1 never.
struct switch_window {
    double on, off;
};

/// Between which samples a switch is on where each gains so much by that: the window of the largest
/// sum.
/// @param gains   by sample, in order of time
/// @param shares  of the experiment at which the samples are
/// @param ends    which ends the window has; without one it begins at the start, or never ends
/// @cost  O(samples)
[[nodiscard]] inline switch_window best_window(std::vector<double> const& gains,
                                               std::vector<double> const& shares,
                                               episode_ends ends) {
    constexpr double start = -0.05, never = 1.05;
    double const begins_at = ends.begins ? never : start, ends_at = ends.ends ? start : never;
    switch_window best{begins_at, ends_at};
    double sum = 0, least = 0, most = 0, from = start; // least: of what stands before the window
    for (std::size_t k = 0; k <= gains.size(); ++k) {
        bool const last = k == gains.size();
        if (k > 0) sum += gains[k - 1];
        if (k > 0 && !last && !(shares[k] > shares[k - 1])) continue; // at one time
        double const here = k == 0 ? start : last ? never : 0.5 * (shares[k - 1] + shares[k]);
        if (ends.begins && sum < least) {
            least = sum;
            from = here;
        }
        if ((ends.ends || last) && sum - least > most) {
            most = sum - least;
            best = {from, ends.ends ? here : never};
        }
    }
    return best;
}

} // namespace sivid

#endif
