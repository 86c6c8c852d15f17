// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_EXPRESSION_IPP
#define SIVID_MODEL_IMPL_EXPRESSION_IPP

#include <sivid/model/expression.hpp>

namespace sivid {

SIVID_DECL expression::expression(double exact) : literal_{interval(exact), exact} {}
SIVID_DECL expression::expression(decimal exact) : literal_{enclose(exact), nearest(exact)} {}
SIVID_DECL expression::expression(interval const& enclosure)
    : literal_{enclosure, mid(enclosure)} {}

SIVID_DECL node_id expression::in(graph& g) const {
    if (owner_ == nullptr) return g.constant(literal_);
    if (owner_ != &g) throw std::logic_error("expression: belongs to another recording");
    return id_;
}

SIVID_DECL expression expression::wrap(graph& g, bool owned, node_id id) {
    if (owned) return expression(g, id);
    expression result;
    result.literal_ = g.value(g[id]);
    return result;
}

SIVID_DECL expression expression::unary(operation op, expression const& a) {
    graph scratch;
    graph& g = a.owner_ != nullptr ? *a.owner_ : scratch;
    return finish(g, a.owner_ != nullptr, g.unary(op, a.in(g)));
}

SIVID_DECL expression expression::binary(operation op, expression const& a, expression const& b) {
    graph scratch;
    graph* const owner = a.owner_ != nullptr ? a.owner_ : b.owner_;
    graph& g = owner != nullptr ? *owner : scratch;
    // In the order of writing, so that a recording is independent of the compiler.
    auto const left = a.in(g);
    auto const right = b.in(g);
    return finish(g, owner != nullptr, g.binary(op, left, right));
}

SIVID_DECL expression expression::power(expression const& a, int n) {
    graph* const g = a.owner_;
    graph scratch;
    graph& target = g != nullptr ? *g : scratch;
    return finish(target, g != nullptr, target.pown(a.in(target), n));
}

SIVID_DECL expression expression::finish(graph& g, bool owned, node_id id) {
    if (!owned && !g.is_literal(id)) {
        throw std::domain_error("expression: a constant of the model is not defined (such as "
                                "the square root of a negative number)");
    }
    return wrap(g, owned, id);
}

} // namespace sivid

#endif
