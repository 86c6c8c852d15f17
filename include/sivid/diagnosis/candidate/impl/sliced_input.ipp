// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_SLICED_INPUT_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_SLICED_INPUT_IPP

#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>

#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/detail/late_channels.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/paving/relation/detail/untouched_relation.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

inline bool is_recorded(identification_problem const& problem, std::size_t input) {
    return std::all_of(problem.experiments.begin(), problem.experiments.end(),
                       [&](experiment const& e) {
                           return std::holds_alternative<sampled_signal>(e.inputs[input]);
                       });
}
/// Whether a recorded input has one value, which is exact.
inline bool stands_still(sampled_signal const& u) {
    auto const& v = u.values();
    return u.exact() && std::all_of(v.begin(), v.end(), [&](double x) { return x == v.front(); });
}
inline std::string full_name(effect const& e) { return e.name + "." + e.parameters[0].name; }

/// The problem with an effect as a line in its only parameter: its slope is a further input, by
/// which it acts, before all that is there already: what else changes the input sees the line.
/// Where the effect does not act, the slope is 0.
/// @param range  of the parameter, whose place the distance from its middle takes
/// @param form   (input, experiment, range) -> input_of_parameter
template <class Form>
[[nodiscard]] identification_problem with_line(identification_problem const& base, effect e,
                                               std::size_t input, interval const& range,
                                               Form const& form) {
    auto const acts = [in = e](experiment const& x) { return in.acts_in(x.name); };
    e.only_in.clear();
    for (auto const& x : base.experiments) e.only_in.push_back(x.name);
    e.parameters[0].neutral = decimal{}; // where its slope is 0, it does nothing
    e.threshold.reset();
    auto const name = base.model.about.inputs[input].name;
    e.on_inputs = [name](effect_scope& h) { h.input(name) += h.parameter(); };
    auto problem = affected(base, {e});
    auto const slope = index_of(problem.model.about.inputs, e.name, "input");
    auto& side = problem.prior[problem.prior.size() - 1];
    side = interval_traits<interval>::sub(range, interval(mid(range)));
    for (auto& x : problem.experiments) {
        if (!acts(x)) {
            x.inputs[slope] = sampled_signal({x.begin}, {0.0}, interpolation::hold);
            continue;
        }
        input_of_parameter line = form(std::get<sampled_signal>(x.inputs[input]), x, range);
        side = interval_traits<interval>::sub(range, interval(line.at));
        x.inputs[slope] = std::move(line.slope);
        x.inputs[input] = std::move(line.middle);
    }
    return problem;
}

/// One parameter that changes a recorded input, taken out of the effects.
struct input_change {
    std::size_t effect, input;
    sliced_input::side side;
    std::optional<signal_memory> memory; ///< none: a threshold

    /// The problem with this change over a range of its parameter.
    [[nodiscard]] identification_problem
    operator()(identification_problem base, sivid::effect const& e, interval const& range) const {
        if (side.is_parameter) {
            auto const form = [&](auto const& u, experiment const& x, interval const& all) {
                if (!memory)
                    return threshold_by_parameter(u, x.begin, x.end(), e.threshold->stands, all);
                return memory->kind == memory_kind::rate_limit
                           ? limited_by_parameter(u, x.begin, x.end(), all)
                           : late_by_parameter(u, x.begin, x.end(), all);
            };
            return with_line(base, e, input, range, form);
        }
        for (auto& x : base.experiments)
            if (e.acts_in(x.name)) x.inputs[input] = remembered_within(x, *memory, range);
        return base;
    }
    /// Whether it does nothing in an experiment.
    [[nodiscard]] bool idle_in(experiment const& x, sivid::effect const& e) const {
        if (!e.acts_in(x.name)) return true;
        auto const& u = std::get<sampled_signal>(x.inputs[input]);
        return stands_still(u) &&
               (memory ? memory->kind != memory_kind::play : u.values().front() == 0);
    }
};

