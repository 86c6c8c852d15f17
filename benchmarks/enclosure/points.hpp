// SPDX-License-Identifier: MIT
// Points side by side in the lanes of one flow.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_POINTS_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_POINTS_HPP

#include "measure.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

namespace benchmark {

/// The eight corners of a problem's box of three parameters, each as a point, at once.
inline void measure_corners(problem const& p, setting const& s, std::string const& goal) {
    if (!asked.wants(p.name)) return;
    auto const options = s.options();
    std::array<problem, 8> points;
    for (std::size_t l = 0; l < points.size(); ++l) {
        points[l] = p;
        for (std::size_t j = 0; j < p.parameters.size(); ++j) {
            auto const& side = p.parameters[j];
            points[l].parameters[j] = interval((l >> j) % 2 == 0 ? side.lower() : side.upper());
        }
    }
    std::optional<sivid::parametric_flow<sivid::taylor_model<lanes<8>>>> run;
    double best = HUGE_VAL, total = 0;
    for (int k = 0; k < 50 && (k < 3 || total < 1); ++k) {
        auto const begin = std::chrono::steady_clock::now();
        run.emplace(*p.flow, options, 0, 0);
        for (std::size_t l = 0; l < points.size(); ++l) {
            run->begin(l, 0, points[l].initial, points[l].parameters);
        }
        for (bool open = true; open;) {
            (void)run->advance(lanes<8>(p.end));
            open = false;
            for (std::size_t l = 0; l < points.size(); ++l) {
                open = open || (!run->failure(l) && run->time(l) < p.end);
            }
        }
        double const t = seconds_since(begin);
        best = std::min(best, t);
        total += t;
    }
    double widest = 0;
    std::size_t steps = 0, met = 0;
    for (std::size_t l = 0; l < points.size(); ++l) {
        if (run->failure(l)) {
            std::printf("%s: corner %zu not enclosed: %s\n", p.name.c_str(), l,
                        run->failure(l)->message("x").c_str());
            return;
        }
        auto const hull = lane_of(run->set(), l).hull();
        for (auto const& x : hull) widest = std::max(widest, sivid::width(x));
        steps = std::max(steps, run->steps(l));
        met += meets_doubleton(points[l], hull).starts_with("meets") ? 1 : 0;
    }
    std::printf("%-26s D0 K%-2zu x8 %9.3f ms %4zu steps, width %.1e, %zu of 8 meet the doubleton  "
                "[%s]\n",
                p.name.c_str(), s.order, 1e3 * best, steps, widest, met, goal.c_str());
    std::fflush(stdout);
}

} // namespace benchmark

#endif
