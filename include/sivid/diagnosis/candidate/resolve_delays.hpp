// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_RESOLVE_DELAYS_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_RESOLVE_DELAYS_HPP

#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// A signal that acts `delay` later, and holds its value at `begin` until then.
///   The knots of a sampled signal move to the doubles nearest to t_k + delay.
[[nodiscard]] inline signal delayed(signal const& s, double delay, double begin) {
    if (delay == 0) return s;
    if (auto const* formula = std::get_if<analytic_signal>(&s)) {
        analytic_signal late;
        late.value = copy_into(late.g, formula->g, {formula->value}, [&](node const&, graph& g) {
                         auto const past = g.sub(g.leaf(operation::time, 0), g.constant(delay));
                         return g.binary(operation::max, past, g.constant(begin));
                     }).front();
        return late;
    }
    auto const& sampled = std::get<sampled_signal>(s);
    bool const holds = sampled.kind() == interpolation::hold;
    double const first = sampled.approximate(begin);
    double const first_error = sampled.error_bound(sampled.piece(begin), begin);
    std::vector<double> times{begin};
    std::vector<double> values{first};
    std::vector<double> errors{first_error};
    auto const add = [&](double t, double v, double e) {
        if (!(t > times.back())) return;
        times.push_back(t);
        values.push_back(v);
        errors.push_back(e);
    };
    if (!holds) add(begin + delay, first, first_error);
    for (std::size_t k = 0; k < sampled.times().size(); ++k) {
        if (!(sampled.times()[k] > begin)) continue;
        add(sampled.times()[k] + delay, sampled.values()[k],
            sampled.exact() ? 0 : sampled.errors()[k]);
    }
    if (sampled.exact()) errors.clear();
    return sampled_signal(std::move(times), std::move(values), sampled.kind(), std::move(errors));
}

/// A problem at one value of its delays, in which nothing is late any more.
struct delays_resolved {
    identification_problem problem; ///< without the delays among its unknowns
    std::vector<std::size_t> kept;  ///< its parameters, by index in the original problem
};

/// Fixes the delays at the values in `parameters` and moves inputs and measurements accordingly.
///   Moved times are rounded to the nearest double; everything else is exact.
/// @throws std::invalid_argument for a negative delay
[[nodiscard]] inline delays_resolved resolve_delays(identification_problem const& original,
                                                    std::vector<double> const& parameters) {
    delays_resolved result{original, {}};
    auto& problem = result.problem;
    auto& model = problem.model;
    auto const value_of = [&](time_delay const& d) {
        auto const& name = model.about.constants[d.constant].name;
        double value = model.about.constants[d.constant].nominal.nearest;
        if (auto const f = original.choice.fixed.find(name); f != original.choice.fixed.end()) {
            value = mid(f->second);
        }
        for (std::size_t j = 0; j < original.choice.unknown.size(); ++j) {
            if (original.choice.unknown[j] == name) value = parameters.at(j);
        }
        if (!(value >= 0)) throw std::invalid_argument("the delay '" + name + "' is negative");
        return value;
    };
    std::vector<bool> is_delay(model.about.constants.size(), false);
    for (auto& e : problem.experiments) {
        for (auto const& d : model.input_delays) {
            e.inputs[d.index] = delayed(e.inputs[d.index], value_of(d), e.begin);
        }
        for (auto& m : e.measurements) {
            double late = 0;
            for (auto const& d : model.channel_delays) {
                if (d.index == m.channel) late += value_of(d);
            }
            m.time = std::max(e.begin, m.time - late);
        }
        e.measurements = sorted(std::move(e.measurements));
    }
    for (auto const* all : {&model.input_delays, &model.channel_delays}) {
        for (auto const& d : *all) is_delay[d.constant] = true;
    }
    problem.choice.unknown.clear();
    std::vector<interval> prior;
    for (std::size_t j = 0; j < original.choice.unknown.size(); ++j) {
        auto const& name = original.choice.unknown[j];
        auto const k = index_of(model.about.constants, name, "constant");
        if (is_delay[k]) {
            problem.choice.fixed[name] = interval(parameters.at(j));
            continue;
        }
        problem.choice.unknown.push_back(name);
        prior.push_back(original.prior[j]);
        result.kept.push_back(j);
    }
    problem.prior = box(std::move(prior));
    model.input_delays.clear();
    model.channel_delays.clear();
    return result;
}

} // namespace sivid

#endif
