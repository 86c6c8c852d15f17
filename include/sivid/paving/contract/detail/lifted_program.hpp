// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_LIFTED_PROGRAM_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_LIFTED_PROGRAM_HPP

#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/contract/detail/lifted_block.hpp>
#include <sivid/paving/contract/detail/oblique_products.hpp>
#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Linear programs over the measurements of several experiments in which products of two unknowns
/// are unknowns, too: the same products stand in many measurements, and as errors of each they
/// would hide what all say together.
///   A product m of d_u and d_v obeys \f$ (1 \pm d_u)(1 \pm d_v) \ge 0 \f$, a square the tangents
///   of its parabola. What is of third order is an error of its measurement.
/// @guarantee  what is returned is proved, by interval arithmetic from the multipliers that a
///   program proposes: it holds for all parameters in the part and all starts that meet every
///   measurement
/// @ref  G. P. McCormick, Computability of global solutions to factorable nonconvex programs:
///   Part I, Mathematical Programming 10 (1976)
/// @cost  a program in n unknowns and m products: about n + m exchanges of O((n + m)^2)
class lifted_program {
    using traits = interval_traits<interval>;

public:
    /// @param known   experiments without outliers; kept by reference
    /// @param part    of the box of parameters that they are of
    /// @param starts  parts of their boxes of starts, one each
    /// @param share   products that move no measurement by more than this share of its bound stay
    ///   errors
    /// @param oblique  let proved bounds of combinations bound products, too; all products are
    ///   unknowns then
    lifted_program(response_list const& known, box const& part, std::vector<box> const& starts,
                   double share, bool oblique = false)
        : known_(&known), unknowns_(known, part, starts), columns_(unknowns_.count) {
        std::map<paving_detail::product, double> moves; // in bounds, by product
        for (std::size_t s = 0; s < known.size(); ++s) {
            outputs_.emplace_back(*known[s], unknowns_.places[s]);
            outputs_.back().find_moves(moves);
        }
        for (auto const& [product, most] : moves) {
            if (most > share && !oblique) products_[product] = columns_++;
        }
        for (std::size_t u = 0; oblique && u < unknowns_.count; ++u) {
            for (std::size_t v = u; v < unknowns_.count; ++v) products_[{u, v}] = columns_++;
        }
        for (auto const& p : outputs_) {
            bool const bounded =
                std::any_of(p.scale.begin(), p.scale.end(), [](double s) { return s > 0; });
            blocks_.push_back(bounded ? p.block(products_) : minimax_block{});
        }
        auto const directions = oblique ? oblique_products::directions(unknowns_.count, blocks_)
                                        : std::vector<std::vector<double>>{};
        for (auto const& [product, column] : products_) {
            blocks_.push_back(product.first == product.second
                                  ? tangents(product.first, column)
                                  : planes(product.first, product.second, column));
        }
        // Bounds of the combinations bound products, which bound the combinations.
        for (int round = 0; round < oblique_rounds && !directions.empty(); ++round) {
            std::vector<oblique_products::combination> all;
            for (auto const& q : directions) {
                double const high = reach_along(q, 1), low = -reach_along(q, -1);
                if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) return;
                all.push_back({q, low, high});
            }
            if (oblique_) blocks_.pop_back();
            oblique_.emplace(std::move(all));
            blocks_.push_back(oblique_->block(products_));
        }
    }
    lifted_program(lifted_program const&) = delete; // refers to its own unknowns
    lifted_program& operator=(lifted_program const&) = delete;

    /// The parameters, then the starts of each experiment.
    [[nodiscard]] shared_unknowns const& unknowns() const { return unknowns_; }

    /// A number that \f$ \pm d_j \f$ does not exceed; 1 when nothing is gained, minus infinity when
    /// it is proved that nothing meets all measurements.
    [[nodiscard]] double reach(std::size_t j, bool upwards) const {
        std::vector<double> goal(columns_, 0.0);
        goal[j] = upwards ? 1 : -1;
        combined_polynomial target(unknowns_.count);
        target.add_linear(j, traits::point(upwards ? -1.0 : 1.0));
        return std::min(1.0, most(std::move(goal), std::move(target)));
    }
    /// What an unknown can reach of its range. @param range  for which its unit stands
    [[nodiscard]] interval contracted(std::size_t unknown, interval const& range) const {
        auto left = range;
        for (bool const upwards : {true, false}) {
            double const most = reach(unknown, upwards);
            if (!(most < 1)) continue;
            if (!std::isfinite(most)) return traits::empty();
            auto const end = traits::add(
                traits::point(mid(range)),
                traits::mul(traits::point(rad(range)), traits::point(upwards ? most : -most)));
            left = traits::intersect(left, upwards ? traits::bounds(-detail::greatest, end.upper())
                                                   : traits::bounds(end.lower(), detail::greatest));
            if (is_empty(left)) break;
        }
        return left;
    }
    /// A bound that an output of an experiment keeps, from above or from below; infinite when none
    /// was found.
    [[nodiscard]] double end_of(std::size_t experiment, std::size_t output, bool upwards) const {
        auto const& r = *(*known_)[experiment];
        auto const row = outputs_[experiment].row(output, products_, columns_);
        std::vector<double> goal;
        for (double const slope : row) goal.push_back(upwards ? slope : -slope);
        combined_polynomial target(unknowns_.count);
        target.add(r, {{output, upwards ? -1.0 : 1.0}}, unknowns_.places[experiment]);
        double const bound = most(std::move(goal), std::move(target));
        return upwards ? bound : -bound;
    }

