// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_EXPRESSION_HPP
#define SIVID_MODEL_EXPRESSION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/number/decimal.hpp>

#include <stdexcept>

namespace sivid {

/// The scalar on which a model is run once, to record its graph. A double, an integer or a decimal
/// literal converts to its exact value; `0.1` means the double next to one tenth, `0.1_dec` one
/// tenth. There is no comparison and no conversion to bool: a model that branches on a value does
/// not compile; `abs`, `min`, `max`, `saturate`, `deadband` express what such branches mean.
class expression {
public:
    expression() : expression(0.0) {}
    expression(double exact);
    expression(int exact) : expression(static_cast<double>(exact)) {}
    expression(decimal exact);
    expression(interval const& enclosure);
    /// A node of a graph under construction, which must outlive the expression.
    expression(graph& owner, node_id id) : owner_(&owner), id_(id) {}

    /// The node in `g`; a literal is entered on first use.
    [[nodiscard]] node_id in(graph& g) const;

    friend expression operator+(expression const& a) { return a; }
    friend expression operator-(expression const& a) { return unary(operation::neg, a); }
    friend expression operator+(expression const& a, expression const& b) {
        return binary(operation::add, a, b);
    }
    friend expression operator-(expression const& a, expression const& b) {
        return binary(operation::sub, a, b);
    }
    friend expression operator*(expression const& a, expression const& b) {
        return binary(operation::mul, a, b);
    }
    friend expression operator/(expression const& a, expression const& b) {
        return binary(operation::div, a, b);
    }
    expression& operator+=(expression const& b) { return *this = *this + b; }
    expression& operator-=(expression const& b) { return *this = *this - b; }
    expression& operator*=(expression const& b) { return *this = *this * b; }
    expression& operator/=(expression const& b) { return *this = *this / b; }

    friend bool operator<(expression const&, expression const&) = delete;
    friend bool operator>(expression const&, expression const&) = delete;
    friend bool operator<=(expression const&, expression const&) = delete;
    friend bool operator>=(expression const&, expression const&) = delete;
    friend bool operator==(expression const&, expression const&) = delete;

    friend expression sqr(expression const& a) { return unary(operation::sqr, a); }
    friend expression sqrt(expression const& a) { return unary(operation::sqrt, a); }
    friend expression exp(expression const& a) { return unary(operation::exp, a); }
    friend expression log(expression const& a) { return unary(operation::log, a); }
    friend expression sin(expression const& a) { return unary(operation::sin, a); }
    friend expression cos(expression const& a) { return unary(operation::cos, a); }
    friend expression tan(expression const& a) { return unary(operation::tan, a); }
    friend expression atan(expression const& a) { return unary(operation::atan, a); }
    friend expression tanh(expression const& a) { return unary(operation::tanh, a); }
    friend expression abs(expression const& a) { return unary(operation::abs, a); }
    friend expression sign(expression const& a) { return unary(operation::sign, a); }
    friend expression min(expression const& a, expression const& b) {
        return binary(operation::min, a, b);
    }
    friend expression max(expression const& a, expression const& b) {
        return binary(operation::max, a, b);
    }
    /// \f$ a^n \f$ for an integer n.
    friend expression pown(expression const& a, int n) { return power(a, n); }
    /// `a` clamped to [lo, hi].
    friend expression saturate(expression const& a, expression const& lo, expression const& hi) {
        return min(max(a, lo), hi);
    }
    /// 0 within `half_width` of 0, shifted towards 0 by it outside.
    friend expression deadband(expression const& a, expression const& half_width) {
        // Not a - saturate(a, ...), which is a kink wherever the width is 0.
        return max(a - half_width, 0) + min(a + half_width, 0);
    }

private:
    static expression wrap(graph& g, bool owned, node_id id);
    static expression unary(operation op, expression const& a);
    static expression binary(operation op, expression const& a, expression const& b);
    static expression power(expression const& a, int n);
    static expression finish(graph& g, bool owned, node_id id);

    graph* owner_ = nullptr;
    node_id id_ = 0;
    literal literal_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/expression.ipp>
#endif

#endif
