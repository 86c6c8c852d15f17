// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_MODEL_READER_HPP
#define SIVID_TEXT_DETAIL_MODEL_READER_HPP

#include <sivid/io/allowed_disturbances.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/model/implicit_model.hpp>
#include <sivid/text/detail/effect_reader.hpp>
#include <sivid/text/detail/model_names.hpp>
#include <sivid/text/detail/stated_state.hpp>
#include <sivid/text/detail/toml_section.hpp>
#include <sivid/text/detail/tried_graph.hpp>
#include <sivid/text/text_model.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// Makes a model of the tables of its file.
class model_reader {
public:
    model_reader(std::shared_ptr<model_source const> source, toml::table const& table)
        : source_(std::move(source)),
          names_(std::make_shared<model_names>()),
          whole_(*source_, table, "") {}

    [[nodiscard]] text_model read() {
        read_head();
        read_states();
        read_inputs();
        read_constants();
        read_parts();
        read_equations();
        auto& g = result_.model.g;
        // The leaves in the order in which those of a functor are entered.
        auto const enter = [&g](operation op, std::size_t n) {
            for (std::size_t i = 0; i < n; ++i) g.leaf(op, i);
        };
        enter(operation::state, about().states.size());
        enter(operation::constant, about().constants.size());
        enter(operation::input, about().inputs.size());
        g.leaf(operation::time, 0);
        record();
        model_detail::require_own_names(about());
        effect_reader effects(source_, names_, result_.model, constant_ranges());
        if (auto const section = whole_.section("effect")) result_.effects = effects.read(*section);
        require_used();
        auto const rate = [this](model_description::state const& s) {
            return rate_unit(s.unit, about().time_unit);
        };
        auto const own = [](model_description::item const& y) { return y.unit; };
        auto& allowed = result_.disturbances;
        allowed.equations = read_allowed("disturbance", "state", about().states, rate);
        allowed.channels = read_allowed("error", "output", about().channels, own);
        return std::move(result_);
    }

    /// The effects of a file that has these alone, on a model that is known.
    [[nodiscard]] std::vector<effect> read_effects(recorded_model const& on) {
        whole_.allow({"format", "let", "effect"});
        require_format("sivid-effects-1");
        result_.model = on;
        names_->time = unit(about().time_unit);
        names_->items["t"] = {kind::time, names_->time};
        names_->items["pi"] = {kind::pi};
        declare_all(kind::state, about().states);
        declare_all(kind::input, about().inputs);
        declare_all(kind::constant, about().constants);
        read_parts();
        effect_reader effects(source_, names_, result_.model, constant_ranges());
        auto const section = whole_.section("effect");
        if (!section) source_->fail(0, "the file has no effect", "add a table [effect.NAME]");
        auto result = effects.read(*section);
        for (auto const& name : names_->all(kind::constant)) names_->used.insert(name);
        require_used();
        return result;
    }

private:
    using kind = model_names::kind;

