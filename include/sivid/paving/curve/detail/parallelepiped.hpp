// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_PARALLELEPIPED_HPP
#define SIVID_PAVING_CURVE_DETAIL_PARALLELEPIPED_HPP

#include <sivid/space/box.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Where slope . d lies.
struct strip {
    std::vector<double> slope;
    interval range;
};

/// Points \f$ p = middle + \sum_k side_k d_k + [-slack, slack] \f$ for d in \f$ [-1,1]^n \f$: what
/// strips leave of a box is often too thin for any other one.
struct parallelepiped {
    using traits = interval_traits<interval>;

    std::vector<double> middle, slack;
    std::vector<std::vector<double>> side; ///< [k][j]
    double volume = 1; ///< as a share of the box that it was, about: a preference

    /// Contains the box.
    [[nodiscard]] static parallelepiped of(box const& b) {
        auto const n = b.size();
        parallelepiped result{std::vector<double>(n), std::vector<double>(n),
                              std::vector<std::vector<double>>(n, std::vector<double>(n, 0.0))};
        for (std::size_t j = 0; j < n; ++j) {
            result.middle[j] = mid(b[j]);
            result.side[j][j] = rad(b[j]);
            result.slack[j] = 4 * unit * mag(b[j]) + 1e-300;
        }
        return result;
    }
    [[nodiscard]] std::size_t size() const { return middle.size(); }
    [[nodiscard]] box hull() const {
        std::vector<interval> result;
        for (std::size_t j = 0; j < size(); ++j) {
            auto reach = traits::point(slack[j]);
            for (auto const& s : side) reach = traits::add(reach, traits::point(std::abs(s[j])));
            result.push_back(traits::add(traits::point(middle[j]),
                                         traits::bounds(-reach.upper(), reach.upper())));
        }
        return box(std::move(result));
    }
    /// The point at d, up to rounding.
    [[nodiscard]] std::vector<double> at(std::vector<double> const& d) const {
        auto p = middle;
        for (std::size_t k = 0; k < d.size(); ++k) {
            for (std::size_t j = 0; j < p.size(); ++j) p[j] += d[k] * side[k][j];
        }
        return p;
    }
    /// Two that cover it, each of half its side number k.
    [[nodiscard]] std::pair<parallelepiped, parallelepiped> halves(std::size_t k) const {
        auto lower = *this;
        lower.volume *= 0.5;
        for (std::size_t j = 0; j < size(); ++j) {
            double const half = 0.5 * side[k][j];
            lower.side[k][j] = half;
            lower.slack[j] += 4 * unit * (std::abs(middle[j]) + std::abs(half)) + 1e-300;
        }
        auto upper = lower;
        for (std::size_t j = 0; j < size(); ++j) {
            lower.middle[j] -= lower.side[k][j];
            upper.middle[j] += upper.side[k][j];
        }
        return {std::move(lower), std::move(upper)};
    }
    /// A smaller one that covers what strips leave; itself where there is none; nothing where a
    /// strip misses it. Of the strips and of its own sides those are taken that are thinnest
    /// across to what has been taken before.
    [[nodiscard]] std::optional<parallelepiped> within(std::vector<strip> strips) const {
        auto const n = size();
        for (auto& s : strips) {
            auto reach = traits::point(0.0);
            for (double const c : s.slope) reach = traits::add(reach, traits::point(std::abs(c)));
            s.range = traits::intersect(s.range, traits::bounds(-reach.upper(), reach.upper()));
            if (is_empty(s.range)) return std::nullopt;
        }
        for (std::size_t k = 0; k < n; ++k) {
            strips.push_back({std::vector<double>(n, 0.0), traits::bounds(-1.0, 1.0)});
            strips.back().slope[k] = 1;
        }
        std::vector<strip> taken;
        std::vector<std::vector<double>> across; // orthonormal
        double left = 1;                         // of the volume
        while (taken.size() < n) {
            auto thinnest = thinnest_of(strips, across);
            if (thinnest.of == nullptr) return *this;
            taken.push_back(*thinnest.of);
            across.push_back(std::move(thinnest.across));
            left *= thinnest.thickness;
        }
        if (!(left < 0.9)) return *this;
        auto result = where_all_meet(taken);
        if (!result) return *this;
        result->volume = volume * left;
        return result;
    }

private:
    static constexpr double unit = std::numeric_limits<double>::epsilon();

