// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_NUMBERS_HPP
#define SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_NUMBERS_HPP

#include <sivid/decision/requirement/detail/requirement_words.hpp>
#include <sivid/model/detail/formula_grammar.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::decision_detail {

/// What was read of a requirement: a number at each instant, or a formula.
struct requirement_operand {
    bool is_formula = false;
    node_id value = 0;    ///< of a number
    std::size_t part = 0; ///< of a formula
    std::size_t position = 0;
    std::optional<double> time{}; ///< of a number that is asked at one time only
};

/// Reads the expressions of a requirement, or of a control law, into the graph of a model.
class requirement_numbers
    : protected model_detail::formula_grammar<class requirement_numbers, requirement_operand> {
protected:
    using grammar = model_detail::formula_grammar<requirement_numbers, requirement_operand>;
    friend grammar;
    using operand = requirement_operand;
    using level = grammar::level;

    /// @param what  the text is, for messages; a literal
    requirement_numbers(std::string_view what, std::string_view text, recorded_model& model)
        : grammar(requirement_words(what, text), 60), model_(model) {}
    ~requirement_numbers() = default;

    graph& g() { return model_.g; }

    /// What stands in brackets may be a formula.
    virtual operand in_brackets() = 0;
    /// A further function, its bracket open; nothing where there is none of this name.
    virtual std::optional<operand> further_call(std::string const&, std::size_t) {
        return std::nullopt;
    }
    /// Names of further functions, for messages.
    [[nodiscard]] virtual std::string further_functions() const { return ""; }

    /// Operations of the graph; what folds to no number is refused.
    template <class Operation>
    node_id numeric(std::size_t position, Operation const& compute) {
        try {
            return compute();
        } catch (std::domain_error const&) {
            words_.fail_at(position, "this is no finite number", "use smaller numbers");
        }
    }
    operand number(std::size_t position, node_id value) {
        return {.value = value, .position = position};
    }
    operand binary(operation op, operand const& a, operand const& b) {
        need_plain(a);
        need_plain(b);
        if (op == operation::div && g().is(b.value, 0))
            words_.fail_at(b.position, "division by 0", "correct the divisor");
        return number(a.position,
                      numeric(a.position, [&] { return g().binary(op, a.value, b.value); }));
    }

    // What the grammar asks for.
    operand combined(operation op, operand const& a, operand const& b, std::size_t) {
        return binary(op, a, b);
    }
    operand negated(operand const& of, std::size_t position) {
        need_plain(of);
        return number(position, g().neg(of.value));
    }
    operand raised(operand const& base, std::size_t hat) {
        need_plain(base);
        int const power = whole_power(hat, 1, 32);
        return number(base.position, numeric(hat, [&] {
                          return pown(expression(g(), base.value), power).in(g());
                      }));
    }
    operand placed(operand of, std::size_t position) {
        of.position = position;
        return of;
    }
    operand constant(std::string_view text, std::size_t position) {
        auto const value = parse_decimal(text);
        if (!value || !std::isfinite(mag(*value)))
            words_.fail_at(position, "this is no finite number",
                           "write a decimal such as 0.25 or 1e-3");
        return number(position, numeric(position, [&] {
                          return g().constant(literal{*value, mid(*value)});
                      }));
    }

    /// The channel that a bracket names, and the bracket's end.
    std::size_t channel_in_bracket() {
        auto const channel = words_.take_name();
        auto const& all = model_.about.channels;
        auto const found = std::find_if(
            all.begin(), all.end(), [&](auto const& c) { return channel && c.name == *channel; });
        if (found == all.end())
            words_.fail("no channel of the model", "the model has: " + joined_names(all));
        words_.need(")", "close the bracket");
        return static_cast<std::size_t>(found - all.begin());
    }

    operand call(std::string const& name, std::size_t position) {
        if (auto const own = further_call(name, position)) return *own;
        if (name == "measured") return number(position, model_.observe[channel_in_bracket()]);
        auto const found = model_detail::function_named(name);
        if (!found)
            words_.fail_at(position, "unknown function '" + name + "'",
                           "known: sqrt, exp, log, sin, cos, tan, atan, tanh, abs, sign, min, max, "
                           "measured" +
                               further_functions());
        auto of = sum();
        need_plain(of);
        if (is_binary(*found)) {
            words_.need(",", "this function takes two numbers or more");
            do {
                of = binary(*found, of, sum());
            } while (words_.take(","));
            words_.need(")", "close the bracket");
            of.position = position;
            return of;
        }
        words_.need(")", "close the bracket");
        return number(position, numeric(position, [&] { return g().unary(*found, of.value); }));
    }

    operand quantity_of(std::string const& name, std::size_t position) {
        auto const& about = model_.about;
        auto const place = [&](auto const& items) -> std::optional<std::size_t> {
            auto const found = std::find_if(items.begin(), items.end(),
                                            [&](auto const& i) { return i.name == name; });
            if (found == items.end()) return std::nullopt;
            return static_cast<std::size_t>(found - items.begin());
        };
        if (auto const i = place(about.states))
            return number(position, g().leaf(operation::state, *i));
        if (auto const i = place(about.channels)) return number(position, model_.observe[*i]);
        if (auto const i = place(about.inputs))
            return number(position, g().leaf(operation::input, *i));
        if (auto const i = place(about.constants))
            return number(position, g().leaf(operation::constant, *i));
        if (name == "t") return number(position, g().leaf(operation::time, 0));
        auto known = "states " + joined_names(about.states) + "; channels " +
                     joined_names(about.channels) + "; inputs " + joined_names(about.inputs) +
                     "; constants " + joined_names(about.constants) + "; t for the time";
        words_.fail_at(position, "unknown name '" + name + "'", "known: " + known);
    }

    [[nodiscard]] std::string const& time_unit() const { return model_.about.time_unit; }
    /// A time in the model's unit, or `end`.
    double instant(double end) {
        if (words_.take("end")) return end;
        auto const position = words_.position();
        auto const text = words_.take_number();
        auto const time = text ? parse_nearest(*text) : std::nullopt;
        if (!time || !std::isfinite(*time) || *time < 0)
            words_.fail_at(position, "a time in " + time_unit() + " is needed here",
                           "write a number of 0 or more, such as 0.5, or end");
        return *time;
    }

    void need_number(operand const& x) {
        if (x.is_formula)
            words_.fail_at(x.position, "a number is needed here, not something that holds or not",
                           "compare numbers, and join comparisons by and, or");
    }

    /// A number to calculate with.
    void need_plain(operand const& x) {
        need_number(x);
        if (x.time)
            words_.fail_at(x.position, "'at' stands behind a whole expression",
                           "write (x + 1) at 2 > 3, not x at 2 + 1 > 3");
    }

    recorded_model& model_;
};

} // namespace sivid::decision_detail

#endif
