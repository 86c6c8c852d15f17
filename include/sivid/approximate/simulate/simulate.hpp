// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_SIMULATE_HPP
#define SIVID_APPROXIMATE_SIMULATE_SIMULATE_HPP

#include <sivid/approximate/simulate/approximate_simulator.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// States (and outputs) of a simulated trajectory at requested times. Not a proof.
struct approximate_trajectory {
    std::vector<double> times;
    std::vector<std::vector<double>> states;  ///< [time][state]
    std::vector<std::vector<double>> outputs; ///< [time][channel]
};

/// How exactly, how and how long a trajectory is simulated.
struct simulation_options {
    double tolerance =
        1e-9; ///< of one step: absolute in the states' units, and a share of their size
    std::function<bool()> keep_going = nullptr; ///< false ends it
    stepping_maker steps = dormand_prince_steps;
};

/// Simulates a model in plain doubles by Boost.Odeint, with steps that end at the knots of its
/// inputs.
/// @param model       with the inputs that are given here; may be shared by many simulations
/// @param times       increasing, the first not before `from`
/// @throws std::domain_error when it gets stuck or was told to stop
[[nodiscard]] inline approximate_trajectory
simulate(std::shared_ptr<approximate_model const> model, std::vector<signal> const& inputs,
         std::vector<double> const& initial, std::vector<double> const& parameters, double from,
         std::vector<double> const& times, simulation_options const& options = {}) {
    std::vector<output_request> requests;
    auto const channels = model->channels();
    for (double const t : times) {
        for (std::size_t c = 0; c < channels; ++c) requests.push_back({t, c});
    }
    sensitivity_layout none;
    none.parameter_column.assign(model->parameters(), sensitivity_layout::none);
    none.start_column.assign(model->states(), sensitivity_layout::none);
    approximate_simulator run(model, inputs, from, std::move(requests),
                              std::vector<double>(model->states(), options.tolerance), times,
                              options.steps);
    run.set_accuracy(1, options.tolerance);
    run.set_keep_going(options.keep_going);
    simulated_outputs out;
    simulated_trace trace;
    if (!run(initial, parameters, {}, none, false, out, &trace)) {
        throw std::domain_error("the motion cannot be followed after t = " +
                                std::to_string(trace.times.empty() ? from : trace.times.back()) +
                                ": it is too fast, leaves the range of numbers, or was told to "
                                "stop; give smaller inputs and starts, or a shorter duration");
    }
    approximate_trajectory result;
    result.times = times;
    auto at = trace.times.begin();
    for (std::size_t k = 0; k < times.size(); ++k) {
        // Points of the mesh that differ by rounding only are one: the nearest is meant.
        while (std::next(at) != trace.times.end() &&
               std::abs(*std::next(at) - times[k]) <= std::abs(*at - times[k])) {
            ++at;
        }
        result.states.push_back(trace.states[static_cast<std::size_t>(at - trace.times.begin())]);
        result.outputs.emplace_back(out.values.begin() + static_cast<std::ptrdiff_t>(k * channels),
                                    out.values.begin() +
                                        static_cast<std::ptrdiff_t>((k + 1) * channels));
    }
    return result;
}

} // namespace sivid

#endif
