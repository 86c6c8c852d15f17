// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_PLAIN_PROGRAM_HPP
#define SIVID_MODEL_PLAIN_PROGRAM_HPP

#include <sivid/model/graph.hpp>
#include <sivid/model/rewrite.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Where a plain program finds its arguments: t, then the states, the inputs, the constants.
struct program_shape {
    std::size_t states = 0, inputs = 0, constants = 0;

    [[nodiscard]] std::size_t state() const { return 1; }
    [[nodiscard]] std::size_t input() const { return 1 + states; }
    [[nodiscard]] std::size_t constant() const { return 1 + states + inputs; }
    [[nodiscard]] std::size_t size() const { return 1 + states + inputs + constants; }
};

/// Some outputs of a graph as a straight-line program in plain doubles: fast, and not a proof.
///   The memory belongs to the caller: `memory()` once, then write constants and `prepare`, then
///   write t, states and inputs and `run` as often as wanted; read `memory[output(k)]`.
/// @cost  about a nanosecond an operation
class plain_program {
public:
    plain_program() = default;
    plain_program(graph const& g, std::vector<node_id> const& outputs, program_shape shape)
        : shape_(shape) {
        auto const needed = operands_of(g, outputs);
        std::vector<std::size_t> slot(g.size(), 0);
        initial_.assign(shape.size(), 0.0);
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (!needed[k]) continue;
            auto const i = static_cast<node_id>(k);
            auto const& n = g[i];
            auto const index = static_cast<std::size_t>(n.index);
            switch (n.op) {
            case operation::literal:
                slot[k] = initial_.size();
                initial_.push_back(g.value(n).nearest);
                break;
            case operation::time:
                slot[k] = 0;
                break;
            case operation::state:
                slot[k] = shape.state() + index;
                break;
            case operation::input:
                slot[k] = shape.input() + index;
                break;
            case operation::constant:
                slot[k] = shape.constant() + index;
                break;
            default: {
                slot[k] = initial_.size();
                initial_.push_back(0.0);
                bool const varies = (g.depends(i) & ~(on_constant | on_nothing)) != 0;
                auto const b = is_binary(n.op) ? slot[n.b] : slot[n.a];
                (varies ? varying_ : fixed_)
                    .push_back({n.op, n.index, static_cast<std::uint32_t>(slot[k]),
                                static_cast<std::uint32_t>(slot[n.a]),
                                static_cast<std::uint32_t>(b)});
            }
            }
        }
        for (auto const i : outputs) outputs_.push_back(slot[i]);
    }

    [[nodiscard]] program_shape const& shape() const { return shape_; }
    [[nodiscard]] std::vector<double> memory() const { return initial_; }
    [[nodiscard]] std::size_t output_count() const { return outputs_.size(); }
    /// Slot of an output.
    [[nodiscard]] std::size_t output(std::size_t k) const { return outputs_[k]; }
    /// After the constants have been written.
    void prepare(std::vector<double>& memory) const { execute(fixed_, memory.data()); }
    /// After t, states and inputs have been written.
    void run(std::vector<double>& memory) const { execute(varying_, memory.data()); }

private:
    struct step {
        operation op;
        std::int32_t index;
        std::uint32_t target, a, b;
    };

    static double power(double a, int n) {
        double result = a;
        for (int k = 1; k < n; ++k) result *= a;
        return n == 0 ? 1 : result;
    }
    static void execute(std::vector<step> const& steps, double* m) {
        for (auto const& s : steps) {
            double const a = m[s.a];
            double const b = m[s.b];
            double r = 0;
            switch (s.op) {
            case operation::neg:
                r = -a;
                break;
            case operation::add:
                r = a + b;
                break;
            case operation::sub:
                r = a - b;
                break;
            case operation::mul:
                r = a * b;
                break;
            case operation::div:
                r = a / b;
                break;
            case operation::sqr:
                r = a * a;
                break;
            case operation::pown:
                r = power(a, s.index);
                break;
            default:
                r = elementary(s.op, a, b);
            }
            m[s.target] = r;
        }
    }
    static double elementary(operation op, double a, double b) {
        using A = approximate_arithmetic;
        switch (op) {
        case operation::sqrt:
            return std::sqrt(a);
        case operation::exp:
            return std::exp(a);
        case operation::log:
            return std::log(a);
        case operation::sin:
            return std::sin(a);
        case operation::cos:
            return std::cos(a);
        case operation::tan:
            return std::tan(a);
        case operation::atan:
            return std::atan(a);
        case operation::tanh:
            return std::tanh(a);
        case operation::abs:
            return std::abs(a);
        case operation::sign:
            return A::sign(a);
        case operation::min:
            return std::min(a, b);
        case operation::max:
            return std::max(a, b);
        default:
            return a;
        }
    }

    program_shape shape_;
    std::vector<double> initial_;
    std::vector<step> fixed_, varying_;
    std::vector<std::size_t> outputs_;
};

} // namespace sivid

#endif