/// The problem over a box, with the delay or play of a constant of the model, or of an effect that
/// changes other things too, as an error of the input.
[[nodiscard]] inline identification_problem with_errors(identification_problem const& whole,
                                                        signal_memory const& memory, std::size_t j,
                                                        box const& all) {
    auto problem = resolve_memory(whole, mid(all)).problem;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto const& x = whole.experiments[s];
        if (!acts_in(memory, x.inputs)) continue;
        problem.experiments[s].inputs[memory.index] = remembered_within(x, memory, all[j]);
    }
    std::vector<interval> sides(all.begin(), all.end());
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(j));
    problem.prior = box(std::move(sides));
    // Equations may read it, too: there it is any value.
    problem.choice.fixed[problem.model.about.constants[memory.constant].name] = all[j];
    start_added_states(problem);
    return problem;
}

/// The problem with further experiments.
[[nodiscard]] inline identification_problem joined(identification_problem base,
                                                   std::vector<experiment> const& beside) {
    base.experiments.insert(base.experiments.end(), beside.begin(), beside.end());
    return base;
}

/// Finds the parameters to be sliced.
class sliced_input_finder {
public:
    sliced_input_finder(identification_problem const& base, std::vector<effect> const& effects,
                        std::vector<experiment> const& beside)
        : base_(&base),
          effects_(&effects),
          whole_(affected(diagnosis_detail::joined(base, beside), effects)) {}

