// SPDX-License-Identifier: MIT
// Certified sensitivities: what they cost beside the states, and how wide they are.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_SENSITIVITIES_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_SENSITIVITIES_HPP

#include "measure.hpp"

#include <sivid/enclosure/sensitivity/sensitive_flow.hpp>

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

/// The flow of Taylor models of a point, with and without derivatives.
inline void sensitivities_at_a_point(problem const& p) {
    if (!asked.wants(p.name)) return;
    for (std::size_t const order : {16u, 20u}) {
        sivid::enclosure_options o;
        o.order = order;
        o.tolerance = 1e-16; // short steps: the derivatives follow no tolerance of their own
        o.relative_tolerance = 0;
        sivid::sensitive_flow<> run(*p.flow, o, 0, 0);
        sivid::parametric_flow<> states(*p.flow, o, 0, 0);
        auto const follow = [&](auto& set) {
            set.begin(0, p.initial, p.parameters);
            while (set.time() < p.end && set.step(p.end)) {
            }
        };
        double const both = least_time([&] { follow(run); });
        double const alone = least_time([&] { follow(states); });
        double w = 0;
        for (std::size_t i = 0; i < p.initial.size(); ++i) {
            for (std::size_t c = 0; c < run.columns(); ++c) {
                w = std::max(w, sivid::width(range(run.derivative(i, c))));
            }
        }
        std::printf("%-26s D0          K%-2zu %6.3f ms (states alone %.3f ms), "
                    "derivatives %.1e wide\n",
                    p.name.c_str(), order, both, alone, w);
    }
    std::fflush(stdout);
}

/// Derivatives over a box against those of sampled members, each enclosed at its own point.
inline void sensitivities_over_a_box(std::size_t variables, std::size_t degree, problem const& p,
                                     setting const& s) {
    if (!asked.wants(p.name)) return;
    auto const o = s.options();
    sivid::sensitive_flow<> run(*p.flow, o, variables, degree);
    sivid::parametric_flow<> states(*p.flow, o, variables, degree);
    double const both = least_time([&] {
        run.begin(0, p.initial, p.parameters);
        while (run.time() < p.end && run.step(p.end)) {
        }
    });
    double const alone = least_time([&] {
        states.begin(0, p.initial, p.parameters);
        while (states.time() < p.end && states.step(p.end)) {
        }
    });
    std::printf("%-26s D%zu K%zu %6.3f ms (states alone %.3f ms)  ", p.name.c_str(), degree,
                s.order, both, alone);
    if (!run.known() || run.time() < p.end) {
        std::printf("not enclosed\n");
        return;
    }
    auto const n = p.initial.size();
    std::vector<double> low(n * run.columns(), HUGE_VAL), high(n * run.columns(), -HUGE_VAL);
    std::size_t missed = 0;
    std::size_t const samples = asked.more ? 1000 : 200;
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    sivid::enclosure_options sharp;
    sharp.order = 16;
    for (std::size_t k = 0; k < samples; ++k) {
        box c(p.parameters.size());
        for (std::size_t j = 0; j < c.size(); ++j) {
            double const share = k < 16 ? static_cast<double>((k >> j) & 1U) : unit(random);
            c[j] = interval(inside(p.parameters[j], share));
        }
        sivid::sensitive_flow<> member(*p.flow, sharp, 0, 0);
        member.begin(0, p.initial, c);
        while (member.time() < p.end && member.step(p.end)) {
        }
        bool all = true;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < run.columns(); ++j) {
                auto const exact = range(member.derivative(i, j));
                // Entries that are 0 or 1 have only rounding errors about them, of either run.
                all = all && !sivid::disjoint(exact, range(run.derivative(i, j)));
                auto const m = i * run.columns() + j;
                low[m] = std::min(low[m], mid(exact));
                high[m] = std::max(high[m], mid(exact));
            }
        }
        missed += all ? 0 : 1;
    }
    // Entries that vary by less than a thousandth of their size have no useful ratio of widths.
    double over = 0, beyond = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < run.columns(); ++j) {
            auto const m = i * run.columns() + j;
            double const seen = high[m] - low[m];
            double const size = std::max(std::abs(high[m]), std::abs(low[m]));
            if (size == 0) continue;
            double const found = sivid::width(range(run.derivative(i, j)));
            beyond = std::max(beyond, (found - seen) / size);
            if (seen > 1e-3 * size) over = std::max(over, found / seen);
        }
    }
    std::printf(
        "derivatives at most %.3f x the sampled range and %.1e of their size beyond it, %zu "
        "of %zu missed\n",
        over, beyond, missed, samples);
    std::fflush(stdout);
}

} // namespace benchmark

#endif
