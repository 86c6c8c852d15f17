// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_IMPL_LINEAR_SOLUTION_IPP
#define SIVID_MODEL_GRAPH_IMPL_LINEAR_SOLUTION_IPP

#include <sivid/model/graph/detail/linear_solution.hpp>

#include <sivid/model/graph/detail/fraction_coefficients.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/normal_form.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

/// Solves one set of equations; see `solve_linear`.
class linear_solver {
    using rows = std::vector<std::vector<node_id>>;

public:
    linear_solver(graph& g, linear_equations equations, std::vector<literal> const& nominal)
        : g_(&g), e_(std::move(equations)), n_(e_.right.size()) {
        bool square = e_.matrix.size() == n_;
        for (auto const& row : e_.matrix) square = square && row.size() == n_;
        if (!square) throw std::invalid_argument("linear equations: the matrix is not square");
        for (auto const& value : nominal) {
            double const fifth = 0.2 * std::abs(value.nearest);
            about_.push_back(
                interval_traits<interval>::bounds(value.nearest - fifth, value.nearest + fifth));
        }
    }

    [[nodiscard]] std::vector<node_id> operator()() {
        match();
        // needs[i][j]: the equation of unknown i cannot be solved before j is known, or with it.
        std::vector<std::vector<bool>> needs(n_, std::vector<bool>(n_));
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t j = 0; j < n_; ++j) needs[i][j] = !is_zero(e_.matrix[i][j]);
        }
        for (std::size_t k = 0; k < n_; ++k) {
            for (std::size_t i = 0; i < n_; ++i) {
                for (std::size_t j = 0; needs[i][k] && j < n_; ++j) {
                    if (needs[k][j]) needs[i][j] = true;
                }
            }
        }
        std::vector<node_id> y(n_);
        std::vector<bool> known(n_);
        for (std::size_t solved = 0; solved < n_;) {
            for (std::size_t i = 0; i < n_; ++i) {
                std::vector<std::size_t> block;
                bool ready = !known[i];
                for (std::size_t j = 0; j < n_; ++j) {
                    bool const together = j == i || (needs[i][j] && needs[j][i]);
                    if (together) block.push_back(j);
                    ready = ready && (together || known[j] || !needs[i][j]);
                }
                if (!ready) continue;
                auto const found = solve(block, y, known);
                for (std::size_t k = 0; k < block.size(); ++k) {
                    y[block[k]] = found[k];
                    known[block[k]] = true;
                }
                solved += block.size();
            }
        }
        return y;
    }

