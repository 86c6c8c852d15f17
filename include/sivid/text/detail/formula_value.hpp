// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_FORMULA_VALUE_HPP
#define SIVID_TEXT_DETAIL_FORMULA_VALUE_HPP

#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/text/detail/model_formula.hpp>
#include <sivid/text/detail/model_source.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::text_detail {

/// A number with its unit: value + sum of factor * rate, over the rates that are still to be solved
/// for (`implicit_rates`), in a formula that is linear in them.
struct formula_value {
    expression value;
    unit in{};
    bool fits_all = false;                     ///< a literal 0, which has every unit
    std::size_t begin = 0;                     ///< of its formula in the source
    std::map<std::size_t, expression> rates{}; ///< the factors, by the state; none elsewhere
    bool rates_alone = false;                  ///< the value is 0
};

/// An operation that is linear in its operand, of the value and of each factor.
template <class F>
[[nodiscard]] formula_value each_part(formula_value x, F const& f) {
    if (!x.rates_alone) x.value = f(x.value);
    for (auto& [state, factor] : x.rates) factor = f(factor);
    return x;
}

/// a + b, or a - b, in the unit of a.
[[nodiscard]] inline formula_value sum_of(formula_value a, formula_value const& b, bool minus) {
    if (!b.rates_alone)
        a.value = a.rates_alone ? minus ? -b.value : b.value
                  : minus       ? a.value - b.value
                                : a.value + b.value;
    a.rates_alone = a.rates_alone && b.rates_alone;
    for (auto const& [state, factor] : b.rates) {
        auto const [at, fresh] = a.rates.try_emplace(state, minus ? -factor : factor);
        if (!fresh) at->second = minus ? at->second - factor : at->second + factor;
    }
    return a;
}

/// "N m", or in words that there is none.
[[nodiscard]] inline std::string unit_words(unit const& u) {
    return u == unit() ? "1 (no unit)" : u.text();
}

/// The factor from one unit to another, tightly enclosed.
[[nodiscard]] inline std::optional<expression> factor_of(unit::ratio const& ratio) {
    auto const c = unit_conversion::of(ratio);
    auto const factor = c ? enclose(c->factor_lower, c->factor_upper) : std::nullopt;
    if (!factor) return std::nullopt;
    return expression(*factor) / expression(static_cast<double>(c->divisor));
}

/// Evaluates formulas: values with the operations of a model's functor, and units beside them.
///   Sums, least and greatest ones, and comparisons need one dimension; what has another size of it
/// is converted to the unit on the left. Functions need a number without a unit, or an angle, which
/// they take in rad.
class formula_evaluator {
public:
    /// What a name, a rate or a channel is; throws where it is unknown.
    using lookup = std::function<formula_value(formula::node const&)>;
    /// Told of what has a domain: sqrt, log, and a divisor, with the argument.
    using partial = std::function<void(operation, expression const&, std::size_t position)>;

    formula_evaluator(model_source const& source, lookup names, partial tell = {})
        : source_(&source), names_(std::move(names)), tell_(std::move(tell)) {}

    [[nodiscard]] formula_value operator()(formula const& f) const {
        std::vector<formula_value> values;
        values.reserve(f.nodes.size());
        for (auto const& n : f.nodes) {
            try {
                values.push_back(value_of(n, values));
            } catch (std::domain_error const&) {
                source_->fail(n.position, "this is no finite number",
                              "mind the domain of the function, and the size of the numbers");
            }
            values.back().begin = n.begin;
        }
        return std::move(values.back());
    }
    /// The value in a unit.
    /// @param what  is to have it, for messages: "w'"
    [[nodiscard]] formula_value fitted(formula_value const& x, unit const& to,
                                       std::string const& what) const {
        if (x.fits_all) return x;
        if (auto const converted = in_unit(x, to)) return *converted;
        source_->fail(x.begin,
                      "this has the unit " + unit_words(x.in) + ", and " + what + " has " +
                          unit_words(to),
                      "correct the formula, or the unit of a name in it; a number has a unit as in "
                      "9.81 [m/s^2]");
    }

private:
    using kind = formula::kind;

    [[nodiscard]] static std::optional<formula_value> in_unit(formula_value const& x,
                                                              unit const& to) {
        auto const ratio = x.in.in(to);
        if (!ratio) return std::nullopt;
        if (ratio->is_one()) return x;
        auto const factor = factor_of(*ratio);
        if (!factor) return std::nullopt;
        return each_part(x, [&](expression const& e) { return e * *factor; });
    }
    /// b in the unit of a; nothing else has both.
    [[nodiscard]] formula_value beside(formula_value const& a, formula_value const& b,
                                       std::size_t position) const {
        if (a.fits_all || b.fits_all) return b;
        if (auto const converted = in_unit(b, a.in)) return *converted;
        source_->fail(position,
                      "the unit on the left is " + unit_words(a.in) + ", that on the right " +
                          unit_words(b.in),
                      "both need one dimension; a number has a unit as in 9.81 [m/s^2]");
    }
    [[nodiscard]] expression plain(formula_value const& x, std::string const& function) const {
        return fitted(x, unit(), "what stands in " + function).value;
    }
    [[nodiscard]] expression angle(formula_value const& x, std::string const& function) const {
        return fitted(x, unit("rad"), "what stands in " + function).value;
    }
    [[nodiscard]] unit made(std::optional<unit> const& u, std::size_t position) const {
        if (u) return *u;
        source_->fail(position, "a unit gets too high a power, or one that is no twelfth",
                      "write the formula in other parts");
    }

