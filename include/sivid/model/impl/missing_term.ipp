// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_MISSING_TERM_IPP
#define SIVID_MODEL_IMPL_MISSING_TERM_IPP

#include <sivid/model/named_effects.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/detail/formula_grammar.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

namespace detail {

/// Reads the formula of a term.
class term_reader : model_detail::formula_grammar<term_reader, expression> {
    using grammar = model_detail::formula_grammar<term_reader, expression>;
    friend grammar;

public:
    using leaf = std::function<expression(std::string const&)>;

    /// What turn and wave bring: a, b, w, or nothing where these do not stand.
    struct unknowns {
        std::function<expression(std::size_t)> parameter;
        bool turns = false, waves = false; ///< what was read
    };

    term_reader(std::string const& name, std::size_t begin, leaf value, unknowns& own)
        : grammar({name, {.fail = failing(name)}, begin}, most_nested),
          value_(std::move(value)),
          own_(&own) {}

    [[nodiscard]] expression read() {
        auto const result = product();
        if (!words_.at_end()) words_.fail("'*' or '/' is needed here", "a sum stands in brackets");
        return result;
    }

private:
    static constexpr std::size_t most_nested = 16;

    [[nodiscard]] static model_detail::formula_words::failure failing(std::string const& name) {
        return [&name](std::size_t at, std::string const& problem, std::string const& remedy) {
            throw std::invalid_argument("term '" + name + "', character " + std::to_string(at + 1) +
                                        ": " + problem + "; " + remedy +
                                        "; write a term as in v'~0.5*abs(v)*v");
        };
    }

    // What the grammar asks for.
    [[nodiscard]] expression in_brackets() {
        ++brackets_;
        auto const result = sum();
        --brackets_;
        return result;
    }
    [[nodiscard]] expression combined(operation op, expression const& a, expression const& b,
                                      std::size_t sign) {
        switch (op) {
        case operation::add:
            return a + b;
        case operation::sub:
            return a - b;
        case operation::mul:
            return a * b;
        default:
            if (own_->turns && sign < turned_at_) outside_only(turned_at_);
            return a / b;
        }
    }
    [[nodiscard]] expression negated(expression const& a, std::size_t) { return -a; }
    [[nodiscard]] expression placed(expression a, std::size_t) { return a; }
    [[nodiscard]] expression raised(expression const& a, std::size_t hat) {
        return pown(a, whole_power(hat, 2, 9));
    }
    [[nodiscard]] expression constant(std::string_view text, std::size_t position) {
        auto const value = parse_decimal(text);
        if (!value) words_.fail_at(position, "this is no number", "write a decimal such as 0.25");
        return expression(*value);
    }
    [[nodiscard]] expression quantity_of(std::string const& name, std::size_t) {
        return value_(name);
    }
    /// A number behind a colon.
    [[nodiscard]] expression width() {
        words_.need(":", "write sgn(x:0.1) or beyond(x:0.1)");
        auto const position = words_.position();
        auto const text = words_.take_number();
        if (!text) words_.fail("a number is needed here", "write sgn(x:0.1) or beyond(x:0.1)");
        return constant(*text, position);
    }
    [[nodiscard]] expression call(std::string const& word, std::size_t position) {
        auto const x = in_brackets();
        expression result;
        if (word == "abs") {
            result = abs(x);
        } else if (word == "sqrt") {
            result = sqrt(x);
        } else if (word == "exp") {
            result = exp(x);
        } else if (word == "sgn") {
            result = x / sqrt(sqr(x) + sqr(width()));
        } else if (word == "beyond") {
            result = deadband(x, width());
        } else if (word == "turn" || word == "wave") {
            result = turned(word == "wave", x, position);
        } else {
            words_.fail_at(position, "'" + word + "' is no function",
                           "there are abs, sqrt, exp, sgn, beyond, turn, wave");
        }
        words_.need(")", "close the bracket");
        return result;
    }
    [[nodiscard]] expression turned(bool waves, expression const& x, std::size_t position) {
        if (brackets_ > 0 || own_->turns) outside_only(position);
        own_->turns = true;
        own_->waves = waves;
        turned_at_ = position;
        auto const angle = waves ? own_->parameter(2) * x : x;
        return own_->parameter(0) * cos(angle) + own_->parameter(1) * sin(angle);
    }
    [[noreturn]] void outside_only(std::size_t position) const {
        words_.fail_at(position, "turn and wave stand once, outside of brackets",
                       "multiply the rest by them");
    }

    leaf value_;
    unknowns* own_;
    std::size_t brackets_ = 0, turned_at_ = 0;
};

} // namespace detail

SIVID_DECL effect missing_term(std::string const& name) {
    using namespace literals;
    auto const mark = name.find("'~");
    if (mark == std::string::npos || mark == 0) {
        throw std::invalid_argument("'" + name +
                                    "' names no term; write one as in v'~0.5*abs(v)*v");
    }
    auto const begin = mark + 2;
    // Once without a model: is it a formula, and what are its unknowns?
    detail::term_reader::unknowns own{[](std::size_t) { return expression(1); }};
    (void)detail::term_reader(
        name, begin, [](std::string const&) { return expression(1); }, own)
        .read();
    effect e;
    e.name = name;
    auto const state = name.substr(0, mark);
    e.about = "missing in " + state + "': " + name.substr(begin);
    if (own.turns) {
        e.parameters = {{"a", "1", -1_dec, 1_dec, 0_dec}, {"b", "1", -1_dec, 1_dec, 0_dec}};
        if (own.waves) e.parameters.push_back({"w", "1", 0.85_dec, 1.18_dec, 1_dec});
    } else {
        e.parameters = {{"k", "1", -1_dec, 1_dec, 0_dec}};
    }
    e.on_rates = [name, begin, state, alone = !own.turns](effect_scope& m) {
        detail::term_reader::unknowns unknown{[&m](std::size_t k) { return m.parameter(k); }};
        auto const term =
            detail::term_reader(
                name, begin, [&m](std::string const& x) { return m.named(x); }, unknown)
                .read();
        m.rate(state) += alone ? m.parameter() * term : term;
    };
    return e;
}

} // namespace sivid

#endif
