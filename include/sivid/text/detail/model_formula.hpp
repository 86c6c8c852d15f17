// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_MODEL_FORMULA_HPP
#define SIVID_TEXT_DETAIL_MODEL_FORMULA_HPP

#include <sivid/model/detail/formula_grammar.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/graph/operation.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/text/detail/model_source.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// A formula as it was read: operands stand before what is made of them, the whole is the last.
struct formula {
    enum class kind {
        number,   ///< `value`, in `in`
        name,     ///< of a state, an input, a constant, a named part, the time, pi
        rate,     ///< of the state `name`
        shown,    ///< what the channel `name` shows
        function, ///< `op` of one operand, or of two
        power,    ///< `exponent` of one operand
        choice    ///< operands a, b, x, y: x where a > b, y where a < b
    };
    struct node {
        kind what = kind::number;
        std::size_t begin = 0;    ///< where it begins in the source
        std::size_t position = 0; ///< of its sign or its name
        operation op = operation::literal;
        std::vector<std::size_t> of{};
        std::string name{};
        expression value{};
        unit in{};
        bool is_zero = false;
        int exponent = 0;
    };
    std::vector<node> nodes;
    [[nodiscard]] std::size_t begin() const { return nodes.back().begin; }
    [[nodiscard]] bool has(kind what) const {
        return std::any_of(nodes.begin(), nodes.end(),
                           [&](node const& n) { return n.what == what; });
    }
};

/// "W *= 1 - k*t": what changes, how, and by what; or "J*w' = T - b*w", an equation between two
/// formulas.
struct statement {
    std::string name; ///< empty: of formulas
    bool is_rate = false;
    char how = '='; ///< or + - * / in front of it
    std::size_t position = 0;
    formula by;
    formula left{}; ///< of an equation between formulas
};

/// Reads formulas and statements of a part of the source.
class formula_reader : model_detail::formula_grammar<formula_reader, std::size_t> {
    using grammar = model_detail::formula_grammar<formula_reader, std::size_t>;
    friend grammar;

public:
    formula_reader(model_source const& source, std::size_t begin, std::size_t end)
        : grammar({source.text().substr(0, end),
                   {.fail = source.failing(), .longest = model_source::largest, .comments = true},
                   begin},
                  60) {}

    /// The one formula that stands there.
    [[nodiscard]] formula read() {
        auto result = next();
        if (!words_.at_end())
            words_.fail("nothing can follow here", "a sign is missing: write * for products");
        return result;
    }
    /// Statements one after the other, each on lines of its own or with ; between.
    [[nodiscard]] std::vector<statement> read_statements() {
        std::vector<statement> result;
        while (!words_.at_end()) {
            if (words_.take(";")) continue;
            statement s;
            s.position = words_.position();
            auto const begin = words_;
            auto const name = words_.take_name();
            s.name = name.value_or("");
            s.is_rate = name && words_.take("'");
            for (char const how : {'+', '-', '*', '/'})
                if (name && words_.take(std::string{how, '='})) s.how = how;
            if (s.how == '=' && !(name && words_.take("="))) between_formulas(s, begin);
            s.by = next();
            result.push_back(std::move(s));
        }
        return result;
    }

private:
    using kind = formula::kind;

    /// Up to the sign of an equation whose left side is a formula, with a rate in it.
    /// @param begin  of the statement
    void between_formulas(statement& s, model_detail::formula_words const& begin) {
        auto const behind_name = std::exchange(words_, begin);
        bool const named = !s.name.empty();
        if (named || words_.peek("(") || words_.peek("-") || words_.take_number()) {
            words_ = begin;
            s.left = next();
            if (s.left.has(kind::rate) && words_.take("=")) {
                s.name.clear();
                s.is_rate = false;
                return;
            }
        }
        words_ = behind_name;
        if (!named)
            words_.fail("an equation begins with a name",
                        "write one as in w' = -b*w/J; a sign is missing, or a bracket");
        words_.need("=", "write an equation as in w' = -b*w/J or J*w' = -b*w, * for products, and "
                         "units of numbers in brackets: 9.81 [m/s^2]");
    }
    [[nodiscard]] formula next() {
        sum();
        return std::exchange(made_, {});
    }
    std::size_t add(formula::node n) {
        made_.nodes.push_back(std::move(n));
        return made_.nodes.size() - 1;
    }
    [[nodiscard]] std::size_t begin_of(std::size_t k) const { return made_.nodes[k].begin; }

