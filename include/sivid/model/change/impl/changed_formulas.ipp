// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_IMPL_CHANGED_FORMULAS_IPP
#define SIVID_MODEL_CHANGE_IMPL_CHANGED_FORMULAS_IPP

#include <sivid/model/change/changed_formulas.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/graph/detail/formula_text.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// "sensor_lag.u" of "sensor_lag(u:v)~0.5.u": what stands in brackets is known.
[[nodiscard]] inline std::string short_name(std::string const& name) {
    auto const opens = name.find_first_of("('~@"), dot = name.rfind('.');
    return opens < dot && dot != name.npos ? name.substr(0, opens) + name.substr(dot) : name;
}

[[nodiscard]] inline std::map<std::string, std::string>
symbols_of(model_description const& about, std::vector<effect> const& effects) {
    std::multiset<std::string> used{"t"};
    auto const use = [&used](auto const& all) {
        for (auto const& x : all) used.insert(x.name);
    };
    use(about.states);
    use(about.inputs);
    use(about.constants);
    for (auto const& e : effects) use(e.parameters);
    std::map<std::string, std::string> result;
    for (std::size_t k = 0; k < effects.size(); ++k) {
        for (auto const& p : effects[k].parameters) {
            auto symbol = p.name;
            if (used.count(symbol) > 1) symbol += "_" + std::to_string(k + 1);
            result[effects[k].name + "." + p.name] = std::move(symbol);
        }
    }
    return result;
}

/// Reads the changes off models in which more and more edits are made.
class formula_reader {
public:
    formula_reader(recorded_model const& base, std::vector<effect> const& effects,
                   changed_formulas& to)
        : base_(&base), to_(&to) {
        auto first = effects;
        for (auto& e : first) e.on_rates = e.on_channels = {};
        auto with_seen = first;
        with_seen.push_back(
            model_detail::seen_effect(base.about, first, std::numeric_limits<int>::max()));
        seen_ = with(base, std::move(with_seen));
        before_ = with(base, std::move(first));
        after_ = with(base, effects);
    }

