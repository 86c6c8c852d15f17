// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_HPP
#define SIVID_MODEL_GRAPH_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/arithmetic.hpp>
#include <sivid/model/operation.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace sivid {

using node_id = std::uint32_t;

/// One operation of a recorded model. Operands stand before their users in the graph.
struct node {
    operation op = operation::literal;
    node_id a = 0;         ///< first operand
    node_id b = 0;         ///< second operand
    node_id companion = 0; ///< the node whose series the recurrence needs besides (see operation)
    std::int32_t index = 0;
};

/// What the value of a node may vary with.
enum dependence : std::uint8_t {
    on_nothing = 0,
    on_time = 1,
    on_state = 2,
    on_constant = 4,
    on_input = 8
};

/// An expression graph in topological order. It is built by its own member functions only, which
/// fold constants, share equal subexpressions, and rewrite a*a to sqr(a), so that interval
/// evaluation stays tight. Rewriting never enlarges the domain: 0*x becomes 0 only where x is
/// total.
class graph {
public:
    graph();
    graph(graph const&);
    graph(graph&&) noexcept;
    graph& operator=(graph const&);
    graph& operator=(graph&&) noexcept;
    ~graph();

    [[nodiscard]] std::vector<node> const& nodes() const { return nodes_; }
    [[nodiscard]] node const& operator[](node_id i) const { return nodes_[i]; }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] literal const& value(node const& n) const {
        return literals_[static_cast<std::size_t>(n.index)];
    }
    /// Union of `dependence` flags.
    [[nodiscard]] std::uint8_t depends(node_id i) const { return depends_[i]; }
    /// Whether the node and everything below it is defined everywhere.
    [[nodiscard]] bool total(node_id i) const { return total_[i]; }
    [[nodiscard]] bool is_literal(node_id i) const { return nodes_[i].op == operation::literal; }
    /// Whether the node is the exact literal `v`.
    [[nodiscard]] bool is(node_id i, double v) const {
        return is_literal(i) && value(nodes_[i]).enclosure.lower() == v &&
               value(nodes_[i]).enclosure.upper() == v;
    }

    /// A literal. Only points are shared: two uncertain constants with the same bounds are still
    /// two.
    /// @throws std::domain_error for NaN, infinite or empty values
    node_id constant(literal const& l);
    node_id constant(double v) { return constant(literal{interval(v), v}); }

    /// A leaf: time, state, constant or input with its index.
    node_id leaf(operation op, std::size_t index);

    node_id unary(operation op, node_id a);
    node_id binary(operation op, node_id a, node_id b);
    node_id pown(node_id a, int n);

    node_id neg(node_id a) { return unary(operation::neg, a); }
    node_id add(node_id a, node_id b) { return binary(operation::add, a, b); }
    node_id sub(node_id a, node_id b) { return binary(operation::sub, a, b); }
    node_id mul(node_id a, node_id b) { return binary(operation::mul, a, b); }
    node_id div(node_id a, node_id b) { return binary(operation::div, a, b); }

private:
    using node_key = std::tuple<operation, node_id, node_id, std::int32_t>;

    node_id push(node const& n, std::uint8_t depends);
    node_id shared(node const& n, std::uint8_t depends);
    node_id shared(operation op, node_id a, node_id b, std::int32_t index = 0);
    /// The literal op(a, b) when both are literals and the function is defined there.
    bool fold(operation op, node_id a, node_id b, int n, node_id& result);
    bool simplify(operation op, node_id& a, node_id& b, node_id& result);

    std::vector<node> nodes_;
    std::vector<literal> literals_;
    std::vector<std::uint8_t> depends_;
    std::vector<bool> total_;
    std::map<node_key, node_id> ids_;
    std::map<std::tuple<double, double>, node_id> literal_ids_;
};

namespace model_detail {

/// The rest of `apply`, apart: it would make loops over operations large and slow.
template <class A>
[[gnu::noinline]] typename A::value_type
apply_function(operation op, typename A::value_type const& a, typename A::value_type const& b,
               int n, typename A::mask& undefined) {
    switch (op) {
    case operation::pown:
        return A::pown(a, n, undefined);
    case operation::sqrt:
        return A::sqrt(a, undefined);
    case operation::exp:
        return A::exp(a);
    case operation::log:
        return A::log(a, undefined);
    case operation::sin:
        return A::sin(a);
    case operation::cos:
        return A::cos(a);
    case operation::tan:
        return A::tan(a, undefined);
    case operation::atan:
        return A::atan(a);
    case operation::tanh:
        return A::tanh(a);
    case operation::abs:
        return A::abs(a);
    case operation::sign:
        return A::sign(a);
    case operation::min:
        return A::min(a, b);
    case operation::max:
        return A::max(a, b);
    default:
        return a;
    }
}

} // namespace model_detail

