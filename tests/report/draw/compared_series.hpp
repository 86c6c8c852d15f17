// SPDX-License-Identifier: MIT
// A channel before and after an effect was joined, with a reading that is suspected.
#ifndef SIVID_TESTS_REPORT_DRAW_COMPARED_SERIES_HPP
#define SIVID_TESTS_REPORT_DRAW_COMPARED_SERIES_HPP

#include <sivid/report/draw/time_plot.hpp>

namespace sivid_tests {

inline sivid::report::channel_series compared_series() {
    sivid::report::channel_series c{.name = "r", .unit = "rad/s"};
    for (int k = 0; k < 10; ++k) {
        c.measured.push_back({.time = 1.0 * k, .value = {k - 0.1, k + 0.1}});
        c.before.push_back({1.0 * k, k + 0.5});
        c.after.push_back({1.0 * k, 1.0 * k});
        c.misfit_before.push_back({1.0 * k, k == 7 ? 9.0 : 0.5});
    }
    c.measured[4].state = sivid::report::sample_state::suspect;
    return c;
}

} // namespace sivid_tests

#endif
