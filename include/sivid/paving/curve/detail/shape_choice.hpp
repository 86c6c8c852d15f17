// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_SHAPE_CHOICE_HPP
#define SIVID_PAVING_CURVE_DETAIL_SHAPE_CHOICE_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/paving/curve/curve_shapes.hpp>
#include <sivid/paving/curve/detail/parallelepiped.hpp>
#include <sivid/paving/curve/detail/principal_shapes.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// g(z, p), about.
[[nodiscard]] inline std::optional<double> curve_value(recorded_map const& g, double z,
                                                       std::vector<double> const& p) {
    auto const values =
        g.at<approximate_arithmetic>([&](std::size_t i) { return i == 0 ? z : p[i - 1]; });
    return values ? std::optional(values->front()) : std::nullopt;
}

/// Finds shapes in plain doubles; nothing of them is proved.
class shape_choice {
public:
    shape_choice(recorded_map const& g, std::vector<parallelepiped> const& cells) : g_(&g) {
        for (auto const& cell : cells) {
            auto const n = cell.size();
            samples_.push_back(cell.middle);
            for (std::size_t corner = 0; corner < (std::size_t{1} << n); ++corner) {
                std::vector<double> d;
                for (std::size_t k = 0; k < n; ++k) d.push_back((corner >> k) % 2 == 0 ? -1 : 1);
                samples_.push_back(cell.at(d));
            }
        }
    }

    /// @returns nothing where few polynomials do not do
    [[nodiscard]] std::optional<curve_shapes>
    operator()(interval range, std::vector<double> const& visited, double negligible) const {
        if (is_odd(mag(range))) {
            range = interval_traits<interval>::bounds(-mag(range), mag(range));
        }
        curve_shapes result;
        result.centre = mid(range);
        result.scale = 1 / rad(range);
        if (!std::isfinite(result.scale) || !std::isfinite(result.centre)) return std::nullopt;
        auto const degree = needed_degree(result);
        if (!degree) return std::nullopt;
        auto const x = chebyshev_nodes(*degree + 3);
        result.nodes = scaled_nodes(result, x);
        std::vector<std::vector<double>> rows;
        for (auto const& p : samples_) {
            auto row = values_at(result.nodes, p);
            if (!row) return std::nullopt;
            rows.push_back(*std::move(row));
        }
        auto const n = x.size();
        result.middles.assign(n, 0.0);
        for (auto const& row : rows) {
            for (std::size_t i = 0; i < n; ++i) {
                result.middles[i] += row[i] / static_cast<double>(rows.size());
            }
        }
        result.mean = by_powers(chebyshev_coefficients(result.middles), *degree);
        auto const weight = weights_by(visited, result, x);
        double size = 0; // of the curve
        for (std::size_t i = 0; i < n; ++i) size = std::hypot(size, result.middles[i] * weight[i]);
        for (auto& row : rows) {
            for (std::size_t i = 0; i < n; ++i) row[i] = (row[i] - result.middles[i]) * weight[i];
        }
        add_shapes(rows, weight, negligible * size, *degree, result);
        if (result.shapes.empty()) return std::nullopt;
        return result;
    }

private:
    static constexpr std::size_t most_shapes = 6;
    static constexpr std::size_t most_degree = 40;

    /// Of each node: where arguments are visited, more is asked for.
    [[nodiscard]] static std::vector<double> weights_by(std::vector<double> const& visited,
                                                        curve_shapes const& s,
                                                        std::vector<double> const& x) {
        std::vector<double> weight;
        for (double const node : x) {
            double near = 0;
            for (double const z : visited) {
                near += std::abs((z - s.centre) * s.scale - node) < 0.05 ? 10 : 0;
            }
            weight.push_back(
                std::sqrt(near / std::max<double>(1, static_cast<double>(visited.size())) + 0.02));
        }
        return weight;
    }
    /// The principal directions of curves, of which none reaches further than 1.
    /// @param rows        weighted deviations from the middle, by curve
    /// @param negligible  how far a direction reaches that is left out
    static void add_shapes(std::vector<std::vector<double>> const& rows,
                           std::vector<double> const& weight, double negligible, std::size_t degree,
                           curve_shapes& result) {
        auto const n = weight.size();
        Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(n));
        for (std::size_t k = 0; k < rows.size(); ++k) {
            all.row(static_cast<Eigen::Index>(k)) =
                Eigen::Map<Eigen::RowVectorXd const>(rows[k].data(), static_cast<Eigen::Index>(n));
        }
        approximate_svd const found(all);
        for (std::size_t j = 0; j < std::min(most_shapes, n); ++j) {
            double const* const v = found.right.col(static_cast<Eigen::Index>(j)).data();
            double reach = 0;
            for (auto const& row : rows) {
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i) sum += row[i] * v[i];
                reach = std::max(reach, std::abs(sum));
            }
            if (!(reach > negligible)) break;
            std::vector<double> values, sum;
            for (std::size_t i = 0; i < n; ++i) {
                values.push_back(v[i] / weight[i] * reach);
                sum.push_back(v[i] * weight[i] / reach);
            }
            result.shapes.push_back(by_powers(chebyshev_coefficients(values), degree));
            result.weights.push_back(std::move(sum));
        }
    }
    [[nodiscard]] static std::vector<double> scaled_nodes(curve_shapes const& s,
                                                          std::vector<double> const& x) {
        std::vector<double> z;
        for (double const at : x) z.push_back(s.centre + at / s.scale);
        return z;
    }
    [[nodiscard]] std::optional<std::vector<double>> values_at(std::vector<double> const& z,
                                                               std::vector<double> const& p) const {
        std::vector<double> result;
        for (double const at : z) {
            auto const value = curve_value(*g_, at, p);
            if (!value || !std::isfinite(*value)) return std::nullopt;
            result.push_back(*value);
        }
        return result;
    }
    /// As far as a few values show; shapes need half of the powers then.
    [[nodiscard]] bool is_odd(double reach) const {
        auto const& p = samples_[0];
        for (double const share : {0.0, 0.21, 0.5, 0.77, 1.0}) {
            auto const y = values_at({share * reach, -share * reach}, p);
            if (!y || !(std::abs((*y)[0] + (*y)[1]) <= 1e-12 * std::abs((*y)[0]))) return false;
        }
        return true;
    }
    /// The degree up to which polynomials tell curves.
    [[nodiscard]] std::optional<std::size_t> needed_degree(curve_shapes const& s) const {
        auto const z = scaled_nodes(s, chebyshev_nodes(most_degree + 24));
        std::size_t degree = 1;
        std::size_t const stride = 1 + samples_.size() / 64;
        for (std::size_t k = 0; k < samples_.size(); k += stride) {
            auto const values = values_at(z, samples_[k]);
            if (!values) return std::nullopt;
            auto const c = chebyshev_coefficients(*values);
            double most = 0;
            for (double const v : *values) most = std::max(most, std::abs(v));
            for (std::size_t i = degree + 1; i < c.size(); ++i) {
                if (std::abs(c[i]) > 1e-9 * most) degree = i;
            }
        }
        if (degree > most_degree) return std::nullopt;
        return degree;
    }

    recorded_map const* g_;
    std::vector<std::vector<double>> samples_; ///< of parameters
};

} // namespace sivid::paving_detail

#endif
