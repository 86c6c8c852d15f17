// SPDX-License-Identifier: MIT
// Records of machines, as long and as dense as their loggers write them, each identified from a
// cold start:
//     sivid_benchmark_robots [--seconds S] [--no-windows] [--as-recorded] [--equations] [--growth]
//     [NAME...]
// Beside the hulls, in shares of the prior, stands a plain least-squares fit of the same record
// (not proved). Beside the seconds: what the work clock counts for each of the processor.
// --as-recorded: no search with slower inputs first. --equations: what the
// state equations leave of the prior by themselves, no trajectory. --growth: how the cost grows
// with samples, constants, states, experiments.
#include "machines.hpp"
#include "model.hpp"
#include "recording.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace robots;

template <bool DryFriction>
driven moving_arm() {
    return {record_model(arm<DryFriction>()), {0, 0.5, 0, 0}, [](double t, values const& x) {
                return values{2 * std::cos(x[0]) - 3 * (x[0] - 0.8 * std::sin(1.3 * t + 1)) -
                                  0.3 * x[2] + 1.5 * std::sin(3.1 * t) + std::sin(7 * t + 2),
                              0.5 + std::sin(1.9 * t) - x[1] - 0.05 * x[3] +
                                  0.5 * std::sin(4.3 * t + 1) + 0.4 * std::sin(9 * t)};
            }};
}
driven moving_turning_arm() {
    return {record_model(turning_arm()), {0, -0.8, 0.4, 0, 0, 0}, [](double t, values const& x) {
                double const near = std::cos(x[1]), far = std::cos(x[1] + x[2]);
                return values{4 * (0.8 * std::sin(0.9 * t) - x[0]) - x[3] + std::sin(3.3 * t) +
                                  0.8 * std::sin(7.1 * t + 1),
                              9 * near + 3 * far + 6 * (0.4 * std::sin(1.3 * t + 1) - 0.8 - x[1]) -
                                  x[4] + 2 * std::sin(3.1 * t) + 1.5 * std::sin(7 * t + 2),
                              3 * far + 3 * (0.5 * std::sin(1.9 * t) + 0.4 - x[2]) - 0.3 * x[5] +
                                  std::sin(4.3 * t + 1) + 0.8 * std::sin(9 * t)};
            }};
}
driven driven_car() {
    return {record_model(car()),
            {0, 0, 0, 15, 0, 0},
            [](double t, values const& x) {
                return values{0.05 * std::sin(0.9 * t) + 0.03 * std::sin(2.3 * t + 1),
                              15 + 3 * std::sin(0.2 * t) - x[3]};
            },
            {1, 1, 0.1, 1, 1, 0.2}};
}
driven flown_quadrotor() {
    return {record_model(quadrotor()),
            values(12),
            [](double t, values const& s) {
                auto const limited = [](double a) { return std::clamp(a, -0.5, 0.5); };
                double const ax = 1.5 * (2 * std::sin(0.6 * t) - s[0]) - 2 * s[6],
                             ay = 1.5 * (2 * std::sin(0.8 * t) - s[1]) - 2 * s[7],
                             az = 2 * (std::sin(0.5 * t) - s[2]) - 2 * s[8];
                return values{1.2 * (9.81 + az),
                              0.012 * (60 * (limited(-ay / 9.81) - s[3]) - 12 * s[9]),
                              0.013 * (60 * (limited(ax / 9.81) - s[4]) - 12 * s[10]),
                              0.022 * (4 * (std::sin(0.7 * t) - s[5]) - 3 * s[11])};
            },
            {1, 1, 1, 0.5, 0.5, 0.5, 2, 2, 2}};
}
driven driven_battery() {
    return {record_model(battery()), {0, 0, 0.9}, [](double t, values const&) {
                double const burst = std::fmod(t, 300) < 180 ? 1 : -0.3;
                return values{3 * burst + 2 * std::sin(0.21 * t) + std::sin(0.9 * t)};
            }};
}
driven climbing_quadrotor() {
    return {record_model(altitude()), {1, 0, 9.81}, [](double t, values const& x) {
                double const wanted = std::fmod(t, 4) < 2 ? 4 : 1;
                return values{9.81 / 0.011 + 60 * (wanted - x[0]) - 60 * x[1]};
            }};
}
driven heated_barrel() {
    return {record_model(barrel()), {0, 0}, [](double t, values const& x) {
                double const wanted = t < 750 ? 150 : 180;
                return values{std::clamp(0.05 * (wanted - x[1]), 0.0, 1.0)};
            }};
}
template <class Machine>
driven pushed() {
    return {record_model(Machine()), values(state_count<Machine>), [](double t, values const&) {
                return values{2 * std::sin(1.1 * t) + 2 * std::sin(2.3 * t + 1) +
                              std::sin(4.1 * t)};
            }};
}
driven driven_mass() {
    return {record_model(oscillator()), {0.3, -0.4}, [](double t, values const&) {
                return values{std::sin(1.3 * t) > 0 ? 3.0 : -3.0};
            }};
}
driven sailed_hovercraft() {
    return {record_model(hovercraft()), {0.5, 0, 0, 0, 0, 0}, [](double t, values const&) {
                return values{110 + 20 * std::sin(0.4 * t), 0.4 * std::sin(0.5 * t)};
            }};
}

