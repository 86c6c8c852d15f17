// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP
#define SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/detail/formula_grammar.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// What a formula of readings is: exact after +, -, *, whole powers, abs, sign, min and max of
/// decimals, else an interval around it.
struct formula_reading {
    exact_decimal lower, upper;
    [[nodiscard]] bool is_exact() const { return lower == upper; }
};

/// A formula of columns, as "65536*hi + lo" or "sqrt(x^2 + y^2)", read once, evaluated by row.
class column_formula : model_detail::formula_grammar<column_formula, std::size_t> {
    using grammar = model_detail::formula_grammar<column_formula, std::size_t>;
    friend grammar;

public:
    /// @param fail  throws, with what is wrong at which place
    column_formula(std::string const& text, model_detail::formula_words::failure fail)
        : grammar({text, {.fail = std::move(fail), .longest = 1000}}, 60), text_(text) {
        sum();
        if (!words_.at_end())
            words_.fail("nothing can follow here", "a sign is missing: write * for products");
        if (names_.empty()) words_.fail_at(0, "a formula of no column", "name one");
    }

    [[nodiscard]] std::string const& text() const { return text_; }
    /// The columns that it names, each once.
    [[nodiscard]] std::vector<std::string> const& names() const { return names_; }

    /// @param readings  of the columns, in the order of `names`
    /// @returns nothing where it is not defined, or beyond the range of double
    /// @guarantee  the exact value lies in what is returned
    [[nodiscard]] std::optional<formula_reading>
    operator()(std::span<exact_decimal const> readings) const {
        std::vector<value> values;
        for (auto const& n : nodes_) {
            auto made = n.op == operation::state     ? std::optional<value>{{readings[n.a], {}}}
                        : n.op == operation::literal ? std::optional<value>{{n.number, {}}}
                                                     : of(n, values[n.a], values[n.b]);
            if (!made) return std::nullopt;
            values.push_back(std::move(*made));
        }
        auto const& whole = values.back();
        if (whole.exact) return formula_reading{*whole.exact, *whole.exact};
        return formula_reading{exact_decimal::of(whole.around.lower()),
                               exact_decimal::of(whole.around.upper())};
    }

private:
    struct node {
        operation op = operation::literal; ///< `state`: reading `a`
        std::size_t a = 0, b = 0;
        int exponent = 0;
        exact_decimal number{};
    };
    struct value {
        std::optional<exact_decimal> exact;
        interval around; ///< where that is nothing
    };

    [[nodiscard]] static std::optional<value> of(node const& n, value const& a, value const& b) {
        if (a.exact && b.exact)
            if (auto result = exactly(n, *a.exact, *b.exact)) return value{result, {}};
        auto const x = a.exact ? enclose(*a.exact) : std::optional(a.around);
        auto const y = b.exact ? enclose(*b.exact) : std::optional(b.around);
        if (!x || !y) return std::nullopt;
        bool undefined = false;
        auto const result = apply<proven_arithmetic<interval>>(n.op, *x, *y, n.exponent, undefined);
        if (undefined || !is_bounded(result)) return std::nullopt;
        return value{{}, result};
    }
    /// Nothing: only nearly.
    [[nodiscard]] static std::optional<exact_decimal> exactly(node const& n, exact_decimal const& a,
                                                              exact_decimal const& b) {
        switch (n.op) {
        case operation::neg:
            return -a;
        case operation::add:
            return a + b;
        case operation::sub:
            return a - b;
        case operation::mul:
        case operation::sqr:
            return short_enough(a.times(b));
        case operation::pown: {
            auto result = std::optional{a};
            for (int k = 1; k < n.exponent && result; ++k) result = short_enough(result->times(a));
            return result;
        }
        case operation::abs:
            return a.is_negative() ? -a : a;
        case operation::sign: // of a reading, not of a set
            return *exact_decimal::parse(a.is_zero() ? "0" : a.is_negative() ? "-1" : "1");
        case operation::min:
            return b < a ? b : a;
        case operation::max:
            return a < b ? b : a;
        default:
            return std::nullopt;
        }
    }
    /// Digits would double with each product.
    [[nodiscard]] static std::optional<exact_decimal> short_enough(exact_decimal x) {
        constexpr std::size_t digits = 60; // more than two readings of a double have
        if (x.divided_by(1, digits).first == x) return x;
        return std::nullopt;
    }

    // What the grammar asks for.
    std::size_t add(node n) {
        nodes_.push_back(std::move(n));
        return nodes_.size() - 1;
    }
    std::size_t in_brackets() { return sum(); }
    static std::size_t placed(std::size_t of, std::size_t) { return of; }
    std::size_t combined(operation op, std::size_t a, std::size_t b, std::size_t) {
        return add({op, a, b});
    }
    std::size_t negated(std::size_t a, std::size_t) { return add({operation::neg, a, a}); }
    std::size_t raised(std::size_t a, std::size_t hat) {
        return add({operation::pown, a, a, whole_power(hat, 1, 32)});
    }
    std::size_t constant(std::string_view text, std::size_t position) {
        auto number = exact_decimal::parse(text);
        if (!number || !enclose(*number))
            words_.fail_at(position, "this is no finite number",
                           "write a decimal such as 0.25 or 1e-3");
        return add({operation::literal, 0, 0, 0, std::move(*number)});
    }
    std::size_t quantity_of(std::string const& name, std::size_t) {
        auto const found = std::find(names_.begin(), names_.end(), name);
        auto const index = static_cast<std::size_t>(found - names_.begin());
        if (found == names_.end()) names_.push_back(name);
        return add({operation::state, index, 0});
    }
    std::size_t call(std::string const& name, std::size_t position) {
        auto const op = model_detail::function_named(name);
        if (!op)
            words_.fail_at(position, "unknown function '" + name + "'",
                           "products need a *; functions are abs, sign, min, max, sqrt, sqr, exp, "
                           "log, sin, cos, tan, atan, tanh");
        auto of = sum();
        if (is_binary(*op)) {
            words_.need(",", "this function takes two numbers or more");
            do of = add({*op, of, sum()});
            while (words_.take(","));
        } else {
            of = add({*op, of, of});
        }
        words_.need(")", "close the bracket");
        return of;
    }

    std::string text_;
    std::vector<std::string> names_;
    std::vector<node> nodes_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP
