// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_MODEL_NAMES_HPP
#define SIVID_TEXT_DETAIL_MODEL_NAMES_HPP

#include <sivid/model/unit.hpp>
#include <sivid/text/detail/formula_value.hpp>
#include <sivid/text/detail/model_formula.hpp>
#include <sivid/text/detail/model_source.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// What a model's names mean, and the formulas of its named parts.
struct model_names {
    enum class kind { time, pi, state, input, constant, part };
    struct item {
        kind what = kind::time;
        unit in{};
        std::size_t index = 0;    ///< among the states, inputs, constants or parts
        std::size_t position = 0; ///< where it is declared
    };
    struct part {
        std::string name;
        formula is;
    };

    std::map<std::string, item, std::less<>> items;
    std::vector<part> parts; ///< in the file's order
    unit time;
    std::set<std::string, std::less<>> used; ///< what stands in formulas

    /// Notes what stands in a formula.
    void use(formula const& f) {
        for (auto const& n : f.nodes)
            if (n.what == formula::kind::name) used.insert(n.name);
    }

    /// Enters a name that formulas may use.
    void declare(model_source const& source, std::string const& name, item const& what) {
        auto const letter = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        };
        bool plain = !name.empty() && letter(name.front());
        for (char const c : name) plain = plain && (letter(c) || (c >= '0' && c <= '9'));
        if (!plain)
            source.fail(what.position, "a name has letters, digits and _ and begins with a letter",
                        "give another name");
        if (name == "t" || name == "pi" || name == "if" || name == "clamp" || name == "shown" ||
            name == "deadband" || model_detail::function_named(name))
            source.fail(what.position, "'" + name + "' has a meaning of its own in formulas",
                        "give another name");
        if (!items.emplace(name, what).second)
            source.fail(what.position, "two things are called '" + name + "'",
                        "states, inputs, constants and named parts need names of their own");
    }
    /// All that are of this kind, or all.
    [[nodiscard]] std::vector<std::string> all(std::optional<kind> of = {}) const {
        std::vector<std::string> names;
        for (auto const& [name, its] : items)
            if (!of || its.what == *of) names.push_back(name);
        return names;
    }
    /// The state of this name. @throws model_text_error  for another name
    [[nodiscard]] item const& state(model_source const& source, std::string const& name,
                                    std::size_t position) const {
        auto const found = items.find(name);
        if (found == items.end() || found->second.what != kind::state)
            source.fail(position, "'" + name + "' is no state", name_hint(name, all(kind::state)));
        return found->second;
    }
    /// The unit of the rate of something.
    [[nodiscard]] unit rate_of(item const& x) const { return x.in.times(time, -1); }
};

/// The values of a model's names at some stage of its recording: leaves as somebody gives them,
/// and named parts, each evaluated once.
class named_values {
public:
    using kind = model_names::kind;
    /// The value of a state, an input, a constant, or the time.
    using leaf = std::function<expression(std::string const&, model_names::item const&)>;
    /// What only this stage knows, by its node; nothing: it is none of this.
    using further = std::function<std::optional<formula_value>(formula::node const&)>;

    /// @param also  names that `own` knows, for messages
    named_values(model_source const& source, model_names const& names, leaf leaves,
                 further own = {}, formula_evaluator::partial tell = {},
                 std::vector<std::string> also = {})
        : source_(&source),
          names_(&names),
          leaves_(std::move(leaves)),
          own_(std::move(own)),
          also_(std::move(also)),
          evaluate_(
              source, [this](formula::node const& n) { return value_of(n); }, std::move(tell)) {}
    named_values(named_values const&) = delete;
    named_values& operator=(named_values const&) = delete;

    [[nodiscard]] formula_value operator()(formula const& f) { return evaluate_(f); }
    [[nodiscard]] formula_value fitted(formula const& f, unit const& to, std::string const& what) {
        return evaluate_.fitted(evaluate_(f), to, what);
    }
    /// A named part, by its number.
    formula_value part(std::size_t k, std::size_t asked_at) {
        if (auto const known = parts_.find(k); known != parts_.end()) return known->second;
        auto const& p = names_->parts[k];
        if (!open_.insert(k).second)
            source_->fail(asked_at, "'" + p.name + "' is defined by itself" + circle(k),
                          "write one of these formulas without the others");
        path_.push_back(k);
        auto const value = evaluate_(p.is);
        path_.pop_back();
        open_.erase(k);
        return parts_[k] = value;
    }
    /// What leaves are has changed.
    void forget() { parts_.clear(); }

private:
    /// "r, by p, q"
    [[nodiscard]] std::string circle(std::size_t k) const {
        std::string text;
        bool within = false;
        for (auto const i : path_) {
            within = within || i == k;
            if (within && text.size() < 200)
                text += (text.empty() ? ": " : " -> ") + names_->parts[i].name;
        }
        return text + " -> " + names_->parts[k].name;
    }
    [[nodiscard]] formula_value value_of(formula::node const& n) {
        if (own_)
            if (auto const own = own_(n)) return *own;
        if (n.what == formula::kind::shown)
            source_->fail(n.begin, "shown(...) stands in the outputs of effects only",
                          "write the formula of the output");
        if (n.what == formula::kind::rate)
            source_->fail(n.begin, "the rate " + n.name + "' has no place here",
                          "rates stand in the equations and in outputs");
        if (n.name == "pi") return {4 * atan(expression(1))};
        auto const found = names_->items.find(n.name);
        if (found == names_->items.end()) {
            auto known = names_->all();
            known.insert(known.begin(), also_.begin(), also_.end());
            source_->fail(n.begin, "unknown name '" + n.name + "'", name_hint(n.name, known));
        }
        auto const& item = found->second;
        if (item.what == kind::part) return part(item.index, n.begin);
        return {leaves_(n.name, item), item.in};
    }

    model_source const* source_;
    model_names const* names_;
    leaf leaves_;
    further own_;
    std::vector<std::string> also_;
    formula_evaluator evaluate_;
    std::map<std::size_t, formula_value> parts_;
    std::set<std::size_t> open_;
    std::vector<std::size_t> path_;
};

} // namespace sivid::text_detail

#endif
