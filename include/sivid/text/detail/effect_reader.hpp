// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_EFFECT_READER_HPP
#define SIVID_TEXT_DETAIL_EFFECT_READER_HPP

#include <sivid/model/effect.hpp>
#include <sivid/number/text/kept_decimal.hpp>
#include <sivid/text/detail/effect_kinds.hpp>
#include <sivid/text/detail/model_names.hpp>
#include <sivid/text/detail/stated_state.hpp>
#include <sivid/text/detail/toml_section.hpp>
#include <sivid/text/detail/tried_graph.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// The formulas of an effect, and what their names mean: it lives as long as the effect does.
struct effect_text {
    enum class stage { starts, inputs, rates, outputs };
    struct parameter {
        std::string name;
        unit in;
    };
    /// A state that the effect adds, by its name in the effect.
    struct own_state {
        model_description::state is;
        unit in;
        std::size_t position = 0;
        std::optional<formula> start{}; ///< else 0
        bool unknown = false;           ///< it starts anywhere
    };
    std::shared_ptr<model_source const> source;
    std::shared_ptr<model_names const> names;
    std::string effect; ///< its name
    std::vector<parameter> parameters;
    std::vector<own_state> states;
    std::vector<statement> inputs, rates, outputs;
    std::vector<model_description::item> channels; ///< of the model

    /// Adds the states.
    void begin(effect_scope& scope) const {
        std::map<std::string, formula_value> const no_parts;
        auto values = values_at(scope, stage::starts, no_parts);
        for (auto const& s : states) {
            auto const& [name, unit_text, limit, equation] = s.is;
            std::optional<expression> start;
            if (!s.unknown) start.emplace(0);
            if (s.start) start = values.fitted(*s.start, s.in, "'" + name + "'").value;
            (void)scope.add_state(in_model(name), unit_text, limit, start);
        }
    }
    void apply(effect_scope& scope, std::vector<statement> const& all, stage at) const {
        std::map<std::string, formula_value> parts; // of its own
        auto values = values_at(scope, at, parts);
        for (auto const& s : all) {
            unit in;
            if (names_part(s, at)) {
                parts[s.name] = values(s.by);
                continue;
            }
            auto& changed = target(scope, s, at, in);
            auto const what = s.name + (s.is_rate ? "'" : "");
            bool const factor = s.how == '*' || s.how == '/';
            auto const by =
                values.fitted(s.by, factor ? unit() : in, factor ? "a factor of " + what : what)
                    .value;
            changed = s.how == '='   ? by
                      : s.how == '+' ? changed + by
                      : s.how == '-' ? changed - by
                      : s.how == '*' ? changed * by
                                     : changed / by;
            values.forget();
        }
    }

    /// Whether a statement names a part of the effect's formulas, and changes nothing.
    [[nodiscard]] bool names_part(statement const& s, stage at) const {
        bool const changes =
            at == stage::outputs && std::any_of(channels.begin(), channels.end(),
                                                [&](auto const& y) { return y.name == s.name; });
        auto const own = own_names();
        return !s.is_rate && s.how == '=' && !changes && !names->items.contains(s.name) &&
               std::find(own.begin(), own.end(), s.name) == own.end();
    }
    [[nodiscard]] own_state const* state(std::string const& name) const {
        auto const found = std::find_if(states.begin(), states.end(),
                                        [&](auto const& s) { return s.is.name == name; });
        return found == states.end() ? nullptr : &*found;
    }

private:
    using kind = model_names::kind;