    void operator()() {
        remembered();
        inputs();
        rates();
        channels();
        late_channels();
    }

private:
    void say(std::string const& what, std::string const& how, std::string const& formula) {
        to_->lines.push_back(what + how + formula);
    }
    [[nodiscard]] std::string symbol(signal_memory const& m) const {
        return to_->symbols.at(after_.about.constants[m.constant].name);
    }
    /// Delays, plays, rate limits and slow clocks of inputs.
    void remembered() {
        for (auto k = base_->input_memory.size(); k < after_.input_memory.size(); ++k) {
            auto const& m = after_.input_memory[k];
            auto const& u = after_.about.inputs[m.index].name;
            auto const p = symbol(m);
            to_->lines.push_back(
                u + " becomes " +
                (m.kind == memory_kind::delay   ? u + " at the time t - " + p
                 : m.kind == memory_kind::drift ? u + " at the time t - " + p + " * (t - begin)"
                 : m.kind == memory_kind::play  ? u + " behind a play (backlash) of width 2 " + p
                                                : u + " behind a limit " + p + " of its rate"));
        }
    }
    /// What the model sees of inputs, constants and the time; states behind which it sees them.
    void inputs() {
        auto const& about = base_->about;
        auto const names = names_in(seen_);
        for (auto i = base_->rate.size(); i < before_.rate.size(); ++i)
            if (!moves_later(i)) added_state(before_, i, names_in(before_));
        auto k = first_seen();
        auto const show = [&](std::string const& name, operation op, std::size_t index) {
            auto const i = seen_.rate[k++];
            auto const& n = seen_.g[i];
            if (n.op == op && static_cast<std::size_t>(n.index) == index) return;
            say(name, " becomes ", text(seen_, i, names));
        };
        for (std::size_t u = 0; u < about.inputs.size(); ++u)
            show(about.inputs[u].name, operation::input, u);
        for (std::size_t c = 0; c < about.constants.size(); ++c)
            show(about.constants[c].name, operation::constant, c);
        show("t", operation::time, 0);
    }
    void rates() {
        auto& g = after_.g;
        auto const old = own_rates();
        auto names = names_of_changed();
        for (std::size_t i = 0; i < old.size(); ++i) {
            // A leaf is as short as its name.
            if (!is_leaf(g[old[i]].op)) names.nodes[old[i]] = rate_name(i);
        }
        std::vector<node_id> formulas;
        auto const changes = [&](std::size_t i) {
            return i < old.size() ? after_.rate[i] != old[i] : moves_later(i);
        };
        for (std::size_t i = 0; i < after_.rate.size(); ++i)
            if (changes(i)) formulas.push_back(after_.rate[i]);
        name_parts(formulas, names);
        for (auto i = old.size(); i < after_.rate.size(); ++i)
            if (changes(i)) added_state(after_, i, names);
        for (std::size_t i = 0; i < base_->rate.size(); ++i)
            if (after_.rate[i] != old[i])
                say(rate_name(i), " becomes ", text(after_, after_.rate[i], names));
    }
    /// Where one of these is too long: names for what stands in them more than once, each with a
    /// line; none where that takes more lines than anybody reads.
    void name_parts(std::vector<node_id> const& formulas, leaf_names& names) {
        constexpr std::size_t most = 12;
        auto const& g = after_.g;
        auto named = names;
        std::vector<std::string> lines;
        std::vector<std::size_t> uses(g.size());
        for (auto const i : formulas) ++uses[i];
        for (auto k = g.size(); k-- > 0;) {
            auto const& n = g.nodes()[k];
            if (uses[k] == 0 || is_leaf(n.op) || names.nodes.contains(static_cast<node_id>(k)))
                continue;
            ++uses[n.a];
            if (is_binary(n.op)) ++uses[n.b];
        }
        auto const readable = [&](node_id i) { return is_short(g, i, named, most_parts); };
        if (std::all_of(formulas.begin(), formulas.end(), readable)) return;
        for (std::size_t k = 0; k < g.size() && lines.size() <= most; ++k) {
            auto const i = static_cast<node_id>(k);
            bool const once = uses[k] < 2 || named.nodes.contains(i);
            if (once || is_short(g, i, named, 3)) continue;
            auto const name = "part_" + std::to_string(lines.size() + 1);
            lines.push_back(name + " = " + text(after_, i, named));
            if (!readable(i)) return;
            named.nodes[i] = name;
        }
        if (lines.size() > most || !std::all_of(formulas.begin(), formulas.end(), readable)) return;
        names = std::move(named);
        to_->lines.insert(to_->lines.end(), lines.begin(), lines.end());
    }
    void channels() {
        auto& g = after_.g;
        auto const old = copy_into(g, before_.g, before_.observe, same_leaf{});
        auto const names = names_of_changed();
        for (std::size_t y = 0; y < base_->observe.size(); ++y) {
            if (after_.observe[y] != old[y])
                say("the sensor " + base_->about.channels[y].name, " shows ",
                    text(after_, after_.observe[y], names));
        }
    }
    void late_channels() {
        for (auto k = base_->channel_delays.size(); k < after_.channel_delays.size(); ++k) {
            auto const& m = after_.channel_delays[k];
            bool const drift = m.kind == memory_kind::drift;
            to_->lines.push_back("the sensor " + after_.about.channels[m.index].name +
                                 " shows what was at the time t - " + symbol(m) +
                                 (drift ? " * (t - begin)" : ""));
        }
    }
    /// Whether the rate of an added state is set behind the edits of inputs.
    [[nodiscard]] bool moves_later(std::size_t i) {
        return i >= before_.rate.size() ||
               copy_into(after_.g, before_.g, {before_.rate[i]}, same_leaf{})[0] != after_.rate[i];
    }
    void added_state(recorded_model const& m, std::size_t i, leaf_names const& names) {
        auto const name = short_name(m.about.states[i].name);
        auto const at = std::find_if(m.added_states.begin(), m.added_states.end(),
                                     [i](auto const& a) { return a.state == i; });
        say("a further state " + name, " starts ",
            (at == m.added_states.end() ? "anywhere" : "at " + text(m, at->at_begin, names)) +
                ", with " + name + "' = " + text(m, m.rate[i], names));
    }
    [[nodiscard]] std::size_t first_seen() const {
        return seen_.rate.size() - base_->about.inputs.size() - base_->about.constants.size() - 1;
    }
    /// In the graph with all effects: what an input or a constant has become has its name.
    [[nodiscard]] leaf_names names_of_changed() {
        auto names = names_in(after_);
        auto const& about = base_->about;
        std::vector<node_id> const seen(
            seen_.rate.begin() + static_cast<std::ptrdiff_t>(first_seen()), seen_.rate.end());
        auto const now = copy_into(after_.g, seen_.g, seen, same_leaf{});
        auto const name = [&](std::size_t k, std::string const& as) {
            if (!is_leaf(after_.g[now[k]].op)) names.nodes[now[k]] = as;
        };
        auto const inputs = about.inputs.size(), constants = about.constants.size();
        for (std::size_t u = 0; u < inputs; ++u) name(u, about.inputs[u].name);
        for (std::size_t c = 0; c < constants; ++c) name(inputs + c, about.constants[c].name);
        name(inputs + constants, "t");
        return names;
    }
    /// The model's own rates, in the graph with the effects.
    [[nodiscard]] std::vector<node_id> own_rates() {
        std::vector<node_id> rates(before_.rate.begin(),
                                   before_.rate.begin() +
                                       static_cast<std::ptrdiff_t>(base_->rate.size()));
        return copy_into(after_.g, before_.g, rates, same_leaf{});
    }
    [[nodiscard]] std::string rate_name(std::size_t i) const {
        return base_->about.states[i].name + "'";
    }
    [[nodiscard]] static std::string text(recorded_model const& m, node_id i,
                                          leaf_names const& names) {
        return readable_formula(m.g, i, names, most_parts);
    }
    [[nodiscard]] leaf_names names_in(recorded_model const& m) const {
        leaf_names names;
        for (auto const& c : m.about.constants) {
            auto const known = to_->symbols.find(c.name);
            names.constants.push_back(known == to_->symbols.end() ? c.name : known->second);
        }
        for (auto const& x : m.about.states) names.states.push_back(short_name(x.name));
        for (auto const& u : m.about.inputs) names.inputs.push_back(short_name(u.name));
        return names;
    }

