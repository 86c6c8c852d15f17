// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_IMPL_GRAPH_IPP
#define SIVID_MODEL_GRAPH_IMPL_GRAPH_IPP

#include <sivid/model/graph/graph.hpp>

#include <string>

namespace sivid {

SIVID_DECL graph::graph() = default;
SIVID_DECL graph::graph(graph const&) = default;
SIVID_DECL graph::graph(graph&&) noexcept = default;
SIVID_DECL graph& graph::operator=(graph const&) = default;
SIVID_DECL graph& graph::operator=(graph&&) noexcept = default;
SIVID_DECL graph::~graph() = default;

SIVID_DECL node_id graph::constant(literal const& l) {
    if (!std::isfinite(l.nearest) || !std::isfinite(l.enclosure.lower()) ||
        !std::isfinite(l.enclosure.upper()) || is_empty(l.enclosure)) {
        throw std::domain_error("graph: a constant of a model must be finite");
    }
    if (!is_point(l.enclosure)) {
        literals_.push_back(l);
        node n;
        n.index = static_cast<std::int32_t>(literals_.size() - 1);
        return push(n, on_nothing);
    }
    auto const key = std::make_tuple(l.enclosure.lower(), l.enclosure.upper());
    if (auto const found = literal_ids_.find(key); found != literal_ids_.end()) {
        return found->second;
    }
    literals_.push_back(l);
    node n;
    n.index = static_cast<std::int32_t>(literals_.size() - 1);
    return literal_ids_[key] = push(n, on_nothing);
}

SIVID_DECL node_id graph::leaf(operation op, std::size_t index) {
    node n;
    n.op = op;
    n.index = static_cast<std::int32_t>(index);
    std::uint8_t const flags = op == operation::time       ? on_time
                               : op == operation::state    ? on_state
                               : op == operation::constant ? on_constant
                                                           : on_input;
    return shared(n, flags);
}

SIVID_DECL node_id graph::push(node const& n, std::uint8_t depends) {
    nodes_.push_back(n);
    depends_.push_back(depends);
    bool total = is_total(n.op);
    if (!is_leaf(n.op)) total = total && total_[n.a];
    if (is_binary(n.op)) total = total && total_[n.b];
    total_.push_back(total);
    return static_cast<node_id>(nodes_.size() - 1);
}

SIVID_DECL node_id graph::shared(node const& n, std::uint8_t depends) {
    node_key const key{n.op, n.a, n.b, n.index};
    if (auto const found = ids_.find(key); found != ids_.end()) return found->second;
    return ids_[key] = push(n, depends);
}

SIVID_DECL node_id graph::shared(operation op, node_id a, node_id b, std::int32_t index) {
    node n;
    n.op = op;
    n.a = a;
    n.b = b;
    n.index = index;
    auto flags = depends_[a];
    if (is_binary(op)) flags = static_cast<std::uint8_t>(flags | depends_[b]);
    return shared(n, flags);
}

SIVID_DECL bool graph::fold(operation op, node_id a, node_id b, int n, node_id& result) {
    if (!is_literal(a) || (is_binary(op) && !is_literal(b))) return false;
    auto const x = value(nodes_[a]);
    auto const y = value(nodes_[b]);
    bool undefined = false;
    auto const enclosure =
        apply<proven_arithmetic<interval>>(op, x.enclosure, y.enclosure, n, undefined);
    bool ignored = false;
    double const nearest = apply<approximate_arithmetic>(op, x.nearest, y.nearest, n, ignored);
    if (undefined || !std::isfinite(nearest) || !std::isfinite(enclosure.lower()) ||
        !std::isfinite(enclosure.upper())) {
        return false;
    }
    result = constant(literal{enclosure, nearest});
    return true;
}

SIVID_DECL bool graph::simplify(operation op, node_id& a, node_id& b, node_id& result) {
    switch (op) {
    case operation::add:
        if (is(a, 0)) return result = b, true;
        if (is(b, 0)) return result = a, true;
        if (nodes_[b].op == operation::neg) return result = sub(a, nodes_[b].a), true;
        if (nodes_[a].op == operation::neg) return result = sub(b, nodes_[a].a), true;
        // max(x, y) + min(x, y) = x + y: a dead band of no width.
        for (auto const& [high, low] : {std::pair{nodes_[a], nodes_[b]}, {nodes_[b], nodes_[a]}}) {
            if (high.op == operation::max && low.op == operation::min && high.a == low.a &&
                high.b == low.b) {
                return result = add(high.a, high.b), true;
            }
        }
        break;
    case operation::sub:
        if (is(b, 0)) return result = a, true;
        if (is(a, 0)) return result = neg(b), true;
        if (a == b && total_[a]) return result = constant(0.0), true;
        if (nodes_[b].op == operation::neg) return result = add(a, nodes_[b].a), true;
        break;
    case operation::mul:
        if (is(a, 1)) return result = b, true;
        if (is(b, 1)) return result = a, true;
        if (is(a, -1)) return result = neg(b), true;
        if (is(b, -1)) return result = neg(a), true;
        if (is(a, 0) && total_[b]) return result = a, true;
        if (is(b, 0) && total_[a]) return result = b, true;
        if (a == b) return result = unary(operation::sqr, a), true;
        if (nodes_[a].op == operation::neg) return result = neg(mul(nodes_[a].a, b)), true;
        if (nodes_[b].op == operation::neg) return result = neg(mul(a, nodes_[b].a)), true;
        break;
    case operation::div:
        if (is(b, 1)) return result = a, true;
        if (is(b, -1)) return result = neg(a), true;
        if (nodes_[a].op == operation::neg) return result = neg(div(nodes_[a].a, b)), true;
        break;
    case operation::min:
    case operation::max:
        if (a == b) return result = a, true;
        break;
    default:
        break;
    }
    return false;
}

SIVID_DECL node_id graph::binary(operation op, node_id a, node_id b) {
    node_id result = 0;
    if (fold(op, a, b, 0, result) || simplify(op, a, b, result)) return result;
    bool const commutes = op == operation::add || op == operation::mul || op == operation::min ||
                          op == operation::max;
    if (commutes && a > b) std::swap(a, b);
    return shared(op, a, b);
}

SIVID_DECL node_id graph::unary(operation op, node_id a) {
    node_id result = 0;
    if (fold(op, a, a, 0, result)) return result;
    auto const inner = nodes_[a].op;
    if (op == operation::neg && inner == operation::neg) return nodes_[a].a;
    if ((op == operation::abs || op == operation::sqr || op == operation::cos) &&
        inner == operation::neg) {
        return unary(op, nodes_[a].a);
    }
    if (op == operation::abs && (inner == operation::abs || inner == operation::sqr ||
                                 inner == operation::exp || inner == operation::sqrt)) {
        return a;
    }
    // Functions whose Taylor recurrence needs a second series get it as a companion node.
    switch (op) {
    case operation::sin:
    case operation::cos: {
        auto const s = shared(operation::sin, a, a);
        auto const c = shared(operation::cos, a, a);
        nodes_[s].companion = c;
        nodes_[c].companion = s;
        return op == operation::sin ? s : c;
    }
    case operation::tan:
    case operation::tanh: {
        auto const y = shared(op, a, a);
        auto const one = constant(1.0);
        auto const square = unary(operation::sqr, y);
        auto const derivative = op == operation::tan ? add(one, square) : sub(one, square);
        nodes_[y].companion = derivative;
        return y;
    }
    case operation::atan: {
        auto const one = constant(1.0);
        auto const denominator = add(one, unary(operation::sqr, a));
        auto const y = shared(op, a, a);
        nodes_[y].companion = denominator;
        return y;
    }
    default:
        return shared(op, a, a);
    }
}

SIVID_DECL node_id graph::pown(node_id a, int n) {
    if (n > most_power || n < -most_power)
        throw std::invalid_argument("a power of " + std::to_string(n) +
                                    ": exponents lie between -2^20 and 2^20; write exp(n*log(x))");
    // The recurrence of a power needs a lower one: 0, 1 and 2 are written without. The product with
    // 0 keeps the domain of a.
    if (n == 0) return total_[a] ? constant(1.0) : add(constant(1.0), mul(constant(0.0), a));
    if (n == 1) return a;
    if (n == 2) return unary(operation::sqr, a);
    if (n < 0) return div(constant(1.0), pown(a, -n));
    node_id result = 0;
    if (fold(operation::pown, a, a, n, result)) return result;
    if (auto const found = ids_.find({operation::pown, a, a, n}); found != ids_.end())
        return found->second;
    auto const lower = pown(a, is_squared_power(n) ? n / 2 : n - 1);
    result = shared(operation::pown, a, a, n);
    nodes_[result].companion = lower;
    return result;
}

} // namespace sivid

#endif
