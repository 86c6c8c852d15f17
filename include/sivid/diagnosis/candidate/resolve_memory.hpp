// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_RESOLVE_MEMORY_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_RESOLVE_MEMORY_HPP

#include <sivid/measurement/dead_time.hpp>
#include <sivid/measurement/limited_signal.hpp>
#include <sivid/measurement/played_signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// A signal that acts later, and holds its value at `begin` until then.
///   The knots of a sampled signal move to the doubles nearest to when they are seen.
[[nodiscard]] inline signal delayed(signal const& s, dead_time const& late, double begin) {
    if (!late.any()) return s;
    if (auto const* formula = std::get_if<analytic_signal>(&s)) {
        analytic_signal moved;
        moved.value = copy_into(moved.g, formula->g, {formula->value}, [&](node const&, graph& g) {
                          auto const t = g.leaf(operation::time, 0), first = g.constant(begin);
                          auto past = g.sub(t, g.constant(late.delay));
                          if (late.drift > 0)
                              past = g.sub(past, g.mul(g.constant(late.drift), g.sub(t, first)));
                          return g.binary(operation::max, past, first);
                      }).front();
        return moved;
    }
    auto const& sampled = std::get<sampled_signal>(s);
    bool const holds = sampled.kind() == interpolation::hold;
    double const first = sampled.approximate(begin);
    double const first_error = sampled.error_bound(sampled.piece(begin), begin);
    std::vector<double> times{begin};
    std::vector<double> values{first};
    std::vector<double> errors{first_error};
    auto const add = [&](double t, double v, double e) {
        if (!(t > times.back() && t < std::numeric_limits<double>::infinity())) return;
        times.push_back(t);
        values.push_back(v);
        errors.push_back(e);
    };
    if (!holds) add(late.seen(begin, begin), first, first_error);
    for (std::size_t k = 0; k < sampled.times().size(); ++k) {
        if (!(sampled.times()[k] > begin)) continue;
        add(late.seen(sampled.times()[k], begin), sampled.values()[k],
            sampled.exact() ? 0 : sampled.errors()[k]);
    }
    // The last line goes on to the right.
    auto const last = sampled.times().size() - 1;
    if (!holds && last > 0 && !(sampled.times()[last] > begin) && late.drift < 1) {
        double const piece = sampled.times()[last] - sampled.times()[last - 1];
        double const far = begin + std::max(piece, std::abs(begin));
        auto const value = sampled.value<interval>(sampled.piece(far), interval(far));
        add(late.seen(far, begin), mid(value), rad(value) + sampled.error_bound(last, far));
    } else if (sampled.exact()) {
        errors.clear();
    }
    return sampled_signal(std::move(times), std::move(values), sampled.kind(), std::move(errors));
}

/// Whether delays, plays, drifts or rate limits of all these sizes mean something.
[[nodiscard]] inline bool has_meaning(memory_kind kind, interval const& sizes) {
    return kind == memory_kind::rate_limit ? sizes.lower() > 0 : sizes.lower() >= 0;
}

/// The size of a memory at a point of the parameters.
[[nodiscard]] inline double size_of(identification_problem const& problem, signal_memory const& m,
                                    std::vector<double> const& parameters) {
    auto const& own = problem.model.about.constants[m.constant];
    auto const& unknown = problem.choice.unknown;
    auto const j = std::find(unknown.begin(), unknown.end(), own.name) - unknown.begin();
    if (static_cast<std::size_t>(j) < unknown.size())
        return parameters.at(static_cast<std::size_t>(j));
    auto const f = problem.choice.fixed.find(own.name);
    return f != problem.choice.fixed.end() ? mid(f->second) : own.nominal.nearest;
}

