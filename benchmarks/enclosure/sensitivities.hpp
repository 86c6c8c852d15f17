// SPDX-License-Identifier: MIT
// Certified sensitivities: what they cost beside the states, and how wide they are.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_SENSITIVITIES_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_SENSITIVITIES_HPP

#include "measure.hpp"

#include <sivid/enclosure/sensitivity_tube.hpp>

namespace benchmark {

/// The least time of several runs [ms].
template <class F>
double least_time(F const& f) {
    double best = HUGE_VAL, total = 0;
    for (int run = 0; run < 200 && (run < 3 || total < 1); ++run) {
        auto const begin = std::chrono::steady_clock::now();
        f();
        double const t = seconds_since(begin);
        best = std::min(best, t);
        total += t;
    }
    return 1e3 * best;
}

inline double widest(sivid::interval_matrix<interval> const& s) {
    double w = 0;
    for (std::size_t i = 0; i < s.rows(); ++i) {
        for (std::size_t c = 0; c < s.cols(); ++c) w = std::max(w, sivid::width(s(i, c)));
    }
    return w;
}

/// Doubletons with and without derivatives.
inline void sensitivities_at_a_point(problem const& p) {
    if (!asked.wants(p.name)) return;
    for (std::size_t const order : {16, 20}) {
        sivid::enclosure_options o;
        o.order = o.variational_order = order;
        o.tolerance = 1e-16; // short steps: the derivatives follow no tolerance of their own
        o.relative_tolerance = 0;
        auto const tube = [&] {
            return sivid::integrate_with_sensitivities<interval>(p.flow, p.initial, p.parameters, 0,
                                                                 p.end, o);
        };
        auto const s = tube().at(p.end);
        double const alone = least_time([&] {
            (void)sivid::integrate<interval>(p.flow, p.initial, p.parameters, 0, p.end, o);
        });
        double const both = least_time([&] { (void)tube(); });
        std::printf(
            "%-26s doubleton   K%-2zu %6.3f ms (states alone %.3f ms), derivatives %.1e wide\n",
            p.name.c_str(), order, both, alone, widest(s));
    }
    std::fflush(stdout);
}

} // namespace benchmark

#endif