struct machine {
    recording how;
    driven (*make)();
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The sides of what is left, in shares of the prior; each holds the truth, or else that is said.
void show_sides(box const& left, box const& prior) {
    bool contains_truth = true;
    for (std::size_t j = 0; j < left.size(); ++j) {
        std::printf(" %.3g", 100 * width(left[j]) / width(prior[j]));
        contains_truth = contains_truth && contains(left[j], mid(prior[j]));
    }
    std::printf("%s", contains_truth ? "" : " TRUTH LOST");
}

void show_equations(machine const& m) {
    auto const problem = record_of(m.make(), m.how);
    auto const begin = std::chrono::steady_clock::now();
    work_watch const counted;
    auto const left = contract_by_relations(problem);
    double const seconds = seconds_since(begin);
    std::printf("%s, equations alone, %% of the prior:", m.how.what.c_str());
    show_sides(left, problem.prior);
    std::printf(" (%.2f s, counted %.2f times)\n", seconds, counted.spent() / seconds);
    std::fflush(stdout);
}

void show(machine const& m, identify_options const& options) {
    auto const problem = record_of(m.make(), m.how);
    auto const begin = std::chrono::steady_clock::now();
    auto const fitted = fit(problem, fit_norm::squares);
    double const fit_seconds = seconds_since(begin);
    work_watch const work;
    auto const processor = std::clock();
    auto const found = identify(problem, options);
    double const busy = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
    std::printf("%s: %s, %s, %.1f s (counted %.2f times), %zu boxes", m.how.what.c_str(),
                std::string{to_string(found.verdict)}.c_str(),
                std::string{to_string(found.reason)}.c_str(), found.seconds, work.spent() / busy,
                found.boxes);
    for (auto const& r : found.journal) {
        if (!r.asked()) continue;
        std::printf("; %s %s, left %.3g of the volume in %.1f s", r.by.c_str(),
                    std::string{to_string(r.how)}.c_str(), r.left, r.seconds);
        for (auto const& [name, value] : r.figures) std::printf(", %s %.3g", name.c_str(), value);
    }
    std::printf("\n  left %.3g of the prior's volume, hulls, %% of the prior:",
                found.paving.outer_volume().upper());
    show_sides(found.hull, problem.prior);
    std::printf("\n  least squares off by, %% of the prior:");
    for (std::size_t j = 0; j < fitted.parameters.size(); ++j) {
        auto const& side = problem.prior[j];
        std::printf(" %.2g", 100 * std::abs(fitted.parameters[j] - mid(side)) / width(side));
    }
    std::printf(" (%.2f s)\n", fit_seconds);
    std::fflush(stdout);
}

/// Seconds and widest hull over sizes, and the exponent from each size to the next.
struct family {
    std::string what;
    std::vector<std::size_t> sizes;
    std::function<machine(std::size_t)> make;
};

void show_growth(family const& f, identify_options const& options) {
    std::printf("%s:", f.what.c_str());
    double last_seconds = 0, last_size = 0;
    for (auto const size : f.sizes) {
        auto const m = f.make(size);
        auto const problem = record_of(m.make(), m.how);
        auto const found = identify(problem, options);
        double widest = 0;
        for (std::size_t j = 0; j < found.hull.size(); ++j) {
            widest = std::max(widest, 100 * width(found.hull[j]) / width(problem.prior[j]));
        }
        std::printf(" %zu: %.3f s (%.3g %%", size, found.seconds, widest);
        if (last_size > 0) {
            std::printf(", exponent %.2f", std::log(found.seconds / last_seconds) /
                                               std::log(static_cast<double>(size) / last_size));
        }
        std::printf(")");
        std::fflush(stdout);
        last_seconds = found.seconds;
        last_size = static_cast<double>(size);
    }
    std::printf("\n");
}

machine chain_with(std::size_t constants) {
    std::vector<std::string> unknown;
    for (std::size_t k = 0; k < constants; ++k) {
        unknown.push_back((k % 2 == 0 ? "k" : "d") + std::to_string(k / 2 + 1));
    }
    return {{"", 20, 5, 0.1, 0.01, 0.25, 0, 1, 0, unknown}, pushed<chain>};
}

template <template <std::size_t> class Machine>
machine of_size(std::size_t states) {
    recording const how{"", 10, 5, 0.2, 0.01, 0.2};
    switch (states) {
    case 2:
        return {how, pushed<Machine<2>>};
    case 4:
        return {how, pushed<Machine<4>>};
    case 8:
        return {how, pushed<Machine<8>>};
    case 16:
        return {how, pushed<Machine<16>>};
    case 32:
        return {how, pushed<Machine<32>>};
    default:
        return {how, pushed<Machine<64>>};
    }
}

} // namespace

