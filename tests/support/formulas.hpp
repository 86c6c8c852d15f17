// SPDX-License-Identifier: MIT
// Random formulas as plain trees, independent of the library's graph and its rewriting.
#ifndef SIVID_TESTS_SUPPORT_FORMULAS_HPP
#define SIVID_TESTS_SUPPORT_FORMULAS_HPP

#include "support/power_series.hpp"
#include "support/random.hpp"

#include <sivid/model/expression.hpp>
#include <sivid/model/graph/operation.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/series.hpp>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <vector>

namespace support {

/// What formulas are made of: the leaves t, x0, x1, p0, p1 and small literals.
struct formula {
    struct term {
        sivid::operation op;
        std::size_t a = 0, b = 0;
        int index = 0;
        double value = 0;
    };
    std::vector<term> terms; ///< operands first; the last is the result

    [[nodiscard]] bool uses(sivid::operation op) const {
        for (auto const& n : terms) {
            if (n.op == op) return true;
        }
        return false;
    }
};

inline constexpr std::size_t formula_states = 2, formula_parameters = 2;

/// Terms over the operands 0 to 5: t, x0, x1, p0, p1 and 1.5.
inline formula over_leaves(std::vector<formula::term> const& terms) {
    using sivid::operation;
    formula f;
    f.terms = {{operation::time},
               {operation::state, 0, 0, 0},
               {operation::state, 0, 0, 1},
               {operation::constant, 0, 0, 0},
               {operation::constant, 0, 0, 1},
               {operation::literal, 0, 0, 0, 1.5}};
    f.terms.insert(f.terms.end(), terms.begin(), terms.end());
    return f;
}

/// Calls use(formula) for an operation on every pair of leaves, the same leaf twice where it is
/// unary.
/// @param exponents  of pown
template <class Use>
void for_each_use(sivid::operation op, std::initializer_list<int> exponents, Use const& use) {
    constexpr std::size_t leaves[] = {0, 1, 2, 3, 5}; // t, x0, x1, p0, 1.5
    for (auto const a : leaves) {
        for (auto const b : leaves) {
            if (!is_binary(op) && b != a) continue;
            for (int const n : exponents) {
                use(over_leaves({{op, a, b, n}}));
                if (op != sivid::operation::pown) break;
            }
        }
    }
}

/// @param smooth  without abs, sign, min, max
inline formula random_formula(draws& d, std::size_t size, bool smooth) {
    using sivid::operation;
    formula f;
    constexpr double literals[] = {0, 1, -1, 2, 0.5, -3, 0.75};
    f.terms.push_back({operation::time});
    for (int i = 0; i < 2; ++i) f.terms.push_back({operation::state, 0, 0, i});
    for (int i = 0; i < 2; ++i) f.terms.push_back({operation::constant, 0, 0, i});
    f.terms.push_back({operation::literal, 0, 0, 0, literals[d.below(7)]});
    f.terms.push_back({operation::literal, 0, 0, 0, literals[d.below(7)]});
    for (std::size_t k = 0; k < size; ++k) {
        auto const kinds = static_cast<std::size_t>(smooth ? operation::tanh : operation::max) -
                           static_cast<std::size_t>(operation::neg) + 1;
        auto op = static_cast<operation>(static_cast<std::size_t>(operation::neg) + d.below(kinds));
        if (d.below(4) == 0) op = d.coin() ? operation::mul : operation::neg;
        formula::term n{op};
        // Recent terms are likelier, so that trees grow deep; equal operands happen.
        auto const pick = [&] {
            auto const all = f.terms.size();
            return d.coin() ? all - 1 - d.below(std::min<std::size_t>(all, 3)) : d.below(all);
        };
        n.a = pick();
        n.b = d.below(5) == 0 ? n.a : pick();
        n.index = op == operation::pown ? static_cast<int>(d.below(9)) - 3 : 0;
        f.terms.push_back(n);
    }
    return f;
}

/// Values of all terms on a scalar, by its own functions.
/// @param leaf  (operation, index) -> T
/// @param check (term, operand values a, b) called before each operation
template <class T, class Leaf, class Check>
std::vector<T> values(formula const& f, Leaf const& leaf, Check const& check) {
    using namespace real;
    using sivid::operation;
    std::vector<T> v;
    for (auto const& n : f.terms) {
        if (n.op == operation::literal) {
            v.push_back(T(n.value));
            continue;
        }
        if (sivid::is_leaf(n.op)) {
            v.push_back(leaf(n.op, static_cast<std::size_t>(n.index)));
            continue;
        }
        T const a = v[n.a];
        T const b = v[n.b];
        check(n, a, b);
        switch (n.op) {
        case operation::neg:
            v.push_back(-a);
            break;
        case operation::add:
            v.push_back(a + b);
            break;
        case operation::sub:
            v.push_back(a - b);
            break;
        case operation::mul:
            v.push_back(a * b);
            break;
        case operation::div:
            v.push_back(a / b);
            break;
        case operation::sqr:
            v.push_back(sqr(a));
            break;
        case operation::pown:
            v.push_back(pown(a, n.index));
            break;
        case operation::sqrt:
            v.push_back(sqrt(a));
            break;
        case operation::exp:
            v.push_back(exp(a));
            break;
        case operation::log:
            v.push_back(log(a));
            break;
        case operation::sin:
            v.push_back(sin(a));
            break;
        case operation::cos:
            v.push_back(cos(a));
            break;
        case operation::tan:
            v.push_back(tan(a));
            break;
        case operation::atan:
            v.push_back(atan(a));
            break;
        case operation::tanh:
            v.push_back(tanh(a));
            break;
        case operation::abs:
            v.push_back(abs(a));
            break;
        case operation::sign:
            v.push_back(sign(a));
            break;
        case operation::min:
            v.push_back(min(a, b));
            break;
        case operation::max:
            v.push_back(max(a, b));
            break;
        default:
            throw std::logic_error("formula");
        }
    }
    return v;
}
template <class T, class Leaf>
T value(formula const& f, Leaf const& leaf) {
    return values<T>(f, leaf, [](auto const&, auto const&, auto const&) {}).back();
}

/// Thrown by the oracle where a formula is not defined, or too large to be worth comparing.
struct not_defined {};
struct too_large {};

/// Whether an operation is defined at its operands; smooth ones are also asked to be
/// differentiable.
inline void require_defined(formula::term const& n, mp const& a, mp const& b, bool derivatives) {
    using sivid::operation;
    if (!(abs(a) < 1e30) || !(abs(b) < 1e30)) throw too_large{};
    bool const bad = (n.op == operation::div && b == 0) || (n.op == operation::sqrt && a < 0) ||
                     (n.op == operation::log && a <= 0) ||
                     (n.op == operation::pown && n.index < 0 && a == 0);
    if (bad) throw not_defined{};
    if (n.op == operation::exp && a > 60) throw too_large{};
    if (derivatives && n.op == operation::sqrt && a == 0) throw not_defined{};
}

/// Whether a series can be continued through an operation: defined, smooth and on no kink.
template <class Series>
void require_smooth(formula::term const& n, Series const& a, Series const& b) {
    require_defined(n, a.c[0], b.c[0], true);
    if (!has_kink(n.op)) return;
    mp const side = is_binary(n.op) ? mp(a.c[0] - b.c[0]) : a.c[0];
    if (side == 0) throw not_defined{};
}

/// A point at which a formula is evaluated.
struct place {
    double t = 0;
    std::vector<double> x{0, 0}, p{0, 0};
};
struct place_box {
    sivid::interval t;
    sivid::box x = sivid::box(formula_states), p = sivid::box(formula_parameters);
};

inline place_box random_places(draws& d, double radius) {
    place_box b;
    b.t = d.interval(0, 2, radius);
    for (std::size_t i = 0; i < 2; ++i) {
        b.x[i] = d.interval(-2, 2, radius);
        b.p[i] = d.interval(-2, 2, radius);
    }
    return b;
}
inline place random_place(draws& d, place_box const& b) {
    return {d.in(b.t), d.in(b.x), d.in(b.p)};
}

/// @throws not_defined, too_large
inline mp exact_value(formula const& f, place const& at) {
    using sivid::operation;
    return values<mp>(
               f,
               [&](operation op, std::size_t i) -> mp {
                   return op == operation::time ? at.t : op == operation::state ? at.x[i] : at.p[i];
               },
               [](formula::term const& n, mp const& a, mp const& b) {
                   require_defined(n, a, b, false);
               })
        .back();
}

/// The formula recorded in a graph.
inline sivid::node_id recorded(formula const& f, sivid::graph& g) {
    using sivid::expression;
    return value<expression>(
               f, [&g](sivid::operation op, std::size_t i) { return expression(g, g.leaf(op, i)); })
        .in(g);
}
/// Nothing where a literal's operation is not defined.
inline std::optional<sivid::node_id> recorded_if_defined(formula const& f, sivid::graph& g) {
    try {
        return recorded(f, g);
    } catch (std::domain_error const&) {
        return std::nullopt;
    }
}

/// What a tape says of its outputs over a box.
struct evaluation {
    std::vector<sivid::interval> outputs;
    bool undefined = false;
};
inline evaluation evaluate(sivid::graph const& g, std::vector<sivid::node_id> const& outputs,
                           place_box const& b) {
    sivid::tape const program(g, outputs);
    sivid::series<sivid::interval> s(program, 0);
    s.set_parameters(b.p);
    s.start(b.t);
    auto const state = [&b](std::size_t i, std::size_t) { return b.x[i]; };
    s.advance(0, state, state);
    evaluation e;
    for (std::size_t o = 0; o < outputs.size(); ++o) e.outputs.push_back(s.output(o, 0));
    e.undefined = s.undefined();
    return e;
}

} // namespace support

#endif