    [[nodiscard]] std::string in_model(std::string const& state) const {
        return effect + "." + state;
    }
    [[nodiscard]] std::vector<std::string> own_names() const {
        std::vector<std::string> result;
        for (auto const& p : parameters) result.push_back(p.name);
        for (auto const& s : states) result.push_back(s.is.name);
        return result;
    }
    /// @param parts  of the effect
    [[nodiscard]] named_values values_at(effect_scope& scope, stage at,
                                         std::map<std::string, formula_value> const& parts) const {
        return named_values(
            *source, *names,
            [&scope](std::string const& name, auto const&) { return scope.named(name); },
            [this, &scope, at, &parts](formula::node const& n) -> std::optional<formula_value> {
                auto const part = n.what == formula::kind::name ? parts.find(n.name) : parts.end();
                return part != parts.end() ? part->second : own(scope, n, at);
            },
            {}, own_names());
    }
    [[nodiscard]] std::optional<formula_value> own(effect_scope& scope, formula::node const& n,
                                                   stage at) const {
        if (n.what == formula::kind::shown && at == stage::outputs) {
            unit in;
            auto const& y = output(scope, n.name, n.position, in);
            return formula_value{y, in};
        }
        bool const may_see = at == stage::rates || at == stage::outputs || state(n.name) != nullptr;
        if (n.what == formula::kind::rate && may_see && at != stage::starts) {
            unit in;
            auto const& rate = rate_of(scope, n.name, n.position, in);
            return formula_value{rate, in};
        }
        if (n.what != formula::kind::name) return std::nullopt;
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (parameters[k].name == n.name)
                return formula_value{scope.parameter(k), parameters[k].in};
        auto const* s = state(n.name);
        auto const known = names->items.find(n.name);
        bool const moves =
            s != nullptr || (known != names->items.end() && (known->second.what == kind::state ||
                                                             known->second.what == kind::time));
        if (at == stage::starts && moves)
            source->fail(n.begin,
                         "a state that an effect adds starts at what inputs and constants "
                         "say, not at '" +
                             n.name + "'",
                         "let it be the difference, which starts at 0: d' = w' - d/tau, and w - d "
                         "for what lags behind w, or write start = \"unknown\"");
        if (s != nullptr) return formula_value{scope.state(in_model(n.name)), s->in};
        return std::nullopt;
    }
    [[nodiscard]] expression& target(effect_scope& scope, statement const& s, stage at,
                                     unit& in) const {
        if (s.is_rate && state(s.name) != nullptr && at != stage::outputs)
            return rate_of(scope, s.name, s.position, in);
        if (s.is_rate != (at == stage::rates))
            source->fail(s.position,
                         at == stage::rates ? "the equations of an effect change rates"
                                            : "a rate is changed in the equations of an effect",
                         at == stage::rates ? "write them as in w' += -k*w/J"
                                            : "call this part equations");
        if (at == stage::rates) return rate_of(scope, s.name, s.position, in);
        if (at == stage::outputs) return output(scope, s.name, s.position, in);
        auto const found = names->items.find(s.name);
        bool const input = found != names->items.end() && found->second.what == kind::input;
        if (!input && (found == names->items.end() || found->second.what != kind::constant))
            source->fail(s.position, "'" + s.name + "' is no input and no constant of the model",
                         name_hint(s.name, of_kinds(kind::input, kind::constant)));
        in = found->second.in;
        return input ? scope.input(s.name) : scope.constant(s.name);
    }
    [[nodiscard]] std::vector<std::string> of_kinds(kind a, kind b) const {
        std::vector<std::string> result;
        for (auto const& [name, item] : names->items)
            if (item.what == a || item.what == b) result.push_back(name);
        return result;
    }
    [[nodiscard]] expression& rate_of(effect_scope& scope, std::string const& name,
                                      std::size_t position, unit& in) const {
        if (auto const* own = state(name)) {
            in = own->in.times(names->time, -1);
            return scope.rate(in_model(name));
        }
        in = names->rate_of(names->state(*source, name, position));
        return scope.rate(name);
    }
    [[nodiscard]] expression& output(effect_scope& scope, std::string const& name,
                                     std::size_t position, unit& in) const {
        std::vector<std::string> known;
        for (auto const& y : channels) {
            known.push_back(y.name);
            if (y.name != name) continue;
            in = unit(y.unit);
            return scope.channel(name);
        }
        source->fail(position, "'" + name + "' is no output", name_hint(name, known));
    }
};