private:
    static constexpr std::size_t most_by_determinants = 4;

    [[nodiscard]] bool is_zero(node_id i) const { return g_->is(i, 0); }
    /// x - a y
    [[nodiscard]] node_id less(node_id x, node_id a, node_id y) {
        return is_zero(a) || is_zero(y) ? x : g_->sub(x, g_->mul(a, y));
    }

    /// Orders the equations so that each has an unknown of its own in it: its diagonal.
    void match() {
        constexpr auto none = std::numeric_limits<std::size_t>::max();
        std::vector<std::size_t> equation(n_, none); // of each unknown
        std::vector<bool> tried;
        std::function<bool(std::size_t)> const place = [&](std::size_t i) {
            for (std::size_t k = 0; k < n_; ++k) {
                auto const j = (i + k) % n_; // its own first
                if (is_zero(e_.matrix[i][j]) || tried[j]) continue;
                tried[j] = true;
                if (equation[j] == none || place(equation[j])) {
                    equation[j] = i;
                    return true;
                }
            }
            return false;
        };
        for (std::size_t i = 0; i < n_; ++i) {
            tried.assign(n_, false);
            if (place(i)) continue;
            throw std::invalid_argument(
                "the matrix is singular whatever the values of its entries: equation " +
                std::to_string(i + 1) +
                (i < e_.unknowns.size() ? " (in the place of " + e_.unknowns[i] + ")" : "") +
                " has no unknown left that the equations before it do not need");
        }
        linear_equations ordered = e_;
        for (std::size_t j = 0; j < n_; ++j) {
            ordered.matrix[j] = e_.matrix[equation[j]];
            ordered.right[j] = e_.right[equation[j]];
        }
        e_ = std::move(ordered);
    }

    /// The unknowns of a block whose other unknowns are known.
    [[nodiscard]] std::vector<node_id> solve(std::vector<std::size_t> const& block,
                                             std::vector<node_id> const& y,
                                             std::vector<bool> const& known) {
        rows matrix;
        std::vector<node_id> right;
        for (auto const i : block) {
            auto b = e_.right[i];
            for (std::size_t j = 0; j < n_; ++j) {
                if (known[j]) b = less(b, e_.matrix[i][j], y[j]);
            }
            right.push_back(b);
            auto& row = matrix.emplace_back();
            for (auto const j : block) row.push_back(e_.matrix[i][j]);
        }
        return dense(matrix, right);
    }
    [[nodiscard]] std::vector<node_id> dense(rows const& a, std::vector<node_id> const& b) {
        auto const n = b.size();
        if (n == 1) return {g_->div(b[0], a[0][0])};
        if (n > most_by_determinants) return by_pivot(a, b);
        auto const whole = narrower(determinant(a));
        std::vector<node_id> y;
        for (std::size_t j = 0; j < n; ++j) {
            auto replaced = a;
            for (std::size_t i = 0; i < n; ++i) replaced[i][j] = b[i];
            y.push_back(g_->div(determinant(replaced), whole));
        }
        return y;
    }
    /// Without the unknown whose diagonal is the simplest.
    [[nodiscard]] std::vector<node_id> by_pivot(rows const& a, std::vector<node_id> const& b) {
        auto const n = b.size();
        auto const rank = [&](std::size_t i) { // what depends on nothing first, then on constants
            auto const d = g_->depends(a[i][i]);
            return is_zero(a[i][i]) ? 4 : d == on_nothing ? 0 : d == on_constant ? 1 : 2;
        };
        std::size_t p = 0;
        for (std::size_t i = 1; i < n; ++i) p = rank(i) < rank(p) ? i : p;
        rows left;
        std::vector<node_id> right;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == p) continue;
            auto const factor = is_zero(a[i][p]) ? a[i][p] : g_->div(a[i][p], a[p][p]);
            auto& row = left.emplace_back();
            for (std::size_t j = 0; j < n; ++j) {
                if (j != p) row.push_back(less(a[i][j], factor, a[p][j]));
            }
            right.push_back(less(b[i], factor, b[p]));
        }
        auto y = dense(left, right);
        auto own = b[p];
        for (std::size_t j = 0, k = 0; j < n; ++j) {
            if (j != p) own = less(own, a[p][j], y[k++]);
        }
        y.insert(y.begin() + static_cast<std::ptrdiff_t>(p), g_->div(own, a[p][p]));
        return y;
    }

    /// By Laplace's expansion along the rows; minors are shared.
    [[nodiscard]] node_id determinant(rows const& a) {
        auto const n = a.size();
        std::map<unsigned, node_id> minors; // of the last rows, by their columns
        std::function<node_id(std::size_t, unsigned)> const minor = [&](std::size_t row,
                                                                        unsigned columns) {
            if (row == n) return g_->constant(1.0);
            if (auto const at = minors.find(columns); at != minors.end()) return at->second;
            auto sum = g_->constant(0.0);
            bool minus = false;
            for (std::size_t j = 0; j < n; ++j) {
                auto const column = 1U << j;
                if ((columns & column) == 0) continue;
                bool const negative = std::exchange(minus, !minus);
                if (is_zero(a[row][j])) continue;
                auto const rest = minor(row + 1, columns & ~column);
                if (is_zero(rest)) continue;
                auto const term = g_->mul(a[row][j], rest);
                sum = negative ? g_->sub(sum, term) : g_->add(sum, term);
            }
            return minors[columns] = sum;
        };
        return minor(0, (1U << n) - 1);
    }
    /// The same multiplied out, with common factors in front, where that is narrower.
    [[nodiscard]] node_id narrower(node_id whole) {
        if (!g_->total(whole)) return whole; // what cancels might hide where it is not defined
        multiplied_out<fraction_coefficients> multiplied(fraction_coefficients(*g_), {64, 400});
        auto const terms = multiplied(whole); // a copy: the graph grows
        if (terms.empty() || terms.size() > 24) return whole;
        auto common = terms.begin()->first;
        for (auto const& [product, v] : terms) {
            for (auto& [node, e] : common) {
                auto const at = std::find_if(product.begin(), product.end(),
                                             [n = node](auto const& f) { return f.first == n; });
                e = at == product.end() ? 0 : std::min(e, at->second);
            }
        }
        std::erase_if(common, [](auto const& factor) { return factor.second <= 0; });
        auto sum = g_->constant(0.0);
        for (auto const& [product, v] : terms) {
            auto term = product_of(quotient(product, common));
            constexpr std::int64_t exact = std::int64_t{1} << 53; // as a double
            if (std::abs(v.above) > exact || v.below > exact) return whole;
            term = g_->mul(g_->constant(static_cast<double>(std::abs(v.above))), term);
            term = g_->div(term, g_->constant(static_cast<double>(v.below)));
            sum = v.above < 0 ? g_->sub(sum, term) : g_->add(sum, term);
        }
        auto const other = g_->mul(product_of(common), sum);
        return width_of(other) < width_of(whole) ? other : whole;
    }
    /// Factors of the same power are one power: (a b)^2 loses less than a^2 b^2.
    [[nodiscard]] node_id product_of(node_product const& factors) {
        std::map<int, node_id> by_power;
        for (auto const& [node, e] : factors) {
            auto const [at, fresh] = by_power.try_emplace(e, node);
            if (!fresh) at->second = g_->mul(at->second, node);
        }
        auto result = g_->constant(1.0);
        for (auto const& [e, base] : by_power) result = g_->mul(result, g_->pown(base, e));
        return result;
    }
    /// Over a fifth about the nominal constants, and moderate values of everything else.
    [[nodiscard]] double width_of(node_id i) const {
        std::size_t states = 0, inputs = 0;
        for (auto const& n : g_->nodes()) {
            auto const next = static_cast<std::size_t>(n.index) + 1;
            if (n.op == operation::state) states = std::max(states, next);
            if (n.op == operation::input) inputs = std::max(inputs, next);
        }
        auto const moderate = interval_traits<interval>::bounds(-1.0, 1.0);
        graph_range range(*g_, {i});
        range.evaluate({moderate, box(std::vector<interval>(states, moderate)), box(about_),
                        box(std::vector<interval>(inputs, moderate))});
        double const w = width(range.value(i));
        return range.undefined(i) || !(w >= 0) ? std::numeric_limits<double>::infinity() : w;
    }

    graph* g_;
    linear_equations e_;
    std::size_t n_;
    std::vector<interval> about_;
};

} // namespace model_detail

SIVID_DECL std::vector<node_id> solve_linear(graph& g, linear_equations equations,
                                             std::vector<literal> const& nominal) {
    return model_detail::linear_solver(g, std::move(equations), nominal)();
}

} // namespace sivid

#endif
