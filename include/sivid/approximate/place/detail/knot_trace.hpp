// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_KNOT_TRACE_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_KNOT_TRACE_HPP

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// What a fitted motion does at the knots of the missing rates of one experiment.
struct knot_trace {
    std::vector<double> times; ///< since the experiment's begin
    std::vector<std::vector<double>> states, inputs, input_slopes;
    /// d rate / d input: [knot][state * inputs + input]
    std::vector<std::vector<double>> by_input;
};

/// @returns an empty trace when the simulation fails
[[nodiscard]] inline knot_trace trace_at_knots(approximate_campaign& c, std::size_t e,
                                               arrow_vector const& z) {
    knot_trace result;
    simulated_trace seen;
    auto const& knots = c.knots(e);
    if (!c.trace(e, z, seen) || seen.times.size() < 2) return result;
    auto const& model = c.model(e);
    auto const& f = model.rate();
    auto memory = f.expansion.memory();
    auto const p = c.parameters(z);
    auto const& shape = model.shape();
    std::copy(p.begin(), p.end(), memory.begin() + static_cast<std::ptrdiff_t>(shape.constant()));
    f.expansion.prepare(memory);
    double const begin = c.problem().experiments[e].begin;
    double const close = 1e-9 * (seen.times.back() - seen.times.front()); // but for rounding
    for (auto const knot : knots) {
        auto const above = std::upper_bound(seen.times.begin(), seen.times.end(), knot + close);
        auto const last = static_cast<std::ptrdiff_t>(seen.times.size()) - 2;
        auto const k = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(above - seen.times.begin() - 1, 0, last));
        double const length = seen.times[k + 1] - seen.times[k];
        double const share = std::clamp((knot - seen.times[k]) / length, 0.0, 1.0);
        auto const between = [&](std::vector<std::vector<double>> const& v) {
            auto out = v[k];
            for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * (v[k + 1][i] - v[k][i]);
            return out;
        };
        result.times.push_back(knot - begin);
        result.states.push_back(between(seen.states));
        result.inputs.push_back(between(seen.inputs));
        auto& slope = result.input_slopes.emplace_back(shape.inputs);
        for (std::size_t i = 0; i < slope.size(); ++i) {
            slope[i] = (seen.inputs[k + 1][i] - seen.inputs[k][i]) / length;
        }
        memory[0] = knot;
        std::copy(result.states.back().begin(), result.states.back().end(), memory.begin() + 1);
        std::copy(result.inputs.back().begin(), result.inputs.back().end(),
                  memory.begin() + static_cast<std::ptrdiff_t>(shape.input()));
        f.expansion.run(memory);
        auto& d = result.by_input.emplace_back(shape.states * shape.inputs, 0.0);
        for (auto const& entry : f.by_input) {
            d[entry.row * shape.inputs + entry.column] = memory[entry.slot];
        }
    }
    return result;
}

} // namespace sivid

#endif
