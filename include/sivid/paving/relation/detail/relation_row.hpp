// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_RELATION_ROW_HPP
#define SIVID_PAVING_RELATION_DETAIL_RELATION_ROW_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/paving/relation/detail/separation.hpp>
#include <sivid/paving/relation/linear_refutation.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

/// One state equation with its unknown coefficients,
/// \f$ x_i' = \sum_j \theta_j \phi_j + \phi_0 \f$, \f$ \theta_j = anchor_j + width_j z_j \f$ with
/// \f$ z_j \in [0, 1] \f$.
struct relation_row {
    std::size_t equation = 0;
    std::vector<parameter_product> theta;
    std::vector<interval> range; ///< of each coefficient over the prior, certified
    std::vector<double> anchor, width;
    std::vector<node_id> functions; ///< \f$ \phi_j \f$; last \f$ \phi_0 \f$
    /// If not empty, the last function is \f$ \phi_0 + \sum_j \bar\theta_j \phi_j + a x_i \f$
    /// with these \f$ \bar\theta_j \f$ (see `combine`).
    std::vector<double> centre;
    double growth = 0;                 ///< a [1/time]
    std::set<std::size_t> states;      ///< that the functions contain
    std::set<std::size_t> inseparable; ///< parameters that stay in the functions
    bool bounded = true;               ///< all ranges are
    bool uses_inputs = false;
    bool kinematic = false; ///< a function of states only
    /// What further unknown coefficients, after those of the functions, stand before: a factor
    /// times what a state's sensor changes by over the window, or (no state) the window's length.
    struct difference {
        std::optional<std::size_t> state;
        interval factor{1.0};
    };
    std::vector<difference> differences;
    /// Inequalities between coefficients, from quotients of which the prior knows more than of the
    /// coefficients one by one: (row in z, bound).
    std::vector<std::pair<std::vector<double>, double>> ratios;
};

/// The window's equation \f$ d = a_0 + \sum_j \theta_j a_j \f$ between enclosed numbers, which the
/// relation implies.
struct window_row {
    std::size_t motion = 0; ///< of which experiment
    double from = 0, to = 0;
    interval difference;     ///< d
    std::vector<interval> a; ///< of functions, then of differences, last \f$ a_0 \f$
    interval length;         ///< what a constant missing rate would be multiplied with [time]
};

namespace paving_detail {

/// \f$ \theta_j \le \rho \theta_k \f$ and \f$ \theta_j \ge \rho \theta_k \f$ where factors of the
/// quotient cancel and \f$ \theta_k > 0 \f$. Coefficients downward, the bound upward: z >= 0.
inline void add_ratios(relation_row& row, graph_range const& atoms) {
    using traits = interval_traits<interval>;
    for (std::size_t j = 0; j < row.theta.size(); ++j) {
        for (std::size_t k = 0; k < row.theta.size(); ++k) {
            if (j == k || !(row.range[k].lower() > 0)) continue;
            auto const ratio = range_of(quotient(row.theta[j], row.theta[k]), atoms);
            bool undefined = false;
            auto const plain = traits::div(row.range[j], row.range[k], undefined);
            for (bool const above : {true, false}) {
                double const rho = above ? ratio.upper() : ratio.lower();
                double const known = above ? plain.upper() : plain.lower();
                if (!std::isfinite(rho) || std::abs(rho - known) < 1e-6 * mag(plain)) continue;
                auto const sign = traits::point(above ? 1.0 : -1.0);
                auto const against = traits::mul(traits::neg(sign), traits::point(rho));
                std::vector<double> entries(row.theta.size(), 0.0);
                entries[j] = traits::mul(sign, traits::point(row.width[j])).lower();
                entries[k] = traits::mul(against, traits::point(row.width[k])).lower();
                auto const fixed = traits::add(traits::mul(sign, traits::point(row.anchor[j])),
                                               traits::mul(against, traits::point(row.anchor[k])));
                row.ratios.emplace_back(entries, traits::neg(fixed).upper());
            }
        }
    }
}

} // namespace paving_detail

