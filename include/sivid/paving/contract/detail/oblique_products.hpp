// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_OBLIQUE_PRODUCTS_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_OBLIQUE_PRODUCTS_HPP

#include <sivid/paving/contract/detail/lifted_block.hpp>
#include <sivid/paving/response/combined_polynomial.hpp>
#include <sivid/space/linear_program/constraint_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sivid {

/// What bounds of combinations \f$ q_i \cdot d \in [a_i, b_i] \f$ say of products of the unknowns:
///   \f[ (q_i \cdot d - a_i)(b_j - q_j \cdot d) \ge 0 \f]
/// and the like, and squares of the combinations. Measurements often fix combinations far better
/// than each unknown; then products are bounded far better so than over the box.
/// @ref  H. D. Sherali, W. P. Adams, A hierarchy of relaxations between the continuous and convex
///   hull representations for zero-one programming problems, SIAM J. Discrete Math. 3 (1990)
class oblique_products {
    using traits = interval_traits<interval>;

public:
    /// A combination of the unknowns, of length 1, and proved bounds of it.
    struct combination {
        std::vector<double> slope;
        double low, high;
    };

    /// As many orthogonal combinations as unknowns, those that some functions tell best first.
    [[nodiscard]] static std::vector<std::vector<double>>
    directions(std::size_t unknowns, std::vector<minimax_block> const& functions) {
        std::vector<std::vector<double>> rows;
        for (auto const& b : functions) {
            for (std::size_t y = 0; y < b.functions(); ++y) {
                if (!std::isfinite(b.margin[y])) continue;
                auto& row = rows.emplace_back(unknowns, 0.0);
                for (std::size_t v = 0; v < b.variable.size(); ++v) {
                    if (b.variable[v] < unknowns)
                        row[b.variable[v]] += b.slope[v * b.functions() + y];
                }
            }
        }
        double longest = 0;
        for (auto const& row : rows) longest = std::max(longest, dot(row, row));
        for (std::size_t v = 0; v < unknowns; ++v) { // what none of them tells
            rows.emplace_back(unknowns, 0.0)[v] = longest > 0 ? 1e-6 * std::sqrt(longest) : 1;
        }
        std::vector<std::vector<double>> result;
        while (result.size() < unknowns) {
            auto const next = std::max_element(
                rows.begin(), rows.end(), [](auto& a, auto& b) { return dot(a, a) < dot(b, b); });
            double const length = std::sqrt(dot(*next, *next));
            if (!(length > 0) || !std::isfinite(length)) return {};
            auto unit = *next;
            for (double& x : unit) x /= length;
            for (auto& row : rows) {
                double const along = dot(row, unit);
                for (std::size_t v = 0; v < unknowns; ++v) row[v] -= along * unit[v];
            }
            result.push_back(std::move(unit));
        }
        return result;
    }

    /// @given  the bounds are proved
    explicit oblique_products(std::vector<combination> all) : all_(std::move(all)) {
        for (std::size_t i = 0; i < all_.size(); ++i) {
            auto const& c = all_[i];
            pairs_.push_back({{i, 1, -c.low}, {i, -1, c.high}});
            for (double const at : {c.low, 0.5 * (c.low + c.high), c.high})
                pairs_.push_back({{i, 1, -at}, {i, 1, -at}});
            for (std::size_t j = i + 1; j < all_.size(); ++j) {
                for (factor const& a : {factor{i, 1, -c.low}, factor{i, -1, c.high}}) {
                    for (factor const& b :
                         {factor{j, 1, -all_[j].low}, factor{j, -1, all_[j].high}})
                        pairs_.push_back({a, b});
                }
            }
        }
    }

    /// The inequalities as functions of unknowns and products, each at its lower margin where it
    /// holds with equality.
    /// @param columns  of all products
    [[nodiscard]] minimax_block
    block(std::map<paving_detail::product, std::size_t> const& columns) {
        minimax_block b;
        scales_.clear();
        auto const n = all_.front().slope.size();
        for (std::size_t v = 0; v < n; ++v) b.variable.push_back(v);
        for (auto const& [product, column] : columns) b.variable.push_back(column);
        b.slope.assign(b.variable.size() * pairs_.size(), 0.0);
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            auto const& [f, g] = pairs_[k];
            auto const &p = all_[f.of].slope, &q = all_[g.of].slope;
            double const s = f.sign * g.sign;
            double constant = f.offset * g.offset, size = 0;
            auto const at = [&](std::size_t v) -> double& {
                return b.slope[v * pairs_.size() + k];
            };
            for (std::size_t v = 0; v < n; ++v)
                at(v) = f.sign * p[v] * g.offset + g.sign * q[v] * f.offset;
            std::size_t v = n;
            for (auto const& [product, column] : columns) {
                auto const [u, w] = product;
                bool const square = u == w; // (1 + column) / 2
                at(v) = square ? 0.5 * s * p[u] * q[u] : s * (p[u] * q[w] + p[w] * q[u]);
                if (square) constant += at(v);
                ++v;
            }
            for (v = 0; v < b.variable.size(); ++v) size = std::max(size, std::abs(at(v)));
            double const scale = size > 0 ? 1 / size : 1;
            double half = std::abs(constant) * scale;
            for (v = 0; v < b.variable.size(); ++v) {
                at(v) *= scale;
                half += std::abs(at(v));
            }
            half *= 0.5;
            scales_.push_back(scale);
            b.offset.push_back(constant * scale - half);
            b.margin.push_back(half);
        }
        return b;
    }

    /// Subtracts an inequality's left side, which is not negative, times a weight.
    /// @param weight  of a function of the block, as a program proposes it; what is not below zero
    ///                does nothing
    void take_off(combined_polynomial& from, std::size_t function, double weight) const {
        if (!(weight < 0)) return;
        auto const& [f, g] = pairs_[function];
        auto const &p = all_[f.of].slope, &q = all_[g.of].slope;
        auto const times = [](interval const& x, double y) {
            return traits::mul(x, traits::point(y));
        };
        auto const size = times(traits::point(weight), scales_[function]); // below zero
        from.add_constant(times(times(size, f.offset), g.offset));
        auto const of_p = times(times(size, f.sign), g.offset);
        auto const of_q = times(times(size, g.sign), f.offset);
        auto const both = times(times(size, f.sign), g.sign);
        for (std::size_t u = 0; u < p.size(); ++u) {
            from.add_linear(u, traits::add(times(of_p, p[u]), times(of_q, q[u])));
            for (std::size_t v = 0; v < p.size(); ++v)
                from.add_product(u, v, times(times(both, p[u]), q[v]));
        }
    }

private:
    /// sign (q_of . d) + offset
    struct factor {
        std::size_t of;
        double sign, offset;
    };
    [[nodiscard]] static double dot(std::vector<double> const& a, std::vector<double> const& b) {
        double sum = 0;
        for (std::size_t v = 0; v < a.size(); ++v) sum += a[v] * b[v];
        return sum;
    }

    std::vector<combination> all_;
    std::vector<std::pair<factor, factor>> pairs_;
    std::vector<double> scales_;
};

} // namespace sivid

#endif
