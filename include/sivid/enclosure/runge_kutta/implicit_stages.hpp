// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_STAGES_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_STAGES_HPP

#include <sivid/enclosure/runge_kutta/detail/implicit_stages_class.hpp>
#include <sivid/space/dense.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

template <class T>
auto implicit_stages<T>::apply(double t, vector const& x, T const& step, vector const& k)
    -> std::optional<vector> {
    auto const n = flow_->states();
    vector result;
    for (std::size_t i = 0; i < stages_; ++i) {
        auto const time = time_of(t, i, step);
        input_pieces<T> const input(*flow_, t, time);
        auto& rate = rates_[i];
        rate.start(time, c_[i]);
        rate.advance(
            0, [&](std::size_t s, std::size_t) { return argument(i, s, x, step, k); }, input);
        if (rate.undefined() || rate.jumped()) return std::nullopt;
        for (std::size_t s = 0; s < n; ++s) result.push_back(rate.output(s, 0));
    }
    return result;
}

template <class T>
bool implicit_stages<T>::differentiate(double t, vector const& x, T const& step, vector const& k,
                                       vector& jacobian) {
    jacobian.clear();
    for (std::size_t i = 0; i < stages_; ++i) {
        auto const time = time_of(t, i, step);
        input_pieces<T> const input(*flow_, t, time);
        derivatives_.start(time);
        derivatives_.advance(
            0, [&](std::size_t s, std::size_t) { return argument(i, s, x, step, k); }, input);
        if (derivatives_.undefined() || derivatives_.jumped()) return false;
        for (auto const& e : flow_->entries()) {
            jacobian.push_back(derivatives_.output(e.output, 0));
        }
    }
    return true;
}

template <class T>
auto implicit_stages<T>::matrix_times(T const& step, vector const& jacobian, vector const& z) const
    -> vector {
    auto const n = flow_->states();
    auto const entries = flow_->entries().size();
    std::vector<typename arithmetic::accumulator> sums(size());
    for (std::size_t i = 0; i < stages_; ++i) {
        vector inner; // \sum_l a_{il} z_l
        for (std::size_t s = 0; s < n; ++s) {
            typename arithmetic::accumulator sum;
            for (std::size_t l = 0; l < stages_; ++l) {
                sum.add_product(a_[i * stages_ + l], z[l * n + s]);
            }
            inner.push_back(arithmetic::mul(step, sum.result()));
        }
        for (std::size_t e = 0; e < entries; ++e) {
            auto const& entry = flow_->entries()[e];
            if (entry.column >= n) continue;
            sums[i * n + entry.row].add_product(jacobian[i * entries + e], inner[entry.column]);
        }
    }
    vector result;
    for (std::size_t i = 0; i < size(); ++i) {
        result.push_back(arithmetic::sub(z[i], sums[i].result()));
    }
    return result;
}

template <class T>
Eigen::MatrixXd implicit_stages<T>::approximate_inverse(T const& step,
                                                        vector const& jacobian) const {
    auto const n = flow_->states();
    auto const entries = flow_->entries().size();
    auto const m = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(m, m);
    double const h = set::approximate(step);
    for (std::size_t i = 0; i < stages_; ++i) {
        for (std::size_t l = 0; l < stages_; ++l) {
            double const factor = h * set::approximate(a_[i * stages_ + l]);
            for (std::size_t e = 0; e < entries; ++e) {
                auto const& entry = flow_->entries()[e];
                if (entry.column >= n) continue;
                matrix(static_cast<Eigen::Index>(i * n + entry.row),
                       static_cast<Eigen::Index>(l * n + entry.column)) -=
                    factor * set::approximate(jacobian[i * entries + e]);
            }
        }
    }
    return sivid::approximate_inverse(matrix);
}

template <class T>
Eigen::MatrixXd implicit_stages<T>::contraction(T const& step, vector const& jacobian,
                                                Eigen::MatrixXd const& inverse) const {
    auto const m = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd result(m, m);
    for (Eigen::Index c = 0; c < m; ++c) {
        vector unit(size(), arithmetic::point(0.0));
        unit[static_cast<std::size_t>(c)] = arithmetic::point(1.0);
        auto column = times(inverse, matrix_times(step, jacobian, unit));
        auto& diagonal = column[static_cast<std::size_t>(c)];
        diagonal = arithmetic::sub(diagonal, arithmetic::point(1.0));
        result.col(c) = sizes(column);
    }
    return result;
}