/// An expression in which some constants do not separate: there they stand at the middle of the
/// prior, and what they may move it by are further terms, by the mean value theorem:
///   \f[ \theta_j \phi_j(x, c) = \theta_j \phi_j(x, \bar c) + \sum_k (c_k - \bar c_k)\,
///   \theta_j\, \partial\phi_j/\partial c_k(x, \xi) \f]
/// Nothing is changed where no such derivative need exist, or a constant stands in both.
[[nodiscard]] inline separated_expression separate_about(graph& g, node_id rate, box const& prior) {
    auto result = separate(g, rate);
    if (result.complete) return result;
    std::vector<node_id> functions{result.rest};
    for (auto const& t : result.terms) functions.push_back(t.function);
    auto const needed = operands_of(g, functions);
    std::vector<node_id> leaves, middles;
    for (std::size_t k = 0; k < needed.size(); ++k) {
        auto const i = static_cast<node_id>(k);
        if (!needed[k] || (g.depends(i) & on_constant) == 0) continue;
        if (g[i].op == operation::sign) return result;
        if (g[i].op != operation::constant) continue;
        auto const& range = prior[static_cast<std::size_t>(g[i].index)];
        if (!is_bounded(range)) return result;
        leaves.push_back(i);
        middles.push_back(g.constant(mid(range)));
    }
    // The slopes are taken at another place than the coefficients: in one expression a constant of
    // both would be one leaf, of which a quotient could be taken for a direction.
    std::vector<node_id> coefficients;
    for (auto const& t : result.terms)
        for (auto const& factor : t.theta) coefficients.push_back(factor.first);
    auto const outside = operands_of(g, coefficients);
    if (std::any_of(leaves.begin(), leaves.end(), [&](node_id i) { return outside[i]; }))
        return result;
    auto const slopes = differentiate(g, functions, leaves);
    auto const same = graph(g);
    auto const about = copy_into(g, same, functions, [&](node const& n, graph& to) {
        auto const leaf = to.leaf(n.op, static_cast<std::size_t>(n.index));
        auto const at = std::find(leaves.begin(), leaves.end(), leaf);
        return at == leaves.end() ? leaf : middles[static_cast<std::size_t>(at - leaves.begin())];
    });
    std::vector<node_id> sums(slopes[0]);
    result.rest = about[0];
    for (std::size_t j = 0; j < result.terms.size(); ++j) {
        auto theta = g.constant(1.0);
        for (auto const& [atom, e] : result.terms[j].theta) {
            for (int k = 0; k < std::abs(e); ++k) {
                theta = g.binary(e > 0 ? operation::mul : operation::div, theta, atom);
            }
        }
        for (std::size_t k = 0; k < leaves.size(); ++k) {
            if (g.is(slopes[j + 1][k], 0)) continue;
            sums[k] = g.add(sums[k], g.mul(theta, slopes[j + 1][k]));
        }
        result.terms[j].function = about[j + 1];
    }
    for (std::size_t k = 0; k < leaves.size(); ++k) {
        auto const distance = g.binary(operation::sub, leaves[k], middles[k]);
        result.terms.push_back({{{distance, 1}}, sums[k]});
    }
    return result;
}

/// Separates one state equation of a bound model.
/// @param g  the model's graph, to which nodes are added
[[nodiscard]] inline relation_row make_relation_row(graph& g, node_id rate, std::size_t equation,
                                                    box const& prior) {
    relation_row row;
    row.equation = equation;
    row.kinematic = (g.depends(rate) & ~on_state) == 0;
    auto const split = separate_about(g, rate, prior);
    std::vector<node_id> factors;
    for (auto const& t : split.terms) {
        for (auto const& factor : t.theta) factors.push_back(factor.first);
    }
    graph_range atoms(g, factors);
    atoms.evaluate({interval(0.0), {}, prior, {}});
    for (auto const& t : split.terms) {
        auto const range = range_of(t.theta, atoms);
        row.bounded = row.bounded && is_bounded(range);
        row.theta.push_back(t.theta);
        row.range.push_back(range);
        row.functions.push_back(t.function);
        // From the end that is closest to zero: there [a] anchor + [a] width z loses nothing.
        bool const falling = std::abs(range.upper()) < std::abs(range.lower());
        row.anchor.push_back(falling ? range.upper() : range.lower());
        row.width.push_back(falling ? -width(range) : width(range));
    }
    row.functions.push_back(split.rest);
    for (auto const k : leaves_of(g, row.functions, operation::constant)) row.inseparable.insert(k);
    if (row.bounded) paving_detail::add_ratios(row, atoms);
    for (auto const k : leaves_of(g, row.functions, operation::state)) row.states.insert(k);
    row.uses_inputs = row.uses_inputs || !leaves_of(g, row.functions, operation::input).empty();
    return row;
}

/// Takes the row about the middle of its coefficients' ranges, its own state weighted:
///   \f[ [w x_i] = \int w \bigl(\phi_0 + \sum_j \bar\theta_j \phi_j + a x_i\bigr)
///   + \sum_j (\theta_j - \bar\theta_j) \int w \phi_j, \quad w' = a w \f]
/// What the states' bounds leave open then counts for the sum of the functions, which hardly
/// depends on \f$ x_i \f$ where a is what damps it, and for each alone only times what is left of
/// its coefficient.
inline void combine(graph& g, relation_row& row, double growth) {
    auto sum = row.functions.back();
    for (std::size_t j = 0; j < row.theta.size(); ++j) {
        row.centre.push_back(mid(row.range[j]));
        sum = g.add(sum, g.mul(g.constant(row.centre.back()), row.functions[j]));
    }
    row.growth = growth;
    if (growth > 0) {
        auto const own = g.leaf(operation::state, row.equation);
        sum = g.add(sum, g.mul(g.constant(growth), own));
        row.states.insert(row.equation);
    }
    row.functions.back() = sum;
}