    [[nodiscard]] std::optional<sliced_input> operator()() {
        auto const& memory = whole_.model.input_memory;
        // What is seen for a time only is behind a copy, which is not among the recorded inputs.
        if (whole_.model.input_copies.size() > base_->model.input_copies.size())
            return std::nullopt;
        for (auto const& m : memory) {
            auto const change = change_by(m);
            if (change) {
                changes_.push_back(*change);
                // Two inputs by one parameter: both have errors.
                for (auto& c : changes_)
                    if (c.effect == change->effect && &c != &changes_.back())
                        c.side.is_parameter = changes_.back().side.is_parameter = false;
            } else {
                bool const alone = memory.size() == 1 && whole_.model.channel_delays.empty();
                return alone ? by_errors(m) : std::nullopt;
            }
        }
        if (!whole_.model.channel_delays.empty() && !find_late_sensor()) return std::nullopt;
        for (std::size_t k = 0; k < effects_->size(); ++k)
            if (auto const change = change_by_threshold(k)) changes_.push_back(*change);
        for (auto const& c : changes_) {
            auto const same = [&](input_change const& other) { return other.input == c.input; };
            if (std::count_if(changes_.begin(), changes_.end(), same) > 1) return std::nullopt;
        }
        if (changes_.empty() && !late_) return std::nullopt;
        return joined();
    }

private:
    [[nodiscard]] std::size_t side_of(effect const& e) const {
        return index_of_parameter(whole_, full_name(e));
    }
    /// Whether an effect does nothing but remember: without its edits the equations, the channels
    /// and the starts are the same, and none reads its parameter.
    [[nodiscard]] bool only_remembers(std::size_t k, std::size_t constant) const {
        auto idle = *effects_;
        idle[k].on_inputs = idle[k].on_rates = idle[k].on_channels = nullptr;
        auto const without = with(base_->model, idle);
        auto const& own = whole_.model;
        if (without.rate.size() != own.rate.size()) return false;
        paving_detail::same_expressions same(own.g, without.g);
        auto read = own.rate;
        read.insert(read.end(), own.observe.begin(), own.observe.end());
        auto other = without.rate;
        other.insert(other.end(), without.observe.begin(), without.observe.end());
        for (auto const& a : own.added_states) read.push_back(a.at_begin);
        for (auto const& a : without.added_states) other.push_back(a.at_begin);
        for (std::size_t i = 0; i < read.size(); ++i)
            if (!same(read[i], other[i])) return false;
        auto const used = leaves_of(own.g, read, operation::constant);
        return std::find(used.begin(), used.end(), constant) == used.end();
    }
    /// The effect that is nothing but this memory, with one parameter.
    [[nodiscard]] std::optional<input_change> change_by(signal_memory const& m) const {
        auto const& name = whole_.model.about.constants[m.constant].name;
        if (!is_recorded(whole_, m.index)) return std::nullopt;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            if (e.parameters.size() != 1 || full_name(e) != name || !only_remembers(k, m.constant))
                continue;
            auto const j = side_of(e);
            if (j == whole_.prior.size() || !has_meaning(m.kind, whole_.prior[j]))
                return std::nullopt;
            auto const linear = [&](experiment const& x) {
                return std::get<sampled_signal>(x.inputs[m.index]).kind() == interpolation::linear;
            };
            auto const& all = whole_.experiments;
            bool const line =
                m.kind == memory_kind::rate_limit ||
                (m.kind == memory_kind::delay && std::all_of(all.begin(), all.end(), linear));
            return input_change{k, m.index, {j, line}, m};
        }
        return std::nullopt;
    }
    [[nodiscard]] std::optional<input_change> change_by_threshold(std::size_t k) const {
        auto const& e = (*effects_)[k];
        if (!e.threshold || !e.only_in.empty() || e.parameters.size() != 1) return std::nullopt;
        auto const input = index_of(base_->model.about.inputs, e.threshold->input, "input");
        for (auto const& m : whole_.model.input_memory)
            if (m.index == input) return std::nullopt; // what it sees is changed before
        auto const j = side_of(e);
        bool const exact = j < whole_.prior.size() && whole_.prior[j].lower() >= 0;
        if (!exact || !is_recorded(whole_, input) ||
            !finds_as_recorded(base_->model, *effects_, k, e.threshold->input))
            return std::nullopt;
        return input_change{k, input, {j, true}, std::nullopt};
    }
    /// Channels that show the past, each once, by one effect that does nothing else.
    [[nodiscard]] bool find_late_sensor() {
        // A switch in time would have to be late, too.
        if (std::any_of(effects_->begin(), effects_->end(),
                        [](effect const& e) { return e.begins_later() || e.ends(); }))
            return false;
        auto const& model = whole_.model;
        auto const constant = model.channel_delays.front().constant;
        late_channels_.assign(model.about.channels.size(), false);
        for (auto const& d : model.channel_delays) {
            if (d.constant != constant || d.kind != memory_kind::delay) return false;
            if (late_channels_[d.index]) return false; // it is late by twice as much
            late_channels_[d.index] = true;
        }
        auto const of_time = [&](node_id n) { return (model.g.depends(n) & on_time) != 0; };
        for (std::size_t y = 0; y < late_channels_.size(); ++y)
            if (late_channels_[y] && of_time(model.observe[y])) return false;
        for (std::size_t i = 0; i < base_->model.about.inputs.size(); ++i)
            if (!is_recorded(whole_, i)) return false;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            bool const only = e.parameters.size() == 1 && !e.on_rates && !e.on_inputs;
            if (!only || full_name(e) != model.about.constants[constant].name) continue;
            if (!only_remembers(k, constant)) return false;
            auto const j = side_of(e);
            if (j == whole_.prior.size() || !(whole_.prior[j].lower() >= 0)) return false;
            late_ = k;
            late_side_ = j;
            return true;
        }
        return false;
    }

    [[nodiscard]] std::optional<sliced_input> by_errors(signal_memory const& m) const {
        auto const j = index_of_parameter(whole_, whole_.model.about.constants[m.constant].name);
        if (j == whole_.prior.size() || !has_meaning(m.kind, whole_.prior[j]) ||
            !is_recorded(whole_, m.index))
            return std::nullopt;
        return sliced_input{{{j, false}},
                            [whole = affected(*base_, *effects_), m, j](box const& all) {
                                return with_errors(whole, m, j, all);
                            },
                            std::nullopt};
    }
    [[nodiscard]] sliced_input joined() const {
        sliced_input result;
        std::vector<effect> others; // than the changes and the late sensor
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            if (late_ != k && std::none_of(changes_.begin(), changes_.end(),
                                           [&](input_change const& c) { return c.effect == k; }))
                others.push_back((*effects_)[k]);
        }
        for (auto const& c : changes_) {
            bool const known = std::any_of(result.sides.begin(), result.sides.end(),
                                           [&c](auto const& s) { return s.index == c.side.index; });
            if (!known) result.sides.push_back(c.side);
        }
        if (late_) result.sides.push_back({late_side_, true});
        auto const names = whole_.choice.unknown;
        result.over = [names, others, base = base_, effects = effects_, changes = changes_,
                       late = late_, late_side = late_side_,
                       late_channels = late_channels_](box const& all) {
            auto problem = affected(*base, others);
            for (auto const& c : changes)
                problem = c(std::move(problem), (*effects)[c.effect], all[c.side.index]);
            if (late) {
                problem =
                    with_late_channels(problem, (*effects)[*late], late_channels, all[late_side]);
            }
            for (std::size_t j = 0; j < names.size(); ++j) {
                auto const k = index_of_parameter(problem, names[j]);
                bool const shifted =
                    (late && j == late_side) ||
                    std::any_of(changes.begin(), changes.end(),
                                [&](input_change const& c) { return c.side.index == j; });
                if (k < problem.prior.size() && !shifted) problem.prior[k] = all[j];
            }
            start_added_states(problem);
            return problem;
        };
        result.untouched = untouched(others);
        return result;
    }
    [[nodiscard]] std::optional<identification_problem>
    untouched(std::vector<effect> const& others) const {
        auto problem = affected(*base_, others);
        std::vector<experiment> kept;
        for (auto& x : problem.experiments) {
            bool const idle =
                std::all_of(changes_.begin(), changes_.end(), [&](input_change const& c) {
                    return c.idle_in(x, (*effects_)[c.effect]);
                });
            if (late_ && (*effects_)[*late_].acts_in(x.name))
                std::erase_if(x.measurements,
                              [&](auto const& m) { return late_channels_[m.channel]; });
            x.outliers = std::min(x.outliers, x.measurements.size());
            if (idle && !x.measurements.empty()) kept.push_back(std::move(x));
        }
        if (kept.empty() || problem.prior.size() == 0) return std::nullopt;
        problem.experiments = std::move(kept);
        return problem;
    }

    identification_problem const* base_;
    std::vector<effect> const* effects_;
    identification_problem whole_; ///< whose experiments decide the form
    std::vector<input_change> changes_;
    std::optional<std::size_t> late_; ///< the effect that is a late sensor
    std::size_t late_side_ = 0;
    std::vector<bool> late_channels_;
};