template <class T>
auto implicit_stages<T>::times(Eigen::MatrixXd const& y, vector const& v) -> vector {
    vector result;
    for (Eigen::Index i = 0; i < y.rows(); ++i) {
        typename arithmetic::accumulator sum;
        for (Eigen::Index j = 0; j < y.cols(); ++j) {
            if (y(i, j) == 0) continue;
            sum.add_product(arithmetic::point(y(i, j)), v[static_cast<std::size_t>(j)]);
        }
        result.push_back(sum.result());
    }
    return result;
}

template <class T>
auto implicit_stages<T>::approximate(double t, vector const& x, T const& step,
                                     Eigen::MatrixXd& inverse) -> std::optional<vector> {
    auto const n = flow_->states();
    // At step 0 all stages are f(t, x).
    auto const first = apply(t, x, arithmetic::point(0.0), vector(size(), arithmetic::point(0.0)));
    if (!first) return std::nullopt;
    vector k;
    for (auto const& value : *first) k.push_back(set::core(value));
    vector base(n);
    for (std::size_t s = 0; s < n; ++s) base[s] = set::core(x[s]);
    auto const h = set::core(step);
    double before = std::numeric_limits<double>::infinity();
    vector jacobian;
    for (int round = 0; round < 20; ++round) {
        if (round < 4) {
            if (!differentiate(t, base, h, k, jacobian)) return std::nullopt;
            inverse = approximate_inverse(h, jacobian);
            if (!inverse.allFinite()) return std::nullopt;
        }
        auto const image = apply(t, base, h, k);
        if (!image) return std::nullopt;
        vector residual;
        for (std::size_t i = 0; i < k.size(); ++i) {
            residual.push_back(arithmetic::sub(k[i], (*image)[i]));
        }
        auto const change = times(inverse, residual);
        double norm = 0; // as a share of the largest stage of the same state
        for (std::size_t s = 0; s < n; ++s) {
            double most = 0, size = 0;
            for (std::size_t i = s; i < k.size(); i += n) {
                most = std::max(most, set::size(set::core(change[i])));
                size = std::max(size, set::size(k[i]));
            }
            if (most > 0) norm = std::max(norm, most / std::max(size, most));
        }
        if (!std::isfinite(norm)) return std::nullopt;
        if (round > 1 && norm >= 0.5 * before) break;
        for (std::size_t i = 0; i < k.size(); ++i) {
            k[i] = set::core(arithmetic::sub(k[i], set::core(change[i])));
        }
        before = norm;
    }
    return k;
}

template <class T>
auto implicit_stages<T>::prove(double t, vector const& x, T const& step,
                               std::vector<vector> const& seeds) -> std::optional<stage_set<T>> {
    stage_set<T> result;
    auto centre = approximate(t, x, step, result.inverse);
    if (!centre) return std::nullopt;
    result.centre = std::move(*centre);
    auto const image = apply(t, x, step, result.centre);
    if (!image) return std::nullopt;
    vector residual;
    for (std::size_t i = 0; i < size(); ++i) {
        residual.push_back(arithmetic::sub(result.centre[i], (*image)[i]));
    }
    auto const change = times(result.inverse, residual);
    auto const distance = sizes(change);
    Eigen::VectorXd radius = 1.1 * distance;
    for (std::size_t i = 0; i < size(); ++i) {
        auto& r = radius[static_cast<Eigen::Index>(i)];
        r += 1e-14 * set::size(result.centre[i]) + tiny;
        for (auto const& seed : seeds) {
            r = std::max(r, 1.01 * set::size(arithmetic::sub(seed[i], result.centre[i])) + tiny);
        }
    }
    for (int round = 0; round < 8; ++round) {
        if (!radius.allFinite()) return std::nullopt;
        vector region;
        for (std::size_t i = 0; i < size(); ++i) {
            region.push_back(set::widened(result.centre[i], radius[static_cast<Eigen::Index>(i)]));
        }
        if (!differentiate(t, x, step, region, result.jacobian)) return std::nullopt;
        result.contraction = contraction(step, result.jacobian, result.inverse);
        Eigen::VectorXd near = (result.contraction * radius) * up;
        Eigen::VectorXd inside = (distance + near) * up;
        inside.array() += tiny;
        if (!inside.allFinite()) return std::nullopt;
        if ((inside.array() < radius.array()).all()) {
            result.radius.assign(radius.data(), radius.data() + radius.size());
            // The same bound again: the zero is at most `inside` away from the centre.
            for (int again = 0; again < 3; ++again) {
                near = (result.contraction * inside) * up;
                inside = ((distance + near) * up).cwiseMin(inside);
            }
            for (std::size_t i = 0; i < size(); ++i) {
                result.value.push_back(set::widened(arithmetic::sub(result.centre[i], change[i]),
                                                    near[static_cast<Eigen::Index>(i)] + tiny));
            }
            return result;
        }
        // Only where it was too small: else all grow together, and none ever holds its image. What
        // acts through a chain of states arrives one state further each time.
        for (std::size_t state = 0; state < flow_->states(); ++state) {
            if ((inside.array() < radius.array()).all()) break;
            radius = (inside.array() < radius.array()).select(radius, 1.2 * inside);
            inside = (distance + result.contraction * radius) * up;
            inside.array() += tiny;
        }
    }
    return std::nullopt;
}