    /// Only sums, differences, and products and quotients with one factor are linear in rates.
    void require_linear(formula::node const& n, std::vector<formula_value> const& all) const {
        auto const has = [&](std::size_t k) { return !all[n.of[k]].rates.empty(); };
        bool const linear =
            n.what == formula::kind::choice ? !has(0) && !has(1)
            : n.op == operation::add || n.op == operation::sub || n.op == operation::neg ? true
            : n.op == operation::mul ? !has(0) || !has(1)
            : n.op == operation::div ? !has(1)
                                     : std::none_of(n.of.begin(), n.of.end(), [&](std::size_t k) {
                                           return !all[k].rates.empty();
                                       });
        if (!linear)
            source_->fail(n.position, "the rates do not stand linearly in these equations",
                          "equations are solved for rates that are added up, each times what has "
                          "no rate in it; solve others by hand, or add a state a with a' = (w' - "
                          "a)/tau and write a for w' here");
    }

    [[nodiscard]] formula_value value_of(formula::node const& n,
                                         std::vector<formula_value> const& all) const {
        require_linear(n, all);
        switch (n.what) {
        case kind::number:
            return {n.is_zero ? expression(0) : n.value, n.in, n.is_zero};
        case kind::name:
        case kind::rate:
        case kind::shown:
            return names_(n);
        case kind::power:
            return raised(n, all[n.of[0]]);
        case kind::choice: {
            auto const &a = all[n.of[0]], &x = all[n.of[2]];
            auto const other = beside(x, all[n.of[3]], n.position);
            auto const& unit_of = x.fits_all ? all[n.of[3]] : x;
            auto const half = (1 + sign(a.value - beside(a, all[n.of[1]], n.position).value)) / 2;
            auto const above = each_part(x, [&](expression const& e) { return e * half; });
            auto const below =
                each_part(other, [&](expression const& e) { return e * (1 - half); });
            auto result = sum_of(above, below, false);
            result.in = unit_of.in;
            result.fits_all = x.fits_all && unit_of.fits_all;
            return result;
        }
        case kind::function:
            break;
        }
        return n.of.size() == 1 ? function(n, all[n.of[0]])
                                : function(n, all[n.of[0]], all[n.of[1]]);
    }
    [[nodiscard]] formula_value raised(formula::node const& n, formula_value const& x) const {
        if (n.exponent < 0 && tell_) tell_(operation::div, x.value, n.begin);
        return {pown(x.value, n.exponent), made(x.in.power(n.exponent), n.position),
                x.fits_all && n.exponent > 0};
    }
    [[nodiscard]] formula_value function(formula::node const& n, formula_value const& x) const {
        auto const name = std::string(sivid::name(n.op));
        switch (n.op) {
        case operation::neg:
            return each_part(x, [](expression const& e) { return -e; });
        case operation::abs:
            return {abs(x.value), x.in, x.fits_all};
        case operation::sign:
            return {sign(x.value)};
        case operation::sqr:
            return {sqr(x.value), made(x.in.power(2), n.position), x.fits_all};
        case operation::sqrt:
            if (tell_) tell_(n.op, x.value, n.position);
            return {sqrt(x.value), made(x.in.power(1, 2), n.position), x.fits_all};
        case operation::exp:
            return {exp(plain(x, name))};
        case operation::log: {
            auto const of = plain(x, name);
            if (tell_) tell_(n.op, of, n.position);
            return {log(of)};
        }
        case operation::sin:
            return {sin(angle(x, name))};
        case operation::cos:
            return {cos(angle(x, name))};
        case operation::tan:
            return {tan(angle(x, name))};
        case operation::atan:
            return {atan(plain(x, name)), unit("rad")};
        default:
            return {tanh(plain(x, name))};
        }
    }
    [[nodiscard]] formula_value function(formula::node const& n, formula_value const& a,
                                         formula_value const& b) const {
        if (n.op == operation::mul || n.op == operation::div) {
            bool const divides = n.op == operation::div, left = b.rates.empty();
            if (divides && tell_) tell_(n.op, b.value, b.begin);
            auto result = each_part(left ? a : b, [&](expression const& e) {
                return divides ? e / b.value : left ? e * b.value : a.value * e;
            });
            result.in = made(a.in.times(b.in, divides ? -1 : 1).power(1), n.position);
            result.fits_all = a.fits_all || (!divides && b.fits_all);
            return result;
        }
        auto const other = beside(a, b, n.position);
        formula_value result = a;
        if (n.op == operation::add || n.op == operation::sub)
            result = sum_of(a, other, n.op == operation::sub);
        else
            result.value =
                n.op == operation::min ? min(a.value, other.value) : max(a.value, other.value);
        result.in = a.fits_all ? b.in : a.in;
        result.fits_all = a.fits_all && b.fits_all;
        return result;
    }

    model_source const* source_;
    lookup names_;
    partial tell_;
};

} // namespace sivid::text_detail

#endif