/// Value of one operation on arithmetic A (see `program.hpp`); leaves are not handled.
template <class A>
typename A::value_type apply(operation op, typename A::value_type const& a,
                             typename A::value_type const& b, int n, typename A::mask& undefined) {
    switch (op) {
    case operation::neg:
        return A::neg(a);
    case operation::add:
        return A::add(a, b);
    case operation::sub:
        return A::sub(a, b);
    case operation::mul:
        return A::mul(a, b);
    case operation::div:
        return A::div(a, b, undefined);
    case operation::sqr:
        return A::sqr(a);
    default:
        return model_detail::apply_function<A>(op, a, b, n, undefined);
    }
}

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_GRAPH)
SIVID_ENTRY graph::graph() = default;
SIVID_ENTRY graph::graph(graph const&) = default;
SIVID_ENTRY graph::graph(graph&&) noexcept = default;
SIVID_ENTRY graph& graph::operator=(graph const&) = default;
SIVID_ENTRY graph& graph::operator=(graph&&) noexcept = default;
SIVID_ENTRY graph::~graph() = default;

SIVID_ENTRY node_id graph::constant(literal const& l) {
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

SIVID_ENTRY node_id graph::leaf(operation op, std::size_t index) {
    node n;
    n.op = op;
    n.index = static_cast<std::int32_t>(index);
    std::uint8_t const flags = op == operation::time       ? on_time
                               : op == operation::state    ? on_state
                               : op == operation::constant ? on_constant
                                                           : on_input;
    return shared(n, flags);
}

SIVID_ENTRY node_id graph::push(node const& n, std::uint8_t depends) {
    nodes_.push_back(n);
    depends_.push_back(depends);
    bool total = is_total(n.op);
    if (!is_leaf(n.op)) total = total && total_[n.a];
    if (is_binary(n.op)) total = total && total_[n.b];
    total_.push_back(total);
    return static_cast<node_id>(nodes_.size() - 1);
}

SIVID_ENTRY node_id graph::shared(node const& n, std::uint8_t depends) {
    node_key const key{n.op, n.a, n.b, n.index};
    if (auto const found = ids_.find(key); found != ids_.end()) return found->second;
    return ids_[key] = push(n, depends);
}

SIVID_ENTRY node_id graph::shared(operation op, node_id a, node_id b, std::int32_t index) {
    node n;
    n.op = op;
    n.a = a;
    n.b = b;
    n.index = index;
    auto flags = depends_[a];
    if (is_binary(op)) flags = static_cast<std::uint8_t>(flags | depends_[b]);
    return shared(n, flags);
}

SIVID_ENTRY bool graph::fold(operation op, node_id a, node_id b, int n, node_id& result) {
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

SIVID_ENTRY bool graph::simplify(operation op, node_id& a, node_id& b, node_id& result) {
    switch (op) {
    case operation::add:
        if (is(a, 0)) return result = b, true;
        if (is(b, 0)) return result = a, true;
        if (nodes_[b].op == operation::neg) return result = sub(a, nodes_[b].a), true;
        if (nodes_[a].op == operation::neg) return result = sub(b, nodes_[a].a), true;
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

SIVID_ENTRY node_id graph::binary(operation op, node_id a, node_id b) {
    node_id result = 0;
    if (fold(op, a, b, 0, result) || simplify(op, a, b, result)) return result;
    bool const commutes = op == operation::add || op == operation::mul || op == operation::min ||
                          op == operation::max;
    if (commutes && a > b) std::swap(a, b);
    return shared(op, a, b);
}

SIVID_ENTRY node_id graph::unary(operation op, node_id a) {
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

SIVID_ENTRY node_id graph::pown(node_id a, int n) {
    if (n == 0) return total_[a] ? constant(1.0) : shared(operation::pown, a, a, 0);
    if (n == 1) return a;
    if (n == 2) return unary(operation::sqr, a);
    if (n < 0) return div(constant(1.0), pown(a, -n));
    node_id result = 0;
    if (fold(operation::pown, a, a, n, result)) return result;
    auto const lower = pown(a, n - 1);
    auto const y = shared(operation::pown, a, a, n);
    nodes_[y].companion = lower;
    return y;
}
#endif

} // namespace sivid

#endif
