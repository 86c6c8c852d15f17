// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_PLANNED_EXPERIMENT_HPP
#define SIVID_APP_DETAIL_PLANNED_EXPERIMENT_HPP

#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/decision/promised_width.hpp>
#include <sivid/io/scenario.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::app {

/// Inputs that may be chosen, with their limits as they were written, as near as doubles are.
/// @throws bad_request
[[nodiscard]] inline std::vector<varied_input>
varied_inputs(std::vector<std::string> const& told,
              std::vector<model_description::item> const& inputs) {
    std::vector<varied_input> result;
    for (auto const& [name, range] : ranges_from(told, "--vary")) {
        auto const index = index_of(inputs, name, "input");
        if (is_one_value(range))
            throw bad_request("--vary " + name + ": give limits, such as " + name + "=0:100");
        auto const written = [](double end) {
            return few_digits(-HUGE_VAL, HUGE_VAL, end, 1e-15 * std::abs(end));
        };
        result.push_back(
            {index, name, inputs[index].unit, written(range.lower()), written(range.upper())});
    }
    return result;
}

/// What is measured, when, with which errors: as it is told, or as in the data.
/// @param errors  such as psi=0.01; none: the largest of each channel
/// @param period  [s]; 0: that of the first experiment
/// @throws bad_request
[[nodiscard]] inline planned_measurements planned_from(std::vector<std::string> const& errors,
                                                       double period, double end,
                                                       identification_problem const& data) {
    auto const& channels = data.model.about.channels;
    std::vector<double> bounds(channels.size(), 0.0);
    auto const told = ranges_from(errors, "--measure");
    for (auto const& [name, bound] : told) {
        double const error = one_value("--measure " + name, bound);
        if (!(error > 0)) throw bad_request("--measure " + name + ": the error must be above 0");
        bounds[index_of(channels, name, "channel")] = error;
    }
    std::set<double> times;
    for (auto const& e : data.experiments) {
        for (auto const& m : e.measurements) {
            double const half = 0.5 * width(m.bound);
            if (told.empty() && std::isfinite(half))
                bounds[m.channel] = std::max(bounds[m.channel], half);
            if (&e == &data.experiments.front()) times.insert(m.time);
        }
    }
    // Half the width of a rounded interval is no decimal any more; what is told stays as it is.
    auto const readable = [](double x) { return few_digits(0, HUGE_VAL, x, 1e-9 * std::abs(x)); };
    for (auto& b : bounds)
        if (told.empty()) b = readable(b);
    if (period == 0)
        period = times.size() < 2 ? end / 30
                                  : readable((*times.rbegin() - *times.begin()) /
                                             static_cast<double>(times.size() - 1));
    return planned_measurements::every(period, end, std::move(bounds));
}

/// A scenario with other inputs, as a file.
/// @param name    empty: that of the scenario and "-design"
/// @param inputs  lines between samples, where they vary
[[nodiscard]] inline std::string scenario_with(scenario_description s, std::string const& name,
                                               std::string const& about,
                                               std::vector<varied_input> const& varied,
                                               std::vector<signal> const& inputs,
                                               model_names const& names) {
    s.name = name.empty() ? s.name + "-design" : name;
    s.about = about;
    for (auto const& u : varied) {
        auto const& samples = std::get<sampled_signal>(inputs[u.index]);
        auto& shape = s.inputs[u.index];
        shape = {};
        shape.shape = input_shape::kind::samples;
        shape.times = samples.times();
        shape.values = samples.values();
    }
    return scenario_json(s, names);
}

} // namespace sivid::app

#endif