template <class T>
auto implicit_stages<T>::solve(T const& step, stage_set<T> const& stages, vector const& right) const
    -> vector {
    vector middle;
    for (auto const& r : right) middle.push_back(set::core(r));
    auto guess = times(stages.inverse, middle);
    for (auto& z : guess) z = set::core(z);
    auto residual = matrix_times(step, stages.jacobian, guess);
    for (std::size_t i = 0; i < size(); ++i) {
        residual[i] = arithmetic::sub(right[i], residual[i]);
    }
    // z - guess = change + (1 - Y M) (z - guess), and with E radius < radius the bound
    // |z - guess| <= theta radius holds as soon as |change| <= theta (radius - E radius).
    auto const change = times(stages.inverse, residual);
    auto const distance = sizes(change);
    auto const radius = Eigen::Map<Eigen::VectorXd const>(
        stages.radius.data(), static_cast<Eigen::Index>(stages.radius.size()));
    Eigen::VectorXd const used = (stages.contraction * radius) * up;
    double theta = 0;
    for (Eigen::Index i = 0; i < radius.size(); ++i) {
        double const room = (radius[i] - used[i]) / up;
        theta = std::max(theta, room > 0 ? distance[i] / room * up : HUGE_VAL);
    }
    Eigen::VectorXd off = theta * up * radius;
    off.array() += tiny;
    Eigen::VectorXd near = off;
    for (int round = 0; round < 4; ++round) {
        near = (stages.contraction * off) * up;
        near.array() += tiny;
        off = ((distance + near) * up).cwiseMin(off);
    }
    vector result;
    for (std::size_t i = 0; i < size(); ++i) {
        auto const z = arithmetic::add(guess[i], change[i]);
        double const w = near[static_cast<Eigen::Index>(i)];
        result.push_back(set::widened(z, w >= 0 ? w : HUGE_VAL)); // NaN: nothing is known
    }
    return result;
}

template <class T>
auto implicit_stages<T>::expand(double t, vector const& x, T const& step,
                                stage_set<T> const& stages, std::size_t order)
    -> std::optional<std::vector<vector>> {
    auto const n = flow_->states();
    auto const zero = arithmetic::point(0.0);
    std::vector<vector> k{stages.value};
    std::vector<T> times_of;
    std::vector<input_pieces<T>> pieces;
    for (std::size_t i = 0; i < stages_; ++i) {
        times_of.push_back(time_of(t, i, step));
        pieces.emplace_back(*flow_, t, times_of.back());
        rates_[i].start(times_of[i], c_[i]);
    }
    // Coefficient j of the argument x + (step + tau) \sum_l a_{il} k_l.
    auto const advance = [&](std::size_t i, std::size_t j) {
        rates_[i].advance(
            j,
            [&](std::size_t s, std::size_t) {
                if (j == 0) return argument(i, s, x, step, k[0]);
                typename arithmetic::accumulator now;
                typename arithmetic::accumulator before;
                for (std::size_t l = 0; l < stages_; ++l) {
                    now.add_product(a_[i * stages_ + l], k[j][l * n + s]);
                    before.add_product(a_[i * stages_ + l], k[j - 1][l * n + s]);
                }
                return arithmetic::add(arithmetic::mul(step, now.result()), before.result());
            },
            [&](std::size_t u, std::size_t) {
                return j == 1 ? arithmetic::mul(c_[i], pieces[i](u, 1)) : pieces[i](u, j);
            });
        return !rates_[i].undefined() && !rates_[i].kinked() && !rates_[i].jumped();
    };
    for (std::size_t i = 0; i < stages_; ++i) {
        if (!advance(i, 0)) return std::nullopt;
    }
    for (std::size_t j = 1; j <= order; ++j) {
        k.emplace_back(size(), zero);
        vector right;
        for (std::size_t i = 0; i < stages_; ++i) {
            if (!advance(i, j)) return std::nullopt;
            for (std::size_t s = 0; s < n; ++s) {
                right.push_back(flow_->rate().output_varies(s) ? rates_[i].output(s, j) : zero);
            }
        }
        k[j] = solve(step, stages, right);
        if (j == order) break;
        for (std::size_t i = 0; i < stages_; ++i) {
            if (!advance(i, j)) return std::nullopt;
        }
    }
    return k;
}

} // namespace sivid

#endif
