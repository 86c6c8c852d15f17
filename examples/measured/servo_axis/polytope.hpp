// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_POLYTOPE_HPP
#define SERVO_AXIS_POLYTOPE_HPP

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace servo {

/// A relation that is linear in N unknowns: sum factor_j p_j in target.
template <std::size_t N>
struct linear_relation {
    std::array<sivid::interval, N> factor;
    sivid::interval target;
};

/// Contracts a box by all linear relations together: small linear programmes, two a side.
///   max c d subject to rows a d <= b and |d_j| <= r_j. For any multipliers y >= 0
///   c d <= sum y_i b_i + |c - sum y_i a_i| r,
/// so that a plain floating-point simplex proposes y and one interval evaluation proves the bound.
template <std::size_t N>
class polytope {
    using interval = sivid::interval;
    using traits = sivid::interval_traits<interval>;
    using vector = Eigen::Matrix<double, static_cast<int>(N), 1>;
    using matrix = Eigen::Matrix<double, static_cast<int>(N), static_cast<int>(N)>;

public:
    polytope(sivid::box const& p, std::vector<linear_relation<N>> const& relations) {
        for (std::size_t j = 0; j < N; ++j) {
            centre_[j] = sivid::mid(p[j]);
            deviation_[j] = traits::sub(p[j], interval(centre_[j]));
            scale_[static_cast<Eigen::Index>(j)] = sivid::mag(deviation_[j]);
        }
        for (auto const& r : relations) add(r);
    }

    /// @returns false when nothing is left; then `p` is meaningless
    [[nodiscard]] bool contract(sivid::box& p) {
        if (rows_.empty()) return true;
        for (std::size_t j = 0; j < N; ++j) {
            for (double const sign : {1.0, -1.0}) {
                if (!(scale_[static_cast<Eigen::Index>(j)] > 0)) continue;
                auto const most = maximum(j, sign);
                if (!most) return false;
                auto const limit = traits::add(interval(centre_[j]), interval(sign * *most));
                p[j] = traits::intersect(p[j], sign > 0 ? traits::bounds(-HUGE_VAL, limit.upper())
                                                        : traits::bounds(limit.lower(), HUGE_VAL));
                if (sivid::is_empty(p[j])) return false;
            }
        }
        return true;
    }

private:
    struct row {
        std::array<double, N> a;
        double b;      ///< a d <= b
        double size;   ///< norm of (a_j r_j)
        vector scaled; ///< a_j r_j / size
        double limit;  ///< b / size
    };
    /// A row (index >= 0), or the bound `sign * d_j <= r_j` of the box.
    struct active {
        int row = -1;
        std::size_t side = 0;
        double sign = 1;
    };

    void add(linear_relation<N> const& r) {
        auto rest = r.target;
        std::array<double, N> a;
        for (std::size_t j = 0; j < N; ++j) {
            a[j] = sivid::mid(r.factor[j]);
            rest = traits::sub(rest, traits::mul(r.factor[j], interval(centre_[j])));
            rest = traits::sub(
                rest, traits::mul(traits::sub(r.factor[j], interval(a[j])), deviation_[j]));
        }
        add_row(a, rest.upper());
        for (auto& x : a) x = -x;
        add_row(a, -rest.lower());
    }
    void add_row(std::array<double, N> const& a, double b) {
        row r{a, b, 0, {}, 0};
        for (std::size_t j = 0; j < N; ++j) {
            auto const i = static_cast<Eigen::Index>(j);
            r.scaled[i] = a[j] * scale_[i];
        }
        double const size = r.scaled.norm();
        if (!(size > 0) || !std::isfinite(size) || !std::isfinite(b)) return;
        if (r.scaled.template lpNorm<1>() <= b) return; // all of the box satisfies it
        r.size = size;
        r.scaled /= size;
        r.limit = b / size;
        rows_.push_back(r);
    }

    [[nodiscard]] vector normal(active const& c) const {
        if (c.row >= 0) return rows_[static_cast<std::size_t>(c.row)].scaled;
        vector e = vector::Zero();
        e[static_cast<Eigen::Index>(c.side)] = c.sign;
        return e;
    }
    [[nodiscard]] double limit(active const& c) const {
        return c.row >= 0 ? rows_[static_cast<std::size_t>(c.row)].limit : 1.0;
    }

    /// Proved upper bound of sign * d_side; nothing when the rows contradict each other (proved).
    /// @ref  dual simplex: every basis on the way has y >= 0, so every one proves some bound
    [[nodiscard]] std::optional<double> maximum(std::size_t side, double sign) const {
        std::array<active, N> basis;
        for (std::size_t j = 0; j < N; ++j) basis[j] = {-1, j, j == side ? sign : 1.0};
        vector y = vector::Zero();
        y[static_cast<Eigen::Index>(side)] = 1;
        for (int step = 0; step < 60; ++step) {
            matrix b;
            vector h;
            for (std::size_t k = 0; k < N; ++k) {
                auto const i = static_cast<Eigen::Index>(k);
                b.row(i) = normal(basis[k]).transpose();
                h[i] = limit(basis[k]);
            }
            Eigen::PartialPivLU<matrix> const lu(b);
            vector const x = lu.solve(h);
            auto const worst = most_violated(x);
            if (!worst) break;
            vector const enters = normal(*worst);
            vector const alpha = lu.transpose().solve(enters);
            if (!alpha.allFinite()) break;
            Eigen::Index leaves = -1;
            double ratio = HUGE_VAL;
            for (Eigen::Index k = 0; k < alpha.size(); ++k) {
                if (!(alpha[k] > 1e-9)) continue;
                double const r = y[k] / alpha[k];
                if (r < ratio) {
                    ratio = r;
                    leaves = k;
                }
            }
            if (leaves < 0) {
                if (contradiction(*worst, basis, alpha)) return std::nullopt;
                break;
            }
            y -= ratio * alpha;
            y[leaves] = ratio;
            y = y.cwiseMax(0.0);
            basis[static_cast<std::size_t>(leaves)] = *worst;
        }
        std::vector<weighted_row> proof;
        for (std::size_t k = 0; k < N; ++k)
            collect(proof, basis[k], y[static_cast<Eigen::Index>(k)]);
        std::array<double, N> objective{};
        objective[side] = sign;
        return bound(objective, proof, scale_[static_cast<Eigen::Index>(side)]);
    }

    [[nodiscard]] std::optional<active> most_violated(vector const& x) const {
        std::optional<active> worst;
        double most = 1e-7;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            double const v = rows_[i].scaled.dot(x) - rows_[i].limit;
            if (v > most) {
                most = v;
                worst = active{static_cast<int>(i), 0, 1.0};
            }
        }
        for (std::size_t j = 0; j < N; ++j) {
            double const v = std::abs(x[static_cast<Eigen::Index>(j)]) - 1;
            if (v > most) {
                most = v;
                worst = active{-1, j, x[static_cast<Eigen::Index>(j)] > 0 ? 1.0 : -1.0};
            }
        }
        return worst;
    }

    struct weighted_row {
        row const* which;
        double weight; ///< of the scaled row
    };
    void collect(std::vector<weighted_row>& proof, active const& c, double weight) const {
        if (c.row < 0 || !(weight > 0) || !std::isfinite(weight)) return;
        proof.push_back({&rows_[static_cast<std::size_t>(c.row)], weight});
    }
    /// The proof: objective d <= sum y_i b_i + |objective - sum y_i a_i| r, outward.
    [[nodiscard]] double bound(std::array<double, N> const& objective,
                               std::vector<weighted_row> const& proof, double unit) const {
        interval sum(0.0);
        std::array<interval, N> left;
        for (std::size_t j = 0; j < N; ++j) left[j] = interval(objective[j]);
        for (auto const& [r, weight] : proof) {
            interval const y(weight * unit / r->size); // any y >= 0 will do
            sum = traits::add(sum, traits::mul(y, interval(r->b)));
            for (std::size_t j = 0; j < N; ++j) {
                left[j] = traits::sub(left[j], traits::mul(y, interval(r->a[j])));
            }
        }
        for (std::size_t j = 0; j < N; ++j) {
            sum = traits::add(sum, traits::mul(left[j], deviation_[j]));
        }
        return sum.upper();
    }
    /// Farkas: a combination of rows whose left side vanishes and whose right side is negative.
    /// @given enters = sum alpha_k basis_k with alpha <= 0, so enters + sum |alpha_k| basis_k = 0
    [[nodiscard]] bool contradiction(active const& enters, std::array<active, N> const& basis,
                                     vector const& alpha) const {
        std::vector<weighted_row> proof;
        collect(proof, enters, 1.0);
        for (std::size_t k = 0; k < N; ++k) {
            collect(proof, basis[k], -alpha[static_cast<Eigen::Index>(k)]);
        }
        return bound({}, proof, 1.0) < 0;
    }

    std::array<double, N> centre_{};
    std::array<interval, N> deviation_;
    vector scale_;
    std::vector<row> rows_;
};

} // namespace servo

#endif
