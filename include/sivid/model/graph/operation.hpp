// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_OPERATION_HPP
#define SIVID_MODEL_GRAPH_OPERATION_HPP

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sivid {

/// What a node of a recorded model does. Leaves first.
enum class operation : std::uint8_t {
    literal,  ///< a constant, `index` into the graph's literals
    time,     ///< t
    state,    ///< x[index]
    constant, ///< c[index], a constant of the model; after binding, an unknown parameter
    input,    ///< u[index]
    neg,
    add,
    sub,
    mul,
    div,
    sqr,
    pown, ///< a^n with the integer n >= 3 in `index`; companion: see `is_squared_power`
    sqrt,
    exp,
    log,
    sin,  ///< companion cos
    cos,  ///< companion sin
    tan,  ///< companion 1 + tan^2
    atan, ///< companion 1 + a^2
    tanh, ///< companion 1 - tanh^2
    abs,
    sign, ///< set-valued at 0: [-1, 1]
    min,
    max
};

[[nodiscard]] constexpr bool is_leaf(operation op) { return op <= operation::input; }

[[nodiscard]] constexpr bool is_binary(operation op) {
    return op == operation::add || op == operation::sub || op == operation::mul ||
           op == operation::div || op == operation::min || op == operation::max;
}

/// Defined for every real argument.
[[nodiscard]] constexpr bool is_total(operation op) {
    return op != operation::div && op != operation::sqrt && op != operation::log &&
           op != operation::tan;
}

/// Whether the companion of a^n is a^(n/2), whose square it is, so that a power has about 2 log2 n
/// nodes; else it is a^(n-1). Powers up to the eighth follow from the next lower one: no more nodes
/// than twice as many, and sharper coefficients, since n a^(n-1) a' holds no product of a with
/// itself.
[[nodiscard]] constexpr bool is_squared_power(int n) { return n > 8 && n % 2 == 0; }

/// Has a kink: not differentiable for some argument.
[[nodiscard]] constexpr bool has_kink(operation op) {
    return op == operation::abs || op == operation::sign || op == operation::min ||
           op == operation::max;
}

[[nodiscard]] constexpr std::string_view name(operation op) {
    constexpr std::string_view names[] = {
        "literal", "t",   "x",   "c",   "u",   "neg", "add",  "sub",  "mul", "div",  "sqr", "pown",
        "sqrt",    "exp", "log", "sin", "cos", "tan", "atan", "tanh", "abs", "sign", "min", "max"};
    return names[static_cast<std::size_t>(op)];
}

} // namespace sivid

#endif