/// Reads the tables [effect.NAME], and tries each effect on the model.
class effect_reader {
public:
    effect_reader(std::shared_ptr<model_source const> source, std::shared_ptr<model_names> names,
                  recorded_model const& model, std::vector<interval> constants)
        : source_(std::move(source)),
          names_(std::move(names)),
          model_(&model),
          constants_(std::move(constants)) {}

    [[nodiscard]] std::vector<effect> read(toml_section const& all) {
        constexpr std::size_t most = 200;
        std::vector<effect> result;
        for (auto const& e : all.entries()) {
            if (result.size() == most)
                source_->fail(e.key, "more than 200 effects", "leave some out");
            auto const of = all.within(e);
            require_name(e.name, e.key);
            result.push_back(of.find("kind") != nullptr ? ready_made(of, e) : own(of, e));
        }
        return result;
    }

private:
    /// Joins the effect to the model: all of its formulas are evaluated. Somewhere over the prior
    /// they are defined, and where its constants are neutral they change nothing.
    void try_out(effect const& one, std::size_t position) const {
        recorded_model joined;
        try {
            joined = with(*model_, {one});
        } catch (model_text_error const&) {
            throw;
        } catch (std::exception const& error) {
            source_->fail(position, error.what(), "correct this effect");
        }
        auto constants = constants_;
        for (auto const& p : one.parameters) constants.push_back(p.prior());
        std::vector<partial_operation> domains;
        auto const& g = joined.g;
        for (node_id k = 0; k < g.size(); ++k) {
            auto const op = g[k].op;
            if (op == operation::sqrt || op == operation::log) domains.push_back({op, g[k].a, 0});
            if (op == operation::div) domains.push_back({op, g[k].b, 0});
        }
        auto const values = all_values(joined.about, std::move(constants));
        if (auto const* never = never_defined(g, domains, values))
            source_->fail(position, "the effect has " + domain_words(never->op),
                          "correct its formulas, or the prior of its constants");
        auto const trace = one.may_leave_traces() ? std::nullopt : left_trace(*model_, joined);
        if (trace)
            source_->fail(
                position, "the effect changes " + *trace + " where its constants are neutral",
                "let it vanish there, or state where it does: k = { prior = \"[1, 2] N\", "
                "neutral = \"1 N\" }");
    }
    void require_name(std::string const& name, std::size_t position) const {
        bool const plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                   c == '_';
        });
        auto const& inputs = model_->about.inputs;
        if (!plain)
            source_->fail(position, "an effect's name has letters, digits and _",
                          "give another name");
        if (std::any_of(inputs.begin(), inputs.end(),
                        [&](auto const& u) { return u.name == name; }))
            source_->fail(position, "an input is called so, too", "give the effect another name");
    }
    [[nodiscard]] static decimal kept(exact_decimal const& x) {
        auto const d = kept_decimal((x.is_negative() ? -x : x).text());
        return x.is_negative() ? -d : d;
    }

    [[nodiscard]] effect own(toml_section const& of, toml_section::entry const& e) {
        of.allow(
            {"kind", "about", "order", "constants", "states", "inputs", "equations", "outputs"});
        effect result;
        result.name = e.name;
        result.about = of.text("about").value_or("");
        if (auto const* order = of.find("order")) {
            auto const& n = *order->node;
            if (!n.is_integer() || n.as_integer()->get() < -1000 || n.as_integer()->get() > 1000)
                source_->fail(order->value, "the order is a whole number", "write 0, 1, 2, ...");
            result.order = static_cast<int>(n.as_integer()->get());
        }
        auto text = std::make_shared<effect_text>();
        text->source = source_;
        text->names = names_;
        text->effect = e.name;
        text->channels = model_->about.channels;
        read_parameters(of, result, *text);
        read_states(of, *text);
        text->inputs = of.statements("inputs");
        text->rates = of.statements("equations");
        text->outputs = of.statements("outputs");
        auto const& all = {&text->inputs, &text->rates, &text->outputs};
        if (std::all_of(all.begin(), all.end(), [](auto const* s) { return s->empty(); }))
            source_->fail(e.key, "the effect changes nothing",
                          "add equations = \"w' += -k*w/J\", inputs = or outputs =");
        require_own_equations(*text);
        set_edits(result, text);
        try_out(result, e.key);
        require_used(of, *text, all);
        return result;
    }
    static void set_edits(effect& e, std::shared_ptr<effect_text const> const& text) {
        using stage = effect_text::stage;
        if (!text->inputs.empty() || !text->states.empty())
            e.on_inputs = [text](effect_scope& h) {
                text->begin(h);
                text->apply(h, text->inputs, stage::inputs);
            };
        if (!text->rates.empty())
            e.on_rates = [text](effect_scope& h) { text->apply(h, text->rates, stage::rates); };
        if (!text->outputs.empty())
            e.on_channels = [text](effect_scope& h) {
                text->apply(h, text->outputs, stage::outputs);
            };
    }
    void read_parameters(toml_section const& of, effect& result, effect_text& text) {
        auto const constants = of.section("constants");
        if (!constants || constants->entries().empty())
            source_->fail(of.begin(), "the effect has no constants of its own",
                          "add constants.k = \"[0, 1] N\": what it is multiplied by");
        for (auto const& c : constants->entries()) {
            stated_quantity prior, neutral;
            auto at = c.value;
            if (c.node->is_table()) {
                auto const fields = constants->within(c);
                fields.allow({"prior", "neutral"});
                auto const* p = fields.find("prior");
                if (p == nullptr)
                    source_->fail(c.value, "the constant has no prior", "add prior = \"[0, 1] N\"");
                prior = fields.quantity(*p);
                if (auto const* n = fields.find("neutral")) {
                    neutral = fields.quantity(*n);
                    at = n->value;
                }
            } else {
                prior = constants->quantity(c);
            }
            if (!prior.is_range)
                source_->fail(prior.position, "a prior has two bounds", "write \"[0, 1] N\"");
            if (neutral.is_range || (neutral.in && !(neutral.in == prior.in)))
                source_->fail(at, "the neutral value is one number in the unit of the prior",
                              "write it as in \"0.5 N\"");
            if (neutral.lower < prior.lower || prior.upper < neutral.lower)
                source_->fail(
                    at, "the prior does not contain the neutral value, " + neutral.lower.text(),
                    "correct the prior, or add neutral = ...");
            require_free(c, text);
            auto const in = prior.in ? prior.unit_text : "1";
            result.parameters.push_back(
                {c.name, in, kept(prior.lower), kept(prior.upper), kept(neutral.lower)});
            text.parameters.push_back({c.name, unit(in)});
        }
    }
    /// What the effect brings has a name, which nothing else has.
    void require_free(toml_section::entry const& e, effect_text const& text) const {
        auto const taken = [&](auto const& name) { return name == e.name; };
        if (names_->items.contains(e.name) ||
            std::any_of(text.parameters.begin(), text.parameters.end(),
                        [&](auto const& p) { return taken(p.name); }))
            source_->fail(e.key,
                          (names_->items.contains(e.name) ? "the model has a '"
                                                          : "the effect has a constant '") +
                              e.name + "', too",
                          "give this another name");
        model_names check; // whether it is a name
        check.declare(*source_, e.name, {model_names::kind::constant, {}, 0, e.key});
    }
    void read_states(toml_section const& of, effect_text& text) const {
        auto const states = of.section("states");
        if (!states) return;
        for (auto const& e : states->entries()) {
            require_free(e, text);
            auto is = stated_state(*source_, *states, e, "start");
            unit const in(is.unit);
            text.states.push_back({std::move(is), in, e.key});
            if (!e.node->is_table()) continue;
            auto const fields = states->within(e);
            auto const* start = fields.find("start");
            if (start == nullptr) continue;
            text.states.back().unknown =
                start->node->is_string() && fields.string_of(*start) == "unknown";
            if (!text.states.back().unknown) {
                text.states.back().start = fields.formula_of(*start);
                names_->use(*text.states.back().start);
            }
        }
    }
    /// Each state that an effect adds has one equation, and its rate stands in what comes later.
    void require_own_equations(effect_text const& text) const {
        std::set<std::string, std::less<>> known;
        for (auto const* list : {&text.inputs, &text.rates, &text.outputs})
            for (auto const& s : *list) {
                if (!s.left.nodes.empty())
                    source_->fail(s.position, "an effect has no equations between formulas",
                                  "write w' += ... or, of a state that it adds, f' = ...");
                for (auto const& n : s.by.nodes)
                    if (n.what == formula::kind::rate && text.state(n.name) != nullptr &&
                        !known.contains(n.name))
                        source_->fail(n.position, "the rate " + n.name + "' is not known here",
                                      "write its equation before, and solve it for " + n.name +
                                          "'");
                if (!s.is_rate || text.state(s.name) == nullptr) continue;
                if (s.how != '=' || !known.insert(s.name).second)
                    source_->fail(s.position, "a second equation for " + s.name + "'",
                                  "a state that an effect adds has one, with =");
            }
        for (auto const& s : text.states)
            if (!known.contains(s.is.name))
                source_->fail(s.position, "the state '" + s.is.name + "' has no equation",
                              "add one to the effect's inputs or equations: " + s.is.name +
                                  "' = ...");
    }
    template <class Lists>
    void require_used(toml_section const& of, effect_text const& text, Lists const& all) {
        std::set<std::string, std::less<>> here;
        for (auto const* list : all)
            for (auto const& s : *list) {
                names_->use(s.by);
                for (auto const& n : s.by.nodes)
                    if (n.what == formula::kind::name) here.insert(n.name);
            }
        for (auto const& s : text.states) // they may start at a constant
            for (auto const& n : s.start.value_or(formula{}).nodes) here.insert(n.name);
        auto const constants = of.section("constants");
        auto const require = [&](std::string const& name, std::size_t position) {
            if (!here.contains(name))
                source_->fail(position, "'" + name + "' stands in no formula of the effect",
                              "use it, or leave it out");
        };
        for (auto const& p : text.parameters) require(p.name, constants->find(p.name)->key);
        for (auto const& s : text.states) require(s.is.name, s.position);
        using stage = effect_text::stage;
        for (auto const& [list, at] : {std::pair{&text.inputs, stage::inputs},
                                       {&text.rates, stage::rates},
                                       {&text.outputs, stage::outputs}})
            for (auto const& s : *list)
                if (text.names_part(s, at) && !here.contains(s.name))
                    source_->fail(s.position, "'" + s.name + "' stands in no formula of the effect",
                                  at == stage::rates ? "a rate is changed as in w' += -k*w/J"
                                                     : "use it, or leave it out");
    }

    /// One of `model/effects.hpp`.
    [[nodiscard]] effect ready_made(toml_section const& of, toml_section::entry const& e) const {
        of.allow({"kind", "of", "about", "prior", "limit", "rests", "smooth_below"});
        auto const wanted = *of.text("kind");
        auto const found = std::find_if(kinds::all.begin(), kinds::all.end(),
                                        [&](auto const& k) { return k.name == wanted; });
        if (found == kinds::all.end()) {
            std::vector<std::string> known;
            for (auto const& k : kinds::all) known.emplace_back(k.name);
            source_->fail(of.find("kind")->value, "unknown kind of effect " + in_quotes(wanted),
                          name_hint(wanted, known));
        }
        for (auto const* key : {"of", "prior", found->more})
            if (key != nullptr && of.find(key) == nullptr)
                source_->fail(e.key, "the effect has no " + std::string(key),
                              "add a line: " + std::string(key) + " = ...");
        effect_request r;
        r.name = e.name;
        r.of = of.strings(*of.find("of"));
        auto const x = unit_of_targets(*found, r.of, of.find("of")->value);
        auto const size = unit_of_size(found->in, x, model_->about.time_unit);
        r.unit = found->in == effect_kind::size::time ? x : size;
        auto const prior = of.quantity(*of.find("prior"));
        r.prior = {kept(prior.lower), kept(prior.upper)};
        require_unit(prior, size, "the prior");
        if (!prior.is_range)
            source_->fail(prior.position, "a prior has two bounds", "write \"[0, 1] N\"");
        if (found->in == effect_kind::size::time && prior.lower.is_negative())
            source_->fail(prior.position, "this time may be below 0", "write \"[0, 1] s\"");
        if (auto const* l = of.find("limit")) {
            auto const limit = of.quantity(*l);
            require_unit(limit, x, "the limit");
            if (!limit.upper.is_positive())
                source_->fail(limit.position, "the limit is not above 0",
                              "say how large it may be");
            r.limit = *nearest(limit.upper);
        }
        r.rests = of.flag("rests").value_or(false);
        if (auto const* s = of.find("smooth_below")) {
            auto const smooth = of.quantity(*s);
            require_unit(smooth, x, "smooth_below");
            r.smooth_below = kept(smooth.upper);
        }
        auto result = made(*found, r, e.key);
        if (auto const about = of.text("about")) result.about = *about;
        try_out(result, e.key);
        return result;
    }
    [[nodiscard]] effect made(effect_kind const& k, effect_request const& r,
                              std::size_t position) const {
        try {
            return k.make(r);
        } catch (std::invalid_argument const& error) {
            source_->fail(position, error.what(), "correct the prior");
        }
    }
    void require_unit(stated_quantity const& q, std::string const& needed,
                      std::string const& what) const {
        auto const ratio = q.in ? q.in->in(unit(needed)) : unit::ratio{};
        if (!ratio || !ratio->is_one())
            source_->fail(q.position, what + " is in " + unit_words(*q.in) + ", not in " + needed,
                          "write it in " + needed);
    }
    /// The unit of what an effect acts on.
    [[nodiscard]] std::string unit_of_targets(effect_kind const& k,
                                              std::vector<std::string> const& of,
                                              std::size_t position) const {
        if (k.outputs == 0 ? of.empty() : of.size() != k.outputs)
            source_->fail(position,
                          std::string(k.name) + " acts on " +
                              (k.outputs == 0   ? "one output or more"
                               : k.outputs == 1 ? "one thing"
                                                : "two outputs"),
                          "correct this list");
        for (auto const& name : of)
            if (std::count(of.begin(), of.end(), name) > 1)
                source_->fail(position, in_quotes(name) + " stands twice", "correct this list");
        auto const& about = model_->about;
        auto const unit_in = [&](auto const& items, char const* kind) {
            std::string result;
            for (auto const& name : of) {
                std::vector<std::string> known;
                bool found = false;
                for (auto const& i : items) {
                    known.push_back(i.name);
                    if (i.name != name) continue;
                    found = true;
                    result = i.unit;
                }
                if (!found)
                    source_->fail(position, in_quotes(name) + " is no " + kind,
                                  name_hint(name, known));
            }
            return result;
        };
        switch (k.on) {
        case effect_kind::target::input:
            return unit_in(about.inputs, "input");
        case effect_kind::target::state:
            return unit_in(about.states, "state");
        case effect_kind::target::constant:
            return unit_in(about.constants, "constant");
        default:
            return unit_in(about.channels, "output");
        }
    }

    std::shared_ptr<model_source const> source_;
    std::shared_ptr<model_names> names_;
    recorded_model const* model_;
    std::vector<interval> constants_; ///< their priors, or values
};

} // namespace sivid::text_detail

#endif