/// Whether a factor is an unknown that stands for its distance from the middle of a slice.
inline bool has_shifted(combination const& c, sliced_input const& sliced) {
    return std::any_of(sliced.sides.begin(), sliced.sides.end(),
                       [&](auto const& s) { return s.is_parameter && c.has(s.index); });
}

} // namespace diagnosis_detail

SIVID_DECL std::optional<sliced_input> sliced_input_of(identification_problem const& base,
                                                       std::vector<effect> const& effects,
                                                       std::vector<experiment> const& beside) {
    return diagnosis_detail::sliced_input_finder(base, effects, beside)();
}

SIVID_DECL std::optional<explained_hull>
explained_by(identification_problem const& whole, sliced_input const& sliced, explained_hull all,
             identification_problem const& over, explained_hull const& found) {
    using traits = interval_traits<interval>;
    for (std::size_t j = 0; j < all.parameters.size(); ++j) {
        auto const k = index_of_parameter(over, whole.choice.unknown[j]);
        if (k == found.parameters.size()) continue;
        auto left = found.parameters[k];
        auto& side = all.parameters[j];
        for (auto const& s : sliced.sides)
            if (s.index == j && s.is_parameter) left = traits::add(interval(mid(side)), left);
        side = intersect(left, side);
        if (is_empty(side)) return std::nullopt;
    }
    for (auto const& p : found.products) {
        auto told = reordered(p, over.choice.unknown, whole.choice.unknown);
        if (told && !diagnosis_detail::has_shifted(told->what, sliced)) {
            all.add(std::move(*told));
        }
    }
    return all;
}

SIVID_DECL std::vector<combination_hull>
products_in(identification_problem const& over, identification_problem const& whole,
            sliced_input const& sliced, std::vector<combination_hull> const& products) {
    std::vector<combination_hull> result;
    for (auto const& p : products) {
        if (diagnosis_detail::has_shifted(p.what, sliced)) continue;
        if (auto told = reordered(p, whole.choice.unknown, over.choice.unknown)) {
            result.push_back(std::move(*told));
        }
    }
    return result;
}

} // namespace sivid

#endif