/// Whether some input or channel has a memory whose size means nothing there.
[[nodiscard]] inline bool remembers_nonsense(identification_problem const& problem,
                                             std::vector<double> const& parameters) {
    auto const is_nonsense = [&](signal_memory const& m) {
        return !has_meaning(m.kind, interval(size_of(problem, m, parameters)));
    };
    auto const& model = problem.model;
    return std::ranges::any_of(model.input_memory, is_nonsense) ||
           std::ranges::any_of(model.channel_delays, is_nonsense);
}

/// A problem at one value of its delays, plays and rate limits, in which no signal has a memory any
/// more.
struct memory_resolved {
    identification_problem problem; ///< without their sizes among its unknowns
    std::vector<std::size_t> kept;  ///< its parameters, by index in the original problem
};

/// A recorded input behind a play or a rate limit of any size in a range.
[[nodiscard]] inline sampled_signal resolved_input(sampled_signal const& u, memory_kind kind,
                                                   experiment const& x, interval const& size) {
    return kind == memory_kind::play ? played(u, x.begin, x.end(), size).within
                                     : rate_limited(u, x.begin, x.end(), size).within;
}

/// Whether some input that is a formula is behind a play or a rate limit: only recorded ones can be
/// resolved.
[[nodiscard]] inline bool remembers_formulas(identification_problem const& problem) {
    for (auto const& d : problem.model.input_memory) {
        if (is_dead_time(d.kind)) continue;
        for (auto const& e : problem.experiments) {
            bool const formula = std::holds_alternative<analytic_signal>(e.inputs[d.index]);
            if (formula && acts_in(d, e.inputs)) return true;
        }
    }
    return false;
}

/// What counts the readings of a channel, at the times of which they tell. Any count is possible
/// where some are later than others, or of before the begin: counts would change places.
/// @param late  of the readings; nothing: not all alike
[[nodiscard]] inline sampled_signal
counts_of_late(sampled_signal const& counts, std::optional<dead_time> const& late, double begin) {
    std::vector<double> times;
    bool apart = late.has_value();
    for (std::size_t k = 0; apart && k < counts.times().size(); ++k) {
        times.push_back(late->source(counts.times()[k], begin));
        apart = k == 0 || times[k] > times[k - 1];
    }
    if (apart) return {std::move(times), counts.values(), interpolation::hold};
    auto const [least, most] = std::minmax_element(counts.values().begin(), counts.values().end());
    return {{begin}, {0.5 * (*least + *most)}, interpolation::hold, {0.5 * (*most - *least)}};
}

namespace diagnosis_detail {

/// What a problem's memories are at a point of its parameters.
struct memories_at {
    identification_problem const& original;
    std::vector<double> const& parameters;

