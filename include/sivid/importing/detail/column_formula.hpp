// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP
#define SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/detail/formula_grammar.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// What a formula of readings is: between these, which are the same where it is exact in doubles.
struct formula_reading {
    exact_decimal lower, upper;
    [[nodiscard]] bool is_exact() const { return lower == upper; }
};

namespace importing_detail {

/// Records a formula of columns as a function of them, in the order in which they are named.
class column_formula_reader : model_detail::formula_grammar<column_formula_reader, node_id> {
    using grammar = model_detail::formula_grammar<column_formula_reader, node_id>;
    friend grammar;

public:
    /// @param fail  throws, with what is wrong at which place
    column_formula_reader(std::string const& text, model_detail::formula_words::failure fail)
        : grammar({text, {.fail = std::move(fail), .longest = 1000}}, 60) {}

    [[nodiscard]] recorded_map read(std::vector<std::string>& names) {
        auto const whole = sum();
        if (!words_.at_end())
            words_.fail("nothing can follow here", "a sign is missing: write * for products");
        if (names_.empty()) words_.fail_at(0, "a formula of no column", "name one");
        names = names_;
        return {names_.size(), std::move(g_), {whole}};
    }

private:
    // What the grammar asks for.
    node_id in_brackets() { return sum(); }
    static node_id placed(node_id of, std::size_t) { return of; }
    node_id combined(operation op, node_id a, node_id b, std::size_t) {
        return g_.binary(op, a, b);
    }
    node_id negated(node_id a, std::size_t) { return g_.neg(a); }
    node_id raised(node_id a, std::size_t hat) { return g_.pown(a, whole_power(hat, 1, 32)); }
    node_id constant(std::string_view text, std::size_t position) {
        auto const value = parse_decimal(text);
        if (!value || !std::isfinite(mag(*value)))
            words_.fail_at(position, "this is no finite number",
                           "write a decimal such as 0.25 or 1e-3");
        return g_.constant(literal{*value, mid(*value)});
    }
    node_id quantity_of(std::string const& name, std::size_t) {
        auto const found = std::find(names_.begin(), names_.end(), name);
        auto const index = static_cast<std::size_t>(found - names_.begin());
        if (found == names_.end()) names_.push_back(name);
        return g_.leaf(operation::constant, index);
    }
    node_id call(std::string const& name, std::size_t position) {
        auto const op = model_detail::function_named(name);
        if (!op)
            words_.fail_at(position, "unknown function '" + name + "'",
                           "products need a *; functions are abs, sign, min, max, sqrt, sqr, exp, "
                           "log, sin, cos, tan, atan, tanh");
        auto of = sum();
        if (is_binary(*op)) {
            words_.need(",", "this function takes two numbers or more");
            do of = g_.binary(*op, of, sum());
            while (words_.take(","));
        } else {
            of = g_.unary(*op, of);
        }
        words_.need(")", "close the bracket");
        return of;
    }

    graph g_;
    std::vector<std::string> names_;
};

} // namespace importing_detail

/// A formula of columns, as "65536*hi + lo" or "sqrt(x^2 + y^2)", read once, evaluated by row.
class column_formula {
public:
    /// @param fail  throws, with what is wrong at which place
    column_formula(std::string text, model_detail::formula_words::failure fail)
        : text_(std::move(text)),
          of_(importing_detail::column_formula_reader(text_, std::move(fail)).read(names_)) {}

    [[nodiscard]] std::string const& text() const { return text_; }
    /// The columns that it names, each once.
    [[nodiscard]] std::vector<std::string> const& names() const { return names_; }

    /// @param readings  of the columns, in the order of `names`
    /// @returns nothing where it is not defined, or beyond the range of double
    /// @guarantee  the exact value lies in what is returned; sign(0) is anywhere from -1 to 1
    [[nodiscard]] std::optional<formula_reading>
    operator()(std::span<exact_decimal const> readings) const {
        std::vector<interval> sides;
        for (auto const& x : readings) {
            auto const side = enclose(x);
            if (!side) return std::nullopt;
            sides.push_back(*side);
        }
        auto const value = of_.over(box(std::move(sides)));
        if (!value || !is_bounded((*value)[0])) return std::nullopt;
        return formula_reading{exact_decimal::of((*value)[0].lower()),
                               exact_decimal::of((*value)[0].upper())};
    }

private:
    std::string text_;
    std::vector<std::string> names_;
    recorded_map of_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_DETAIL_COLUMN_FORMULA_HPP
