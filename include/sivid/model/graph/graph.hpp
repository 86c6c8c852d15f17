// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_GRAPH_HPP
#define SIVID_MODEL_GRAPH_GRAPH_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/operation.hpp>
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

/// Larger powers are neither recorded nor multiplied out: sums of powers have to stay far from
/// overflow.
inline constexpr int most_power = 1 << 20;

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
    /// @throws std::invalid_argument  for a power beyond `most_power`
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

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/graph/impl/graph.ipp>
#endif

#endif