private:
    static constexpr int oblique_rounds = 2;

    /// A number that \f$ sign \, q \cdot d \f$ does not exceed.
    [[nodiscard]] double reach_along(std::vector<double> const& q, double sign) const {
        std::vector<double> goal(columns_, 0.0);
        combined_polynomial target(unknowns_.count);
        for (std::size_t v = 0; v < q.size(); ++v) {
            goal[v] = sign * q[v];
            target.add_linear(v, traits::point(-goal[v]));
        }
        return most(std::move(goal), std::move(target));
    }
    [[nodiscard]] static minimax_block planes(std::size_t u, std::size_t v, std::size_t m) {
        // m - u + v <= 1, m + u - v <= 1, m - u - v >= -1, m + u + v >= -1; none passes 3 elsewhere
        return {{u, v, m}, {-1, 1, -1, 1, 1, -1, -1, 1, 1, 1, 1, 1}, {1, 1, -1, -1}, {2, 2, 2, 2}};
    }
    /// With m = 2 d^2 - 1: m + 1 - 4 c d + 2 c^2 >= 0.
    [[nodiscard]] static minimax_block tangents(std::size_t u, std::size_t m) {
        minimax_block b{{u, m}, {}, {}, {}};
        for (double const c : touching) {
            double const half = 1 + 2 * std::abs(c) + c * c;
            b.offset.push_back(1 + 2 * c * c - half);
            b.margin.push_back(half);
            b.slope.push_back(-4 * c);
        }
        b.slope.resize(2 * b.offset.size(), 1.0);
        return b;
    }
    static constexpr double touching[] = {-1, -0.5, 0, 0.5, 1};

    /// What \f$ \sum goal \f$ does not exceed: \f$ \sum_i w_i b_i - \min_d (\sum_i w_i y_i +
    /// target) \f$.
    [[nodiscard]] double most(std::vector<double> goal, combined_polynomial target) const {
        auto const cut = cut_program(columns_, blocks_)(std::move(goal));
        std::vector<measurement_weight> measured;
        std::map<paving_detail::product, double> tilts;
        combined_polynomial alone(unknowns_.count); // without the goal
        for (auto const& w : cut.weights) {
            if (w.block < known_->size()) {
                measured.push_back(
                    {w.block, w.function, w.value * outputs_[w.block].scale[w.function]});
                continue;
            }
            if (oblique_ && w.block + 1 == blocks_.size()) {
                oblique_->take_off(target, w.function, w.value);
                oblique_->take_off(alone, w.function, w.value);
                continue;
            }
            auto const& block = blocks_[w.block];
            if (block.variable.size() < 3) continue;
            tilts[{block.variable[0], block.variable[1]}] += w.value * block.slope[w.function];
        }
        std::vector<combined_polynomial::plane> bounds;
        for (auto const& [product, tilt] : tilts) {
            bounds.push_back({product.first, product.second, tilt});
        }
        if (cut.empty) {
            // The goal stands beside: what the sum alone is shows whether anything is left.
            measured_sum const rest(*known_, unknowns_, measured, std::move(alone));
            return rest.outputs.lower_bound(bounds) > upper(rest.most) ? -detail::infinity
                                                                       : detail::infinity;
        }
        return measured_sum(*known_, unknowns_, measured, std::move(target)).reach(bounds);
    }

    response_list const* known_;
    shared_unknowns unknowns_;
    std::size_t columns_;
    std::map<paving_detail::product, std::size_t> products_; ///< column of each
    std::vector<paving_detail::scaled_polynomials> outputs_;
    std::vector<minimax_block> blocks_; ///< experiments, products, products of combinations
    std::optional<oblique_products> oblique_;
};

} // namespace sivid

#endif