    // What the grammar asks for.
    std::size_t in_brackets() { return sum(); }
    std::size_t placed(std::size_t of, std::size_t position) {
        made_.nodes[of].begin = position;
        return of;
    }
    std::size_t combined(operation op, std::size_t a, std::size_t b, std::size_t sign) {
        return add({kind::function, begin_of(a), sign, op, {a, b}});
    }
    std::size_t negated(std::size_t a, std::size_t position) {
        return add({kind::function, position, position, operation::neg, {a}});
    }
    std::size_t raised(std::size_t a, std::size_t hat) {
        formula::node n{kind::power, begin_of(a), hat, operation::pown, {a}};
        n.exponent = whole_power(hat, -32, 32);
        return add(std::move(n));
    }
    std::size_t constant(std::string_view text, std::size_t position) {
        auto const value = parse_decimal(text);
        auto const nearest = parse_nearest(text);
        if (!value || !nearest)
            words_.fail_at(position, "this is no finite number",
                           "write a decimal such as 0.25 or 1e-3");
        formula::node n{kind::number, position, position};
        n.value = decimal_expression(text);
        n.is_zero = value->lower() == 0 && value->upper() == 0;
        auto const bracket = words_.position();
        if (words_.take("[")) {
            auto const in = words_.take_up_to(']');
            if (!in)
                words_.fail_at(bracket, "the bracket of the unit does not close",
                               "write a unit as in 9.81 [m/s^2]");
            n.in = unit(*in);
            if (!n.in.fault().empty())
                words_.fail_at(bracket + 1, "this is no unit: " + n.in.fault(),
                               "write a unit as in 9.81 [m/s^2]");
        }
        return add(std::move(n));
    }
    /// The number as C++ has it: `0.1_dec`.
    [[nodiscard]] static expression decimal_expression(std::string_view text) {
        return {decimal{text.data(), text.size(), false}}; // read at once
    }
    std::size_t quantity_of(std::string const& name, std::size_t position) {
        formula::node n{kind::name, position, position};
        n.name = name;
        if (words_.take("'")) n.what = kind::rate;
        return add(std::move(n));
    }
    std::size_t call(std::string const& name, std::size_t position) {
        if (name == "if") return choice(position);
        if (name == "shown") {
            formula::node n{kind::shown, position, words_.position()};
            if (auto const channel = words_.take_name()) n.name = *channel;
            words_.need(")", "write shown(NAME) with the name of an output");
            return add(std::move(n));
        }
        if (name == "clamp" || name == "deadband") return threshold(name == "clamp", position);
        auto const op = model_detail::function_named(name);
        if (!op)
            words_.fail_at(position, "unknown function '" + name + "'",
                           name_hint(name, functions()) + "; products need a *");
        auto of = sum();
        if (!is_binary(*op)) {
            words_.need(")", "close the bracket: this function takes one number");
            return add({kind::function, position, position, *op, {of}});
        }
        words_.need(",", "this function takes two numbers or more");
        do {
            auto const other = sum();
            of = add({kind::function, position, position, *op, {of, other}});
        } while (words_.take(","));
        words_.need(")", "close the bracket");
        return of;
    }
    [[nodiscard]] static std::vector<std::string> functions() {
        return {"abs", "sign", "min", "max",  "sqrt", "sqr",   "exp",      "log",
                "sin", "cos",  "tan", "atan", "tanh", "clamp", "deadband", "if"};
    }
    /// if(a > b, x, y)
    std::size_t choice(std::size_t position) {
        std::string const form = "write if(a > b, x, y)";
        auto a = sum();
        auto const relation = words_.take_relation();
        if (!relation) words_.fail("a comparison is needed here", form);
        auto b = sum();
        if (relation->front() == '<') std::swap(a, b);
        words_.need(",", form);
        auto const x = sum();
        words_.need(",", form);
        auto const y = sum();
        words_.need(")", form);
        return add({kind::choice, position, position, operation::sign, {a, b, x, y}});
    }
    /// clamp(x, low, high), or deadband(x, half width)
    std::size_t threshold(bool clamps, std::size_t position) {
        std::string const form = clamps ? "write clamp(x, low, high)" : "write deadband(x, width)";
        auto const function = [&](operation op, std::size_t a, std::size_t b) {
            return add({kind::function, position, position, op, {a, b}});
        };
        auto const x = sum();
        words_.need(",", form);
        auto const low = sum();
        std::size_t result = 0;
        if (clamps) {
            words_.need(",", form);
            auto const high = sum();
            result = function(operation::min, function(operation::max, x, low), high);
        } else { // as deadband of expressions
            formula::node zero{kind::number, position, position};
            zero.is_zero = true;
            auto const none = add(std::move(zero));
            auto const above = function(operation::max, function(operation::sub, x, low), none);
            auto const below = function(operation::min, function(operation::add, x, low), none);
            result = function(operation::add, above, below);
        }
        words_.need(")", form);
        return result;
    }

    formula made_;
};

} // namespace sivid::text_detail

#endif