    static constexpr double most_parts = 100; ///< of a formula that people read

    recorded_model const* base_;
    changed_formulas* to_;
    recorded_model seen_, before_, after_; ///< with the edits of inputs; with all
};

/// "S1, S2 from 1.2 s on, S3 until 4 s", in the model's unit of time
[[nodiscard]] inline std::string episodes_of(effect const& e, std::string const& time_unit) {
    std::string text;
    for (std::size_t k = 0; k < e.only_in.size(); ++k) {
        text += (text.empty() ? "" : ", ") + e.only_in[k];
        double const since = k < e.since.size() ? e.since[k] : effect::from_start;
        double const until = k < e.until.size() ? e.until[k] : effect::for_ever;
        if (since > effect::from_start)
            text += " from " + nearest_text(since) + " " + time_unit + " on";
        if (until < effect::for_ever) text += " until " + nearest_text(until) + " " + time_unit;
    }
    return text;
}

} // namespace model_detail

SIVID_DECL changed_formulas formulas_of(recorded_model const& base, std::vector<effect> effects) {
    changed_formulas result;
    result.symbols = model_detail::symbols_of(base.about, effects);
    std::vector<std::string> partial;
    for (auto& e : effects) {
        auto const own = model_detail::short_name(e.name + ".wraps");
        if (e.wraps)
            partial.push_back(own + " counts how often the readings of " + e.wraps->channel +
                              " have leapt back: follow them beyond the ends of their range");
        if (e.only_in.empty()) continue;
        partial.push_back(e.name.substr(0, e.name.find('@')) + " acts in " +
                          model_detail::episodes_of(e, base.about.time_unit) + " only");
        e.only_in.clear();
        e.since.clear();
        e.until.clear();
    }
    model_detail::formula_reader(base, effects, result)();
    result.lines.insert(result.lines.end(), partial.begin(), partial.end());
    return result;
}

} // namespace sivid

#endif
