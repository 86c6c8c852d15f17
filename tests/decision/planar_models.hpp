// SPDX-License-Identifier: MIT
// Small predictions whose motions are known in closed form.
#ifndef SIVID_TESTS_DECISION_PLANAR_MODELS_HPP
#define SIVID_TESTS_DECISION_PLANAR_MODELS_HPP

#include "support/models.hpp"

#include <sivid/decision/prediction_problem.hpp>
#include <sivid/decision/verification.hpp>

#include <string>
#include <vector>

namespace decision_support {

using support::between;

/// x0' = -p0 x0 + u0 with y0 = x0 (without an input when `driven` is false).
inline sivid::prediction_problem decay(std::vector<sivid::box> sets, sivid::box initial,
                                       double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 1},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{-(c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0"};
    p.sets = std::move(sets);
    p.initial = std::move(initial);
    p.end = end;
    return p;
}

/// An oscillator x0'' = -p0^2 x0: x0(t) = cos(p0 t) from (1, 0).
inline sivid::prediction_problem oscillator(sivid::interval const& frequency, double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 2, .constants = 1},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{x[1], -(c[0] * c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0"};
    p.sets = {{frequency}};
    p.initial = {sivid::interval(1.0), sivid::interval(0.0)};
    p.end = end;
    return p;
}

/// x0' = p0 x0^2: reaches infinity at 1 / (p0 x0(0)).
inline sivid::prediction_problem explosion(sivid::interval const& rate, double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 1},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{c[0] * sqr(x[0])};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0"};
    p.sets = {{rate}};
    p.initial = {sivid::interval(1.0)};
    p.end = end;
    return p;
}

/// Every point of the problem is feasible.
inline sivid::feasible_points all_feasible(sivid::prediction_problem const& p) {
    return {&p, [](std::vector<double> const& x) { return std::vector<std::vector<double>>{x}; },
            [](std::vector<double> const&) { return true; }};
}

inline sivid::verification verified(sivid::prediction_problem p, std::string const& text,
                                    sivid::prediction_options const& options = {}) {
    auto const what = sivid::parse_requirement(text, p.model, p.end);
    return sivid::verify(p, what, all_feasible(p), options);
}

/// x' = -p0 x + p1 p2 u, y = x: a cart with drag and a drive.
inline sivid::prediction_problem driven_cart(double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 1, .constants = 3, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{c[1] * c[2] * u[0] - c[0] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    p.choice.unknown = {"p0", "p1"};
    p.choice.fixed["p2"] = sivid::interval(1.0);
    p.sets = {{between(0.3, 0.7), between(0.8, 1.2)}};
    p.inputs = {sivid::sampled_signal({0.0}, {0.0}, sivid::interpolation::hold)};
    p.initial = {sivid::interval(0.0)};
    p.end = end;
    return p;
}

/// x0' = x1 - p0 x0 behind an actuator x1' = 10 (u0 - x1) that an effect added: it begins at u0.
inline sivid::prediction_problem lagged_cart(double end) {
    sivid::prediction_problem p;
    p.model = support::model_of(
        {.states = 2, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{x[1] - c[0] * x[0], 10 * (u[0] - x[1])};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{x[0]}; });
    p.model.added_states = {{1, p.model.g.leaf(sivid::operation::input, 0)}};
    p.choice.unknown = {"p0"};
    p.sets = {{between(0.3, 0.7)}};
    p.inputs = {sivid::sampled_signal({0.0}, {0.0}, sivid::interpolation::hold)};
    p.initial = {sivid::interval(0.0), sivid::interval(0.0)};
    p.end = end;
    return p;
}

} // namespace decision_support

#endif