int main(int argc, char** argv) {
    std::vector<std::string> const report{"Sv", "L", "Sg"};
    std::vector<machine> const all{
        {{"arm, 10 s, torque at 100 Hz, +-10 %"}, moving_arm<false>},
        {{"arm, 10 s, torque at 1 kHz, +-10 %", 10, 100, 0.001}, moving_arm<false>},
        {{"arm, 10 s, torque at 100 Hz, +-15 %", 10, 100, 0.01, 0.002, 0.15}, moving_arm<false>},
        {{"arm, 10 s, torque at 100 Hz, +-10 %, start +-0.1", 10, 100, 0.01, 0.002, 0.1, 0.1},
         moving_arm<false>},
        {{"arm, 10 s, torque at 1 kHz, +-10 %, start +-0.1", 10, 100, 0.001, 0.002, 0.1, 0.1},
         moving_arm<false>},
        {{"arm, 10 s, torque at 1 kHz, +-20 %", 10, 100, 0.001, 0.002, 0.2}, moving_arm<false>},
        {{"arm of three joints, 10 s, torque at 100 Hz, +-10 %"}, moving_turning_arm},
        {{"arm of three joints, 10 s, torque at 1 kHz, +-20 %", 10, 100, 0.001, 0.002, 0.2},
         moving_turning_arm},
        {{"arm with dry friction, 10 s, torque at 1 kHz, +-10 %", 10, 100, 0.001},
         moving_arm<true>},
        {{"arm with dry friction, 10 s, torque at 1 kHz, +-20 %", 10, 100, 0.001, 0.002, 0.2},
         moving_arm<true>},
        {{"car, 30 s, +-20 %", 30, 100, 0.01, 0.05, 0.2}, driven_car},
        {{"quadrotor, 20 s, +-20 %", 20, 50, 0.02, 0.01, 0.2}, flown_quadrotor},
        {{"quadrotor, 20 s, +-20 %, start +-0.05", 20, 50, 0.02, 0.01, 0.2, 0.05}, flown_quadrotor},
        {{"altitude of a quadrotor, 6 s, +-30 %, start +-0.3", 6, 50, 0.02, 0.01, 0.3, 0.3},
         climbing_quadrotor},
        {{"barrel of an extruder, 25 min, +-30 %, start +-1", 1500, 0.4, 2.5, 0.5, 0.3, 1},
         heated_barrel},
        {{"battery, 1 h, +-20 %", 3600, 1, 1, 0.002, 0.2, 0, 1, 0, {}, 0.1}, driven_battery},
        {{"chain of 6 masses, 20 s, +-25 %", 20, 5, 0.1, 0.01, 0.25}, pushed<chain>},
        {{"chain of 32 masses, 10 s, +-20 %", 10, 5, 0.2, 0.01, 0.2}, pushed<long_chain<64>>},
        {{"cascade of 64 states, 10 s, +-20 %", 10, 5, 0.2, 0.01, 0.2}, pushed<cascade<64>>},
        {{"oscillator, 100 s, start +-1", 100, 10, 0.1, 0.02, 0.3, 1}, driven_mass},
        {{"oscillator, 10 s, start +-1", 10, 10, 0.1, 0.02, 0.3, 1}, driven_mass},
        {{"oscillator, 100 records of 5 s, start +-0.05", 5, 10, 0.1, 0.02, 0.3, 0.05, 100},
         driven_mass},
        {{"oscillator, 20 s, 50 outliers of 200 allowed", 20, 10, 0.1, 0.02, 0.3, 0, 1, 50},
         driven_mass},
        {{"motor, 1e5 samples of 10 s", 10, 1e4, 0.1, 0.05, 0.3}, pushed<motor>},
        {{"hovercraft, 600 s at 10 Hz", 600, 10, 0.1, 0.05, 0.3, 0, 1, 0, report},
         sailed_hovercraft}};
    std::vector<family> const growing{
        {"samples of a motor in 10 s",
         {100, 1000, 10000, 100000, 1000000},
         [](std::size_t n) {
             return machine{{"", 10, static_cast<double>(n) / 10, 0.1, 0.05, 0.3}, pushed<motor>};
         }},
        {"seconds of a hovercraft at 10 Hz",
         {3, 10, 30, 100, 300},
         [report](std::size_t n) {
             return machine{{"", static_cast<double>(n), 10, 0.1, 0.05, 0.3, 0, 1, 0, report},
                            sailed_hovercraft};
         }},
        {"constants of a chain of 6 masses", {1, 2, 4, 8, 12}, chain_with},
        {"states of a chain", {2, 4, 8, 16, 32, 64}, of_size<long_chain>},
        {"states of a cascade", {2, 4, 8, 16, 32, 64}, of_size<cascade>},
        {"records of an oscillator, starts known", {1, 10, 100}, [](std::size_t n) {
             return machine{{"", 5, 10, 0.1, 0.02, 0.3, 0, n}, driven_mass};
         }}};
    identify_options options;
    options.search.seconds = 30; // counted: about ten of a core with AVX-512
    options.only_hulls = true;
    bool growth = false, equations = false;
    std::vector<std::string> chosen;
    for (int k = 1; k < argc; ++k) {
        std::string_view const word = argv[k];
        if (word == "--seconds" && k + 1 < argc) {
            options.search.seconds = std::atof(argv[++k]);
        } else if (word == "--no-windows") {
            options.strategy = options.strategy.without("shapes")
                                   .without("state equations")
                                   .without("interval observers")
                                   .without("growing window")
                                   .without("guided windows")
                                   .without("windows all along");
        } else if (word == "--as-recorded") {
            options.strategy = options.strategy.without("slower inputs");
        } else if (word == "--equations") {
            equations = true;
        } else if (word == "--growth") {
            growth = true;
        } else {
            chosen.emplace_back(word);
        }
    }
    auto const wanted = [&chosen](std::string const& what) {
        return chosen.empty() ||
               std::any_of(chosen.begin(), chosen.end(),
                           [&what](auto const& name) { return what.starts_with(name); });
    };
    if (growth) {
        for (auto const& f : growing) {
            if (wanted(f.what)) show_growth(f, options);
        }
        return 0;
    }
    for (auto const& m : all) {
        if (!wanted(m.how.what)) continue;
        equations ? show_equations(m) : show(m, options);
    }
}