/// Adds an unknown coefficient of a difference, see `relation_row::differences`.
inline void add_difference(relation_row& row, relation_row::difference const& d,
                           interval const& range) {
    bool const falling = std::abs(range.upper()) < std::abs(range.lower());
    row.differences.push_back(d);
    row.range.push_back(range);
    row.anchor.push_back(falling ? range.upper() : range.lower());
    row.width.push_back(falling ? -width(range) : width(range));
    row.bounded = row.bounded && is_bounded(range);
}

/// The row of a sum of states \f$ x_i + \sum_k a_k x_k \f$ with the rate r: \f$ x_i' = r -
/// \sum_k a_k x_k' \f$, of which the windows need nothing between samples but r.
[[nodiscard]] inline relation_row make_sum_row(graph& g, state_sum const& sum, box const& prior) {
    auto row = make_relation_row(g, sum.rate, sum.first, prior);
    std::vector<node_id> nodes;
    for (auto const& w : sum.weights) {
        nodes.push_back(w.factor);
        for (auto const& factor : w.product) nodes.push_back(factor.first);
    }
    graph_range range(g, nodes);
    range.evaluate({interval(0.0), {}, prior, {}});
    for (auto const& w : sum.weights) {
        auto const factor = interval_traits<interval>::neg(range.value(w.factor));
        row.theta.push_back(w.product);
        add_difference(row, {w.state, factor}, range_of(w.product, range));
    }
    return row;
}

/// Two inequalities for each window (numbers 2 i and 2 i + 1), then those between coefficients. A
/// window's weight is half the width of what its bounds leave open.
/// @guarantee  z of every coefficient vector that fulfils all windows fulfils all inequalities
[[nodiscard]] inline linear_system system_of(relation_row const& row,
                                             std::vector<window_row> const& windows) {
    using traits = interval_traits<interval>;
    auto const n = row.range.size();
    linear_system system(n);
    std::vector<double> low(n), high(n);
    for (auto const& w : windows) {
        auto right = traits::sub(w.difference, w.a.back());
        double open = width(right);
        for (std::size_t j = 0; j < n; ++j) {
            auto slope = traits::mul(w.a[j], traits::point(row.width[j]));
            if (row.centre.empty()) {
                right = traits::sub(right, traits::mul(w.a[j], traits::point(row.anchor[j])));
                open += mag(row.range[j]) * width(w.a[j]);
            } else {
                // a_j (theta_j - centre) by the middle of a_j, and what that is off.
                auto const a = traits::point(mid(w.a[j]));
                auto const centre = traits::point(row.centre[j]);
                auto const first = traits::sub(traits::point(row.anchor[j]), centre);
                auto const off =
                    traits::mul(traits::sub(w.a[j], a), traits::sub(row.range[j], centre));
                right = traits::sub(right, traits::add(traits::mul(a, first), off));
                open += width(off);
                slope = traits::mul(a, traits::point(row.width[j]));
            }
            low[j] = slope.lower();
            high[j] = -slope.upper();
        }
        double const weight = std::max(open / 2, 1e-300);
        system.add(low, right.upper(), weight);
        system.add(high, -right.lower(), weight);
    }
    for (auto [entries, bound] : row.ratios) {
        entries.resize(n, 0.0);
        system.add(entries, bound, 0);
    }
    return system;
}

/// How much of what the windows' bounds leave open is due to each coefficient of a row about their
/// middles: summed shares.
[[nodiscard]] inline std::vector<double> blur_of(relation_row const& row,
                                                 std::vector<window_row> const& windows) {
    std::vector<double> result(row.centre.size(), 0.0), own(result);
    for (auto const& w : windows) {
        double open = width(w.difference) + width(w.a.back());
        for (std::size_t j = 0; j < own.size(); ++j) {
            own[j] = width(w.a[j]) * width(row.range[j]) / 2;
            open += own[j];
        }
        for (std::size_t j = 0; j < own.size(); ++j) {
            if (open > 0) result[j] += own[j] / open;
        }
    }
    return result;
}

/// Encloses the mean rate that the equation lacks over a window, over the whole prior.
[[nodiscard]] inline interval missing_rate_in(relation_row const& row, window_row const& w) {
    using traits = interval_traits<interval>;
    auto value = traits::sub(w.difference, w.a.back());
    for (std::size_t j = 0; j < row.range.size(); ++j) {
        value = traits::sub(value, traits::mul(row.range[j], w.a[j]));
    }
    bool undefined = false;
    return traits::div(value, w.length, undefined);
}

} // namespace sivid

#endif
