// SPDX-License-Identifier: MIT
// One row of the engine's benchmark: time, steps, width over the sampled true range, containment of
// sampled trajectories. One thread; the least time of several runs.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_MEASURE_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_MEASURE_HPP

#include "parametric_cover.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/tube.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace benchmark {
using sivid::box;
using sivid::interval;
using sivid::lanes;

struct problem {
    std::string name;
    std::shared_ptr<sivid::flow const> flow;
    box initial, parameters;
    double end = 1;
};

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

inline double inside(interval const& x, double share) {
    return x.lower() + share * (x.upper() - x.lower());
}

/// Range of the ends of sampled trajectories, corners included, and how many leave the parts' sets.
struct sampled {
    std::vector<double> low, high;
    std::size_t missed = 0;
    std::size_t drawn = 0;
};

template <class Cover>
sampled sample(problem const& p, Cover const& cover, std::size_t count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    auto const model = std::make_shared<sivid::approximate_model const>(p.flow->model());
    auto const n = p.initial.size();
    auto const side_of = [&](std::size_t i) -> interval const& {
        return i < n ? p.initial[i] : p.parameters[i - n];
    };
    // Corners of the sides that have a width: which ends of the others were taken would not matter.
    std::vector<std::size_t> bit;
    std::size_t varying = 0;
    for (std::size_t i = 0; i < n + p.parameters.size(); ++i) {
        bit.push_back(varying % 8);
        varying += sivid::width(side_of(i)) > 0 ? 1 : 0;
    }
    std::size_t const corners = std::size_t{1} << std::min<std::size_t>(varying, 8);
    sampled s;
    s.low.assign(n, HUGE_VAL);
    s.high.assign(n, -HUGE_VAL);
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<double> x0, c;
        for (std::size_t i = 0; i < bit.size(); ++i) {
            double const share =
                k < corners ? static_cast<double>((k >> bit[i]) & 1U) : unit(random);
            (i < n ? x0 : c).push_back(inside(side_of(i), share));
        }
        auto const end =
            sivid::simulate(model, p.flow->inputs(), x0, c, 0, {p.end}, {1e-11}).states.back();
        bool found = false, inside_one = false;
        for (auto const& part : cover.parts) {
            bool member = true;
            for (std::size_t i = 0; i < n; ++i) member = member && contains(part.initial[i], x0[i]);
            for (std::size_t j = 0; j < c.size(); ++j) {
                member = member && contains(part.parameters[j], c[j]);
            }
            if (!member) continue;
            found = true;
            auto const hull = part.set.hull();
            bool all = true;
            for (std::size_t i = 0; i < n; ++i) {
                double const slack = 1e-8 * (1 + std::abs(end[i])); // of the simulation
                all = all && hull[i].lower() - slack <= end[i] && end[i] <= hull[i].upper() + slack;
            }
            inside_one = inside_one || all;
        }
        s.missed += found && !inside_one ? 1 : 0;
        ++s.drawn;
        for (std::size_t i = 0; i < n; ++i) {
            s.low[i] = std::min(s.low[i], end[i]);
            s.high[i] = std::max(s.high[i], end[i]);
        }
    }
    return s;
}

/// An independent enclosure of the same point must meet this one.
inline std::string meets_doubleton(problem const& p, box const& hull) {
    sivid::enclosure_options options;
    options.order = 20;
    options.tolerance = 1e-14;
    options.relative_tolerance = 0;
    auto const tube =
        sivid::integrate<interval>(p.flow, p.initial, p.parameters, 0, p.end, options);
    if (!tube.complete()) return "the doubleton failed";
    double widest = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (sivid::disjoint(hull[i], tube.end().hull[i])) return "DISJOINT FROM THE DOUBLETON";
        widest = std::max(widest, sivid::width(tube.end().hull[i]));
    }
    char text[64];
    std::snprintf(text, sizeof text, "meets the doubleton (%.1e)", widest);
    return text;
}

/// The hull's width over the sampled range, and what was missed.
template <class Cover>
void print_excess(problem const& p, Cover const& cover, box const& hull, std::size_t samples,
                  std::string const& goal) {
    auto const seen = sample(p, cover, samples);
    double over = 0, rest = 0; // of states that hardly vary: their width, no ratio
    for (std::size_t i = 0; i < hull.size(); ++i) {
        double const range = seen.high[i] - seen.low[i];
        if (range > 1e-9 * p.flow->model().about.states[i].limit) {
            over = std::max(over, sivid::width(hull[i]) / range);
        } else {
            rest = std::max(rest, sivid::width(hull[i]));
        }
    }
    std::printf("%.4f x the sampled range, ", over);
    if (rest > 0) std::printf("constant states %.0e wide, ", rest);
    std::printf("%zu of %zu missed  [%s]\n", seen.missed, seen.drawn, goal.c_str());
}

