// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_RELATION_DETAIL_RELATION_ROW_HPP
#define SIVID_DIAGNOSIS_RELATION_DETAIL_RELATION_ROW_HPP

#include <sivid/diagnosis/relation/detail/separation.hpp>
#include <sivid/diagnosis/relation/linear_refutation.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/rewrite.hpp>
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
    std::set<std::size_t> states;   ///< that the functions contain
    bool bounded = true;            ///< all ranges are
    bool uses_inputs = false;
    bool kinematic = false; ///< a function of states only
    /// Further unknown coefficients, after those of the functions: of what a state's sensor changes
    /// by over the window, or (nothing) of the window's length.
    std::vector<std::optional<std::size_t>> differences;
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
    interval length;         ///< what a constant missing rate would be multiplied with [s]
};

namespace diagnosis_detail {

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

} // namespace diagnosis_detail

/// Separates one state equation of a bound model.
/// @param g  the model's graph, to which nodes are added
[[nodiscard]] inline relation_row make_relation_row(graph& g, node_id rate, std::size_t equation,
                                                    box const& prior) {
    relation_row row;
    row.equation = equation;
    row.kinematic = (g.depends(rate) & ~on_state) == 0;
    auto const split = separate(g, rate);
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
    if (row.bounded) diagnosis_detail::add_ratios(row, atoms);
    auto const needed = reachable(g, row.functions);
    for (std::size_t k = 0; k < needed.size(); ++k) {
        auto const& n = g.nodes()[k];
        if (!needed[k]) continue;
        if (n.op == operation::state) row.states.insert(static_cast<std::size_t>(n.index));
        row.uses_inputs = row.uses_inputs || n.op == operation::input;
    }
    return row;
}

/// Adds an unknown coefficient of a difference, see `relation_row::differences`.
inline void add_difference(relation_row& row, std::optional<std::size_t> state,
                           interval const& range) {
    bool const falling = std::abs(range.upper()) < std::abs(range.lower());
    row.differences.push_back(state);
    row.range.push_back(range);
    row.anchor.push_back(falling ? range.upper() : range.lower());
    row.width.push_back(falling ? -width(range) : width(range));
    row.bounded = row.bounded && is_bounded(range);
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
            right = traits::sub(right, traits::mul(w.a[j], traits::point(row.anchor[j])));
            auto const slope = traits::mul(w.a[j], traits::point(row.width[j]));
            low[j] = slope.lower();
            high[j] = -slope.upper();
            open += mag(row.range[j]) * width(w.a[j]);
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