    [[nodiscard]] static Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

    struct thin_strip {
        strip const* of = nullptr;
        std::vector<double> across; ///< of length 1
        double thickness = HUGE_VAL;
    };
    /// Of strips that are not spanned by the directions: the thinnest across to them.
    /// @param directions  orthonormal
    [[nodiscard]] static thin_strip
    thinnest_of(std::vector<strip> const& strips,
                std::vector<std::vector<double>> const& directions) {
        thin_strip thinnest;
        for (auto const& s : strips) {
            auto rest = s.slope;
            double const whole = norm(rest);
            for (auto const& q : directions) {
                double dot = 0;
                for (std::size_t k = 0; k < q.size(); ++k) dot += rest[k] * q[k];
                for (std::size_t k = 0; k < q.size(); ++k) rest[k] -= dot * q[k];
            }
            double const length = norm(rest);
            if (!(length > 1e-6 * whole)) continue;
            double const thickness = rad(s.range) / length;
            if (!(thickness < thinnest.thickness)) continue;
            for (auto& c : rest) c /= length;
            thinnest = {&s, std::move(rest), thickness};
        }
        return thinnest;
    }

    /// Covers the points of n strips \f$ R d \in ranges \f$ for d in \f$ [-1,1]^n \f$.
    ///   For y = R d and X near the inverse of R: d = X y - (X R - 1) d.
    /// @returns nothing where no such X is known
    [[nodiscard]] std::optional<parallelepiped>
    where_all_meet(std::vector<strip> const& strips) const {
        auto const n = size();
        Eigen::MatrixXd rows(index(n), index(n));
        for (std::size_t l = 0; l < n; ++l) {
            for (std::size_t k = 0; k < n; ++k) rows(index(l), index(k)) = strips[l].slope[k];
        }
        Eigen::MatrixXd const x = approximate_inverse(rows);
        parallelepiped result{middle, slack, side, volume};
        for (std::size_t k = 0; k < n; ++k) {
            double const error = row_error(x, rows, k);
            if (!(error < 1e-6)) return std::nullopt; // nor where it is no number
            for (std::size_t j = 0; j < n; ++j) {
                result.slack[j] += std::abs(side[k][j]) * error * (1 + 4 * unit);
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            double size = std::abs(middle[j]);
            for (std::size_t l = 0; l < n; ++l) {
                double sum = 0, terms = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    sum += side[k][j] * x(index(k), index(l));
                    terms += std::abs(side[k][j] * x(index(k), index(l)));
                }
                auto const& range = strips[l].range;
                double const centre = mid(range), reach = rad(range) * (1 + 4 * unit);
                result.middle[j] += sum * centre;
                result.side[l][j] = sum * reach;
                size += terms * (std::abs(centre) + reach);
            }
            result.slack[j] = result.slack[j] * (1 + 1e-14) +
                              16 * static_cast<double>(n + 2) * unit * size + 1e-300;
        }
        return result;
    }
    /// At least the sum of sizes in row k of X R - 1.
    [[nodiscard]] static double row_error(Eigen::MatrixXd const& x, Eigen::MatrixXd const& rows,
                                          std::size_t k) {
        auto error = traits::point(0.0);
        for (Eigen::Index l = 0; l < rows.cols(); ++l) {
            auto e = traits::point(index(k) == l ? -1.0 : 0.0);
            for (Eigen::Index i = 0; i < rows.rows(); ++i) {
                e = traits::add(
                    e, traits::mul(traits::point(x(index(k), i)), traits::point(rows(i, l))));
            }
            error = traits::add(error, traits::abs(e));
        }
        return error.upper();
    }

    [[nodiscard]] static double norm(std::vector<double> const& x) {
        double sum = 0;
        for (double const c : x) sum += c * c;
        return std::sqrt(sum);
    }
};

} // namespace sivid::paving_detail

#endif