struct setting {
    std::size_t order = 8;
    double tolerance = 1e-5, relative = 1e-4;
    std::size_t halvings = 0;
    double minimum_step = 1e-3;
    std::size_t samples = 1000;

    [[nodiscard]] sivid::enclosure_options options() const {
        sivid::enclosure_options result;
        result.order = order;
        result.tolerance = tolerance;
        result.relative_tolerance = relative;
        result.minimum_step = minimum_step;
        return result;
    }
};

/// What the command line asks for.
struct request {
    std::string only;  ///< part of a problem's name; empty for all
    bool more = false; ///< the slow rows too

    [[nodiscard]] bool wants(std::string const& name) const {
        return name.find(only) != std::string::npos;
    }
};
inline request asked;

/// By Taylor models in so many variables, one by one or in lanes.
template <class C>
void measure(std::size_t variables, std::size_t degree, problem const& p, setting const& s,
             std::string const& goal) {
    constexpr std::size_t width = sivid::lane_traits<C>::count;
    if (!asked.wants(p.name)) return;
    auto const options = s.options();
    cover_options const choice{.first_halvings = s.halvings};
    parametric_cover result;
    double best = HUGE_VAL;
    double total = 0;
    for (int run = 0; run < 25 && (run < 3 || total < 1); ++run) {
        auto const begin = std::chrono::steady_clock::now();
        result = cover<C>(variables, degree, *p.flow, options, p.initial, p.parameters, 0, p.end,
                          choice);
        double const t = seconds_since(begin);
        best = std::min(best, t);
        total += t;
    }
    std::size_t steps = 0;
    for (auto const& part : result.parts) steps = std::max(steps, part.steps);
    std::printf("%-26s D%zu K%-2zu x%zu %9.3f ms %4zu steps %3zu parts %2zu failed  ",
                p.name.c_str(), degree, s.order, width, 1e3 * best, steps, result.parts.size(),
                result.failed);
    if (!result.complete()) {
        std::printf("not enclosed: %s  [%s]\n", result.failure->message("x").c_str(), goal.c_str());
        return;
    }
    auto const hull = result.hull();
    double widest = 0;
    for (auto const& x : hull) widest = std::max(widest, sivid::width(x));
    bool const point = sivid::normalised_unknowns(p.initial, p.parameters).variables == 0;
    if (point) {
        std::printf("width %.1e, %s  [%s]\n", widest, meets_doubleton(p, hull).c_str(),
                    goal.c_str());
    } else {
        print_excess(p, result, hull, s.samples, goal);
    }
    std::fflush(stdout);
}

/// The whole box in one doubleton.
inline void measure_doubleton(problem const& p, setting const& s, std::string const& goal) {
    if (!asked.wants(p.name)) return;
    auto const options = s.options();
    double best = HUGE_VAL, total = 0;
    std::size_t steps = 0;
    struct family {
        struct set_type {
            box end;
            [[nodiscard]] box hull() const { return end; }
        };
        struct part {
            box initial, parameters;
            set_type set;
        };
        std::vector<part> parts;
    } found;
    for (int run = 0; run < 25 && (run < 3 || total < 1); ++run) {
        auto const begin = std::chrono::steady_clock::now();
        auto const tube =
            sivid::integrate<interval>(p.flow, p.initial, p.parameters, 0, p.end, options);
        double const t = seconds_since(begin);
        best = std::min(best, t);
        total += t;
        steps = tube.steps().size();
        if (!tube.complete()) {
            std::printf("%-26s doubleton  not enclosed: %s\n", p.name.c_str(),
                        tube.failure()->message("x").c_str());
            return;
        }
        found.parts = {{p.initial, p.parameters, {tube.end().hull}}};
    }
    std::printf("%-26s doubleton  %9.3f ms %4zu steps                      ", p.name.c_str(),
                1e3 * best, steps);
    print_excess(p, found, found.parts[0].set.end, s.samples, goal);
    std::fflush(stdout);
}

} // namespace benchmark

#endif