    void require_format(std::string const& wanted) {
        auto const format = whole_.text("format");
        if (!format || *format != wanted)
            source_->fail(format ? whole_.find("format")->value : 0,
                          "this is no file in the format " + wanted,
                          "begin the file by: format = " + in_quotes(wanted));
    }
    template <class Items>
    void declare_all(kind what, Items const& items) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            unit const in(items[i].unit);
            if (!in.fault().empty())
                source_->fail(0,
                              "the model has " + in_quotes(items[i].name) + " in " +
                                  in_quotes(items[i].unit) + ", which is no unit",
                              "correct the model");
            names_->declare(*source_, items[i].name, {what, in, i, 0});
        }
    }
    static constexpr std::size_t most_parts = 500; // their formulas are evaluated by recursion

    model_description& about() { return result_.model.about; }

    void read_head() {
        whole_.allow({"format", "name", "about", "time", "states", "inputs", "constants", "let",
                      "equations", "outputs", "effect", "disturbance", "error"});
        require_format("sivid-model-1");
        auto const* name = whole_.find("name");
        if (name == nullptr) source_->fail(0, "the model has no name", "add: name = \"robot\"");
        about().name = whole_.string_of(*name);
        if (about().name.empty() || !unprintable_in(about().name).empty())
            source_->fail(name->value, "this is no name", "write one of letters");
        result_.about = whole_.text("about").value_or("");
        if (auto const* time = whole_.find("time")) {
            about().time_unit = whole_.string_of(*time);
            names_->time = unit_in(*source_, *time, about().time_unit);
            if (!names_->time.in(unit("s")))
                source_->fail(time->value, "this is no unit of time", "write \"s\" or \"ms\"");
        } else {
            names_->time = unit("s");
        }
        names_->items["t"] = {kind::time, names_->time};
        names_->items["pi"] = {kind::pi};
    }
    void read_states() {
        auto const states = whole_.section("states");
        if (!states || states->entries().empty())
            source_->fail(states ? whole_.find("states")->value : source_->text().size(),
                          "the model has no states",
                          "add a table [states] with lines such as: w = \"50 rad/s\"");
        for (auto const& e : states->entries()) {
            auto s = stated_state(*source_, *states, e, "equation");
            if (e.node->is_table()) s.equation = states->within(e).text("equation").value_or("");
            names_->declare(*source_, e.name,
                            {kind::state, unit(s.unit), about().states.size(), e.key});
            about().states.push_back(std::move(s));
        }
    }
    void read_inputs() {
        auto const inputs = whole_.section("inputs");
        if (!inputs) return;
        for (auto const& e : inputs->entries()) {
            model_description::item u{e.name, ""};
            if (e.node->is_table()) {
                auto const of = inputs->within(e);
                of.allow({"unit", "delay"});
                u.unit = stated_unit(*source_, of).value_or("1");
                if (auto const* d = of.find("delay"))
                    delays_.push_back(
                        {about().inputs.size(), false, std::string(of.string_of(*d)), d->value});
            } else {
                u.unit = inputs->string_of(e);
                (void)unit_in(*source_, e, u.unit);
            }
            names_->declare(*source_, e.name,
                            {kind::input, unit(u.unit), about().inputs.size(), e.key});
            about().inputs.push_back(std::move(u));
        }
    }

    void read_constants() {
        auto const constants = whole_.section("constants");
        if (!constants) return;
        std::vector<interval> prior;
        for (auto const& e : constants->entries()) {
            std::optional<stated_quantity> value, range;
            std::optional<std::string> in;
            if (e.node->is_table()) {
                auto const of = constants->within(e);
                of.allow({"unit", "value", "prior", "follows"});
                in = stated_unit(*source_, of);
                if (auto const* v = of.find("value")) value = of.quantity(*v);
                if (auto const* p = of.find("prior")) range = of.quantity(*p);
                if (auto const* f = of.find("follows"))
                    follows_.push_back({e.name, used(of.formula_of(*f)), f->value});
                if (value && value->is_range)
                    source_->fail(value->position, "bounds are no value", "call them prior");
            } else {
                auto const q = constants->quantity(e);
                (q.is_range ? range : value) = q;
            }
            if (!value && !range)
                source_->fail(e.value, "the constant '" + e.name + "' has no value",
                              "write one as in \"1.297 kg\", or a prior as in \"[1, 2] kg\"");
            add_constant(e, value, range, in, prior);
        }
        result_.prior = box(std::move(prior));
    }
    void add_constant(toml_section::entry const& e, std::optional<stated_quantity> value,
                      std::optional<stated_quantity> const& range, std::optional<std::string> in,
                      std::vector<interval>& prior) {
        auto const what = "the constant '" + e.name + "'";
        for (auto const& q : {value, range})
            if (!in && q && q->in) in = q->unit_text;
        auto const unit_text = in.value_or("1");
        model_description::constant c{e.name, unit_text, {}};
        if (!value) { // the middle of the prior
            static auto const half = *exact_decimal::parse("0.5");
            value = range;
            value->lower = value->upper = (range->lower + range->upper).times(half);
        }
        c.nominal = converted(*source_, *value, unit_text, what);
        if (range) {
            auto const bounds = converted(*source_, *range, unit_text, what).enclosure;
            if (!(bounds.lower() <= c.nominal.nearest && c.nominal.nearest <= bounds.upper()))
                source_->fail(value->position, "the value is outside the prior",
                              "correct one of them");
            result_.unknown.push_back(e.name);
            prior.push_back(bounds);
        }
        names_->declare(*source_, e.name,
                        {kind::constant, unit(unit_text), about().constants.size(), e.key});
        about().constants.push_back(std::move(c));
    }

    void add_part(std::string const& name, formula is, std::size_t position) {
        names_->declare(*source_, name, {kind::part, {}, names_->parts.size(), position});
        names_->parts.push_back({name, used(std::move(is))});
        if (names_->parts.size() > most_parts)
            source_->fail(position, "more than 500 named parts", "write fewer, longer ones");
    }
    void read_parts() {
        if (auto const let = whole_.section("let"))
            for (auto const& e : let->entries()) add_part(e.name, let->formula_of(e), e.key);
    }
    void read_equations() {
        if (whole_.find("equations") == nullptr)
            source_->fail(source_->text().size(), "the model has no equations",
                          "add: equations = \"w' = -b*w/J\", in front of all tables");
        for (auto& s : stated_equations()) {
            if (s.how != '=')
                source_->fail(s.position, "the equations of a model have = alone",
                              "+= and the like stand in effects");
            if (!s.is_rate && s.left.nodes.empty()) {
                add_part(s.name, std::move(s.by), s.position);
            } else {
                names_->use(s.left);
                s.by = used(std::move(s.by));
                equations_.push_back(std::move(s));
            }
        }
    }
    /// Of a string, or of a table, where w = "..." of a state is w'.
    [[nodiscard]] std::vector<statement> stated_equations() const {
        if (!whole_.find("equations")->node->is_table()) return whole_.statements("equations");
        std::vector<statement> result;
        auto const section = whole_.within(*whole_.find("equations"));
        for (auto const& e : section.entries()) {
            statement s;
            s.name = e.name;
            s.position = e.key;
            s.is_rate = s.name.ends_with('\'');
            if (s.is_rate) s.name.pop_back();
            auto const known = names_->items.find(s.name);
            if (known != names_->items.end() && known->second.what == kind::state) s.is_rate = true;
            s.by = section.formula_of(e);
            result.push_back(std::move(s));
        }
        return result;
    }
    [[nodiscard]] formula used(formula f) {
        names_->use(f);
        return f;
    }

    /// Enters all formulas into the graph.
    void record() {
        auto& model = result_.model;
        std::vector<partial_operation> domains;
        named_values values(
            *source_, *names_,
            [&](std::string const&, model_names::item const& item) {
                auto const op = item.what == kind::state      ? operation::state
                                : item.what == kind::input    ? operation::input
                                : item.what == kind::constant ? operation::constant
                                                              : operation::time;
                return expression(model.g, model.g.leaf(op, item.index));
            },
            [&](formula::node const& n) { return rate_in_formula(n); },
            [&](operation op, expression const& x, std::size_t position) {
                domains.push_back({op, x.in(model.g), position});
            });
        for (std::size_t k = 0; k < names_->parts.size(); ++k)
            (void)values.part(k, names_->parts[k].is.begin());
        record_rates(values, domains);
        values.forget(); // parts may have rates in them, which are known now
        record_outputs(values);
        for (auto const& f : follows_) {
            auto const& c = about().constants[names_->items.find(f.name)->second.index];
            try {
                auto const value = values.fitted(f.is, unit(c.unit), "'" + f.name + "'").value;
                model_detail::add_derived(model, f.name, value);
            } catch (model_text_error const&) {
                throw;
            } catch (std::invalid_argument const& error) {
                source_->fail(f.position, error.what(), "correct the formula, or the value");
            }
        }
        add_delays();
        require_domains(domains);
    }
    /// A rate: an unknown of the equations, and in outputs what solves them.
    [[nodiscard]] std::optional<formula_value> rate_in_formula(formula::node const& n) {
        if (n.what != formula::kind::rate) return std::nullopt;
        auto const& item = names_->state(*source_, n.name, n.begin);
        formula_value x{expression(0), names_->rate_of(item)};
        auto& model = result_.model;
        if (!model.rate.empty()) {
            x.value = expression(model.g, model.rate[item.index]);
        } else {
            x.rates.emplace(item.index, expression(1));
            x.rates_alone = true;
        }
        return x;
    }
    /// The equations in the order of the states: each stands for the rate that is its left side,
    /// the others in their order for the states that are left.
    [[nodiscard]] std::vector<statement const*> ordered_equations() {
        std::vector<statement const*> of(about().states.size());
        for (auto const& s : equations_) {
            if (!s.left.nodes.empty()) continue;
            auto const*& one = of[names_->state(*source_, s.name, s.position).index];
            if (one != nullptr)
                source_->fail(s.position, "a second equation for " + s.name + "'",
                              "each state has one");
            one = &s;
        }
        auto const next = [&] { return std::find(of.begin(), of.end(), nullptr); };
        for (auto const& s : equations_) {
            if (s.left.nodes.empty()) continue;
            if (next() == of.end())
                source_->fail(s.position, "one equation more than there are states",
                              "leave one out, or add a state");
            *next() = &s;
        }
        if (next() != of.end()) {
            auto const& s = about().states[static_cast<std::size_t>(next() - of.begin())];
            source_->fail(names_->items.find(s.name)->second.position,
                          "the state '" + s.name + "' has no equation",
                          "add one to the equations: " + s.name + "' = ...");
        }
        return of;
    }
    void record_rates(named_values& values, std::vector<partial_operation>& domains) {
        auto const equations = ordered_equations();
        std::vector<formula_value> left, right;
        statement const* implicit = nullptr;
        for (std::size_t i = 0; i < equations.size(); ++i) {
            auto const& s = *equations[i];
            bool const of_rate = s.left.nodes.empty();
            if (of_rate) {
                formula::node rate{formula::kind::rate, s.position, s.position};
                rate.name = s.name;
                left.push_back(*rate_in_formula(rate));
            } else {
                left.push_back(values(s.left));
            }
            right.push_back(values.fitted(s.by, left.back().in,
                                          of_rate ? s.name + "'" : "what is on the left"));
            bool const given = of_rate && right.back().rates.empty();
            if (!given && implicit == nullptr) implicit = &s;
        }
        if (implicit != nullptr) return solve(left, right, *implicit, domains);
        for (auto const& r : right) result_.model.rate.push_back(r.value.in(result_.model.g));
    }
    /// Solves left = right for the rates, as the equations of an implicit functor.
    void solve(std::vector<formula_value> const& left, std::vector<formula_value> const& right,
               statement const& first, std::vector<partial_operation>& domains) {
        constexpr std::size_t most = 200; // the matrix has so many rows and columns
        if (left.size() > most)
            source_->fail(first.position, "more than 200 states beside rates to be solved for",
                          "solve these equations for the rates");
        auto& g = result_.model.g;
        std::vector<expression> mass, force;
        for (std::size_t i = 0; i < left.size(); ++i) {
            auto l = left[i], r = right[i];
            l.rates_alone = r.rates_alone = true; // their values apart
            auto const row = sum_of(l, r, true).rates;
            for (std::size_t j = 0; j < left.size(); ++j)
                mass.push_back(row.contains(j) ? row.at(j) : expression(0));
            l = left[i], r = right[i];
            l.rates.clear(), r.rates.clear();
            force.push_back(sum_of(r, l, true).value);
        }
        auto const before = static_cast<node_id>(g.size());
        std::vector<expression> solved;
        try {
            solved = model_detail::solved_rates(result_.model, mass, force, {});
        } catch (std::invalid_argument const& error) {
            source_->fail(first.position, error.what(),
                          "the equations have to be independent, and to have all rates in them");
        }
        for (auto const& rate : solved) result_.model.rate.push_back(rate.in(g));
        for (auto k = before; k < g.size(); ++k)
            if (g[k].op == operation::div)
                domains.push_back({operation::div, g[k].b, first.position, true});
    }
    void record_outputs(named_values& values) {
        auto const outputs = whole_.section("outputs");
        if (!outputs || outputs->entries().empty())
            source_->fail(source_->text().size(), "the model has no outputs",
                          "add a table [outputs] with lines such as: w = \"w\"");
        for (auto const& e : outputs->entries()) {
            formula is;
            std::optional<std::string> in;
            if (e.node->is_table()) {
                auto const of = outputs->within(e);
                of.allow({"unit", "equation", "delay"});
                in = stated_unit(*source_, of);
                if (auto const* f = of.find("equation"))
                    is = of.formula_of(*f);
                else
                    is.nodes.push_back(
                        {formula::kind::name, e.key, e.key, operation::literal, {}, e.name});
                if (auto const* d = of.find("delay"))
                    delays_.push_back(
                        {about().channels.size(), true, std::string(of.string_of(*d)), d->value});
            } else {
                is = outputs->formula_of(e);
            }
            names_->use(is);
            auto const value = values(is);
            if (!in) in = unit_text_of(is, value.in);
            auto const shown = values.fitted(is, unit(*in), "the output '" + e.name + "'").value;
            about().channels.push_back({e.name, *in});
            result_.model.observe.push_back(shown.in(result_.model.g));
        }
    }
    /// As it is written where the formula is a name alone.
    [[nodiscard]] std::string unit_text_of(formula const& f, unit const& in) {
        if (f.nodes.size() == 1 && f.nodes[0].what == formula::kind::name) {
            auto const& item = names_->items.find(f.nodes[0].name)->second;
            if (item.what == kind::state) return about().states[item.index].unit;
            if (item.what == kind::input) return about().inputs[item.index].unit;
            if (item.what == kind::constant) return about().constants[item.index].unit;
        }
        return in.text();
    }
    void add_delays() {
        for (auto const& d : delays_) {
            auto const found = names_->items.find(d.constant);
            if (found == names_->items.end() || found->second.what != kind::constant)
                source_->fail(d.position, "a delay is the name of a constant",
                              "add the constant to [constants]");
            auto const& c = about().constants[found->second.index];
            auto const ratio = unit(c.unit).in(names_->time);
            if (!ratio || !ratio->is_one())
                source_->fail(d.position, "the delay '" + c.name + "' is in " + c.unit,
                              "give it the model's unit of time, " + about().time_unit);
            auto const least = range_of(found->second.index).lower();
            if (!(least >= 0))
                source_->fail(d.position, "the delay '" + c.name + "' may be below 0",
                              "correct its value or its prior");
            names_->used.insert(d.constant);
            auto& to = d.of_output ? result_.model.channel_delays : result_.model.input_memory;
            to.push_back({d.index, found->second.index, memory_kind::delay});
        }
    }
    /// The prior of a constant, or its value.
    [[nodiscard]] interval range_of(std::size_t constant) {
        auto const& c = about().constants[constant];
        auto const at = std::find(result_.unknown.begin(), result_.unknown.end(), c.name);
        if (at == result_.unknown.end()) return c.nominal.enclosure;
        return result_.prior[static_cast<std::size_t>(at - result_.unknown.begin())];
    }

    /// Of all constants.
    [[nodiscard]] std::vector<interval> constant_ranges() {
        std::vector<interval> result;
        for (std::size_t k = 0; k < about().constants.size(); ++k) result.push_back(range_of(k));
        return result;
    }
    /// Refuses functions whose arguments are outside their domains for all constants of the prior,
    /// and all states of the own ranges.
    void require_domains(std::vector<partial_operation> const& domains) {
        auto const* never =
            never_defined(result_.model.g, domains, all_values(about(), constant_ranges()));
        if (never == nullptr) return;
        if (never->solves)
            source_->fail(never->position,
                          "these equations have no solution for the rates, or many: what is "
                          "divided by is 0 over the whole prior",
                          "correct the factors of the rates");
        source_->fail(never->position, domain_words(never->op),
                      "correct the formula, the prior or the ranges of the states");
    }
    /// Refuses constants and named parts that stand in no formula.
    void require_used() {
        for (auto const& [name, item] : names_->items) {
            bool const needed = item.what == kind::constant || item.what == kind::part;
            if (needed && !names_->used.contains(name))
                source_->fail(item.position, "'" + name + "' stands in no formula",
                              "use it, or leave it out");
        }
    }

    /// Bounds of what is unknown beside these equations or outputs.
    template <class Item, class Unit>
    [[nodiscard]] allowed_disturbances::bounds
    read_allowed(std::string const& table, std::string const& what, std::vector<Item> const& all,
                 Unit const& unit_of) {
        allowed_disturbances::bounds result;
        auto const section = whole_.section(table);
        if (!section) return result;
        std::vector<std::string> names;
        for (auto const& x : all) names.push_back(x.name);
        for (auto const& e : section->entries()) {
            auto const at = std::find(names.begin(), names.end(), e.name);
            if (at == names.end())
                source_->fail(e.key, in_quotes(e.name) + " is no " + what,
                              name_hint(e.name, names));
            auto const index = static_cast<std::size_t>(at - names.begin());
            auto q = section->quantity(e);
            if (!q.in) q.in = unit("1");
            if (q.is_range || !q.lower.is_positive())
                source_->fail(q.position, "a number above 0 is needed here",
                              "write the largest size, as in \"0.2 " + unit_of(all[index]) + "\"");
            auto const most =
                bounds_in(*source_, q, unit_of(all[index]), "the bound of '" + e.name + "'").second;
            disturbance_set one;
            (table == "error" ? one.channels : one.equations).push_back({index, 1});
            try {
                require_valid(one, result_.model);
            } catch (std::invalid_argument const& error) {
                source_->fail(e.key, error.what(), "");
            }
            result.emplace_back(e.name, rounded_up(most, unit_conversion::digits));
        }
        return result;
    }

    struct delay {
        std::size_t index;
        bool of_output;
        std::string constant;
        std::size_t position;
    };
    struct relation {
        std::string name;
        formula is;
        std::size_t position;
    };

    std::shared_ptr<model_source const> source_;
    std::shared_ptr<model_names> names_;
    toml_section whole_;
    text_model result_;
    std::vector<statement> equations_;
    std::vector<delay> delays_;
    std::vector<relation> follows_;
};

} // namespace sivid::text_detail

#endif