    [[nodiscard]] double size(signal_memory const& d) const {
        double const value = size_of(original, d, parameters);
        if (!has_meaning(d.kind, interval(value)))
            throw std::invalid_argument("'" + original.model.about.constants[d.constant].name +
                                        "' is negative, or the limit of a rate and not above 0");
        return value;
    }
    void add_to(dead_time& late, signal_memory const& d) const {
        (d.kind == memory_kind::drift ? late.drift : late.delay) += size(d);
    }
    /// How late a channel of an experiment is at a time.
    [[nodiscard]] dead_time lateness(experiment const& e, std::size_t channel, double time) const {
        dead_time shown;
        for (auto const& d : original.model.channel_delays)
            if (d.index == channel && acts_at(d, e.inputs, time)) add_to(shown, d);
        return shown;
    }
    /// The same of all its readings in an experiment, and at its begin; nothing: not all alike.
    [[nodiscard]] std::optional<dead_time> common_lateness(experiment const& e,
                                                           std::size_t channel) const {
        auto const common = lateness(e, channel, e.begin);
        for (auto const& m : e.measurements)
            if (m.channel == channel && !(lateness(e, channel, m.time) == common))
                return std::nullopt;
        return common;
    }
};

/// Puts inputs behind their rate limits, then behind their plays, and makes them late.
inline void resolve_inputs(experiment& e, memories_at const& at) {
    auto const& memories = at.original.model.input_memory;
    for (auto const kind : {memory_kind::rate_limit, memory_kind::play}) {
        for (auto const& d : memories) {
            if (d.kind != kind || !acts_in(d, e.inputs)) continue;
            auto& u = e.inputs[d.index];
            u = resolved_input(std::get<sampled_signal>(u), kind, e, interval(at.size(d)));
        }
    }
    std::vector<dead_time> late(e.inputs.size());
    for (auto const& d : memories)
        if (is_dead_time(d.kind) && acts_in(d, e.inputs)) at.add_to(late[d.index], d);
    for (std::size_t i = 0; i < late.size(); ++i)
        e.inputs[i] = delayed(e.inputs[i], late[i], e.begin);
}

/// Moves what counts readings of late channels with them.
/// @param recorded  the experiment as it was
inline void move_counts(experiment& e, experiment const& recorded, memories_at const& at) {
    auto const& model = at.original.model;
    for (auto const& d : model.channel_delays) {
        auto const common = at.common_lateness(e, d.index);
        auto const read = operands_of(model.g, {model.observe[d.index]});
        for (std::size_t k = 0; k < read.size(); ++k) {
            auto const& n = model.g.nodes()[k];
            if (!read[k] || n.op != operation::input) continue;
            auto const i = static_cast<std::size_t>(n.index);
            if (!counts_readings(model.about.inputs[i].name)) continue;
            if (auto const* u = std::get_if<sampled_signal>(&recorded.inputs[i]))
                e.inputs[i] = counts_of_late(*u, common, e.begin);
        }
    }
}

/// Fixes the sizes of memories among the unknowns; the others are kept.
inline void fix_sizes(memory_resolved& result, memories_at const& at) {
    auto const& original = at.original;
    std::vector<bool> is_size(original.model.about.constants.size(), false);
    for (auto const* all : {&original.model.input_memory, &original.model.channel_delays}) {
        for (auto const& d : *all) is_size[d.constant] = true;
    }
    auto& problem = result.problem;
    problem.choice.unknown.clear();
    std::vector<interval> prior;
    for (std::size_t j = 0; j < original.choice.unknown.size(); ++j) {
        auto const& name = original.choice.unknown[j];
        if (is_size[index_of(original.model.about.constants, name, "constant")]) {
            problem.choice.fixed[name] = interval(at.parameters.at(j));
            continue;
        }
        problem.choice.unknown.push_back(name);
        prior.push_back(original.prior[j]);
        result.kept.push_back(j);
    }
    problem.prior = box(std::move(prior));
}

} // namespace diagnosis_detail

/// Fixes delays, plays and rate limits at the values in `parameters`, moves inputs and measurements
/// accordingly, and puts inputs behind their limits, then behind their plays, with errors that
/// cover the roundings.
///   Times that a delay moves are rounded to the nearest double; everything else is exact.
/// @throws std::invalid_argument  for a size that means nothing (`has_meaning`), and for a play or
///         a rate limit of a formula
[[nodiscard]] inline memory_resolved resolve_memory(identification_problem const& original,
                                                    std::vector<double> const& parameters) {
    if (remembers_formulas(original))
        throw std::invalid_argument("a play or a rate limit needs a recorded input");
    require_own_memory(original.model, original.choice);
    diagnosis_detail::memories_at const at{original, parameters};
    memory_resolved result{original, {}};
    auto& problem = result.problem;
    for (std::size_t x = 0; x < problem.experiments.size(); ++x) {
        auto& e = problem.experiments[x];
        diagnosis_detail::resolve_inputs(e, at);
        diagnosis_detail::move_counts(e, original.experiments[x], at);
        for (auto& m : e.measurements) {
            m.time = at.lateness(e, m.channel, m.time).source(m.time, e.begin);
        }
        e.measurements = sorted(std::move(e.measurements));
    }
    diagnosis_detail::fix_sizes(result, at);
    problem.model.input_memory.clear();
    problem.model.channel_delays.clear();
    return result;
}

} // namespace sivid

#endif
