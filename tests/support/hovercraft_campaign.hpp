// SPDX-License-Identifier: MIT
// Recorded campaigns of the hovercraft, simulated here by small fixed steps: five manoeuvres, with
// whatever effect a test puts in.
#ifndef SIVID_TESTS_SUPPORT_HOVERCRAFT_CAMPAIGN_HPP
#define SIVID_TESTS_SUPPORT_HOVERCRAFT_CAMPAIGN_HPP

#include "support/models.hpp"
#include "support/random.hpp"

#include "../../examples/hovercraft/model.hpp"
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace support {

using motion = std::array<double, 6>;   ///< u, v, r, x, y, psi
using controls = std::array<double, 2>; ///< W, delta
using hover_constants = std::array<double, 17>;

/// What the real craft does otherwise than the model.
struct hover_effect {
    /// Adds to the rates at (t, x, u, constants).
    std::function<void(double, motion const&, controls const&, hover_constants const&, motion&)>
        rates;
    /// The inputs that act, from those that were recorded: (t, recorded(t), recorded signal).
    std::function<controls(double, std::function<controls(double)> const&)> inputs;
    /// What the sensors show: (t, motion(t), motion at any time).
    std::function<motion(double, std::function<motion(double)> const&)> sensors;
    /// Changes the constants.
    std::function<void(hover_constants&)> constants;
    /// One more state driven through (t, z, controls) -> z', seen by `inputs_of_state`.
    std::function<double(double, double, controls const&)> filter;
    std::function<controls(double, controls const&)> filtered;
    std::function<double(controls const&)> filter_start;
};

struct hover_options {
    std::map<std::string, double> truth = {}; ///< overrides of constants
    std::map<std::string, sivid::interval> priors{
        {"Sv", between(0.2, 0.25)}, {"Sg", between(0.0042, 0.0754)}, {"L", between(0.25, 0.35)}};
    bool uncertain_starts = false;
    bool poses_only = false;
    double outlier_fraction = 0;
    double share = 1; ///< of the durations
};

inline std::size_t hover_constant(std::string const& name) {
    for (std::size_t k = 0; k < hovercraft::constants.size(); ++k) {
        if (hovercraft::constants[k].name == name) return k;
    }
    throw std::invalid_argument(name);
}

/// Equations (2.1) to (2.3), written once more.
inline motion hover_rates(motion const& x, controls const& input, hover_constants const& c) {
    auto const& [u, v, r, px, py, psi] = x;
    auto const& [m, Iz, rho, Cd, CL, Cdelta, D, Su, Sv, Sg, A, L, Ff, eps, D11, D22, D33] = c;
    double const thrust = Cdelta * rho * std::pow(D, 4) * input[0] * input[0];
    double const lift = CL * thrust * input[1] / (4 * A);
    double const speed = std::sqrt(u * u + v * v + eps * eps);
    double const drag = 0.5 * rho * Cd * speed;
    return {v * r + (thrust - Ff * u / speed - drag * Su * u - D11 * u) / m,
            -u * r + (Sv * lift - Ff * v / speed - drag * Sv * v - D22 * v) / m,
            (-L * Sg * lift - D33 * r) / Iz,
            u * std::cos(psi) - v * std::sin(psi),
            u * std::sin(psi) + v * std::cos(psi),
            r};
}

inline sivid::identification_problem hovercraft_campaign(draws& d, hover_effect const& effect,
                                                         hover_options const& options) {
    using namespace sivid;
    struct manoeuvre {
        char const* name;
        double duration;
        motion start;
        std::function<controls(double)> command;
    };
    std::vector<manoeuvre> const list{
        {"S1",
         1,
         {0.1, 0, 0, 0, 0, 0},
         [](double) {
             return controls{250, 0};
         }},
        {"S2",
         10,
         {2, 0, 0, 0, 0, 0},
         [](double) {
             return controls{0, 0};
         }},
        {"S3",
         3,
         {2, 0, 0, 0, 0, 0},
         [](double t) {
             return controls{250.0 / 3, 0.2617994 * (1 + std::sin(std::acos(-1.0) / 2 * t))};
         }},
        {"S4",
         6,
         {1, 0, 0, 0, 0, 0},
         [](double t) {
             return controls{90, 0.35 * std::sin(1.2 * t)};
         }},
        {"S5", 6, {0.5, 0, 0, 0, 0, 0}, [](double t) {
             return controls{100 + 30 * std::sin(0.9 * t), -0.1 + 0.25 * std::sin(0.7 * t + 0.6)};
         }}};
    hover_constants c{};
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = nearest(hovercraft::constants[k].nominal);
    for (auto const& [name, value] : options.truth) c[hover_constant(name)] = value;
    if (effect.constants) effect.constants(c);
    identification_problem problem;
    problem.model = record_model(hovercraft{});
    std::vector<interval> sides;
    for (auto const& [name, prior] : options.priors) {
        problem.choice.unknown.push_back(name);
        sides.push_back(prior);
    }
    problem.prior = box(sides.size());
    for (std::size_t j = 0; j < sides.size(); ++j) problem.prior[j] = sides[j];
    for (auto const& m : list) {
        double const duration = m.duration * options.share;
        std::vector<double> times, w, delta;
        for (int k = 0; k * 0.05 <= duration + 0.051; ++k) {
            times.push_back(k * 0.05);
            auto const u = m.command(times.back());
            w.push_back(u[0]);
            delta.push_back(u[1]);
        }
        experiment e;
        e.name = m.name;
        sampled_signal const signal_w(times, w, interpolation::linear);
        sampled_signal const signal_delta(times, delta, interpolation::linear);
        e.inputs = {signal_w, signal_delta};
        std::function<controls(double)> const recorded = [&](double t) {
            return controls{signal_w.approximate(t), signal_delta.approximate(t)};
        };
        motion start = m.start;
        e.initial = box(6);
        double const spread[] = {0.02, 0.02, 0.03, 0, 0, 0};
        for (std::size_t i = 0; i < 6; ++i) {
            e.initial[i] = interval(start[i]);
            if (!options.uncertain_starts || spread[i] == 0) continue;
            e.initial[i] = around(start[i], spread[i]);
            start[i] += d.uniform(-spread[i], spread[i]);
        }
        // Small fixed steps of the classical method.
        double const h = 0.0025;
        std::vector<motion> path{start};
        double z = effect.filter_start ? effect.filter_start(recorded(0)) : 0;
        auto const rate = [&](double t, motion const& x, double state, double& dz) {
            auto u = effect.inputs ? effect.inputs(t, recorded) : recorded(t);
            dz = effect.filter ? effect.filter(t, state, u) : 0;
            if (effect.filtered) u = effect.filtered(state, u);
            auto dx = hover_rates(x, u, c);
            if (effect.rates) effect.rates(t, x, u, c, dx);
            return dx;
        };
        auto const steps = static_cast<std::size_t>(std::lround(duration / h));
        for (std::size_t k = 0; k < steps; ++k) {
            double const t = static_cast<double>(k) * h;
            auto const x = path.back();
            auto const moved = [&](motion const& s, double by) {
                motion y = x;
                for (std::size_t i = 0; i < 6; ++i) y[i] += by * s[i];
                return y;
            };
            double z1 = 0, z2 = 0, z3 = 0, z4 = 0;
            auto const k1 = rate(t, x, z, z1);
            auto const k2 = rate(t + h / 2, moved(k1, h / 2), z + h / 2 * z1, z2);
            auto const k3 = rate(t + h / 2, moved(k2, h / 2), z + h / 2 * z2, z3);
            auto const k4 = rate(t + h, moved(k3, h), z + h * z3, z4);
            motion next = x;
            for (std::size_t i = 0; i < 6; ++i) {
                next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
            }
            z += h / 6 * (z1 + 2 * z2 + 2 * z3 + z4);
            path.push_back(next);
        }
        std::function<motion(double)> const seen = [&](double t) {
            double const k = std::clamp(t / h, 0.0, static_cast<double>(steps));
            auto const at = std::min(static_cast<std::size_t>(k), steps - 1);
            double const s = k - static_cast<double>(at);
            motion x{};
            for (std::size_t i = 0; i < 6; ++i) {
                x[i] = (1 - s) * path[at][i] + s * path[at + 1][i];
            }
            return x;
        };
        double const error[] = {0.02, 0.02, 0.05, 0.02, 0.02, 0.03};
        std::size_t const first = options.poses_only ? 3 : 0;
        for (int k = 1; k * 0.1 <= duration + 1e-9; ++k) {
            double const t = k * 0.1;
            auto const y = effect.sensors ? effect.sensors(t, seen) : seen(t);
            for (std::size_t i = first; i < 6; ++i) {
                double const value = y[i] + d.uniform(-1, 1) * error[i];
                e.measurements.push_back({t, i, around(value, error[i])});
            }
        }
        e.outliers = static_cast<std::size_t>(options.outlier_fraction *
                                              static_cast<double>(e.measurements.size()));
        for (std::size_t k = 0; k < e.outliers; ++k) {
            auto& bad = e.measurements[d.below(e.measurements.size())];
            double const jump = (d.coin() ? 1 : -1) * d.uniform(5, 50) * error[bad.channel];
            bad.bound = around(mid(bad.bound) + jump, error[bad.channel]);
        }
        problem.experiments.push_back(std::move(e));
    }
    return problem;
}

} // namespace support

#endif
