// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_FIT_HPP
#define SIVID_PAVING_FIT_HPP

#include <sivid/enclosure/simulate.hpp>
#include <sivid/paving/problem.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// A guess of parameters and initial states that explain the data. Nothing here is proved: a guess
/// becomes a witness only by a validated run.
struct approximate_fit {
    std::vector<double> parameters;
    std::vector<std::vector<double>> starts; ///< one initial state per experiment
    /// Per experiment and measurement (in order of time): (output - measured) / half-width of the
    /// bound.
    std::vector<std::vector<double>> residuals;
    /// Largest over the experiments of the (q+1)-th largest |residual|: at most 1 when all is
    /// explained.
    double inflation = std::numeric_limits<double>::infinity();
};

/// Minimises the inflation by Levenberg-Marquardt on weighted squares; the weights grow with the
/// residuals (p-norms) so that the largest ones fall, and the q largest of each experiment get
/// none. Derivatives by central differences of the simulation.
class fitter {
public:
    explicit fitter(identification_problem const& problem) : problem_(&problem) {
        for (auto const& s : problem.experiments) {
            flows_.push_back(std::make_unique<flow>(problem.model, problem.choice, s.inputs));
            simulators_.emplace_back(*flows_.back());
            records_.push_back(sorted(s.measurements));
            auto& times = times_.emplace_back();
            for (auto const& m : records_.back()) {
                if (times.empty() || times.back() < m.time) times.push_back(m.time);
            }
        }
        // Free variables: the parameters, then every initial state that is not a point.
        for (auto const& side : problem.prior) add_variable(side);
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
            auto const& x0 = problem.experiments[s].initial;
            for (std::size_t i = 0; i < x0.size(); ++i) {
                if (interval_traits<interval>::is_point(x0[i])) continue;
                free_starts_.push_back({s, i});
                add_variable(x0[i]);
            }
        }
    }

    /// From the centre of the prior and, when that fails, from a few points spread over it.
    [[nodiscard]] approximate_fit operator()() {
        approximate_fit best;
        for (std::size_t k = 0; k < 8 && best.inflation > 0.98; ++k) {
            // Two descents that end far away from an explanation say that there is none.
            if (k >= 2 && best.inflation > hopeless_inflation) break;
            auto fit = from(start_point(k));
            if (fit.inflation < best.inflation) best = std::move(fit);
        }
        return best;
    }

    /// From a point given for the parameters.
    [[nodiscard]] approximate_fit operator()(std::vector<double> const& parameters) {
        auto z = start_point(0);
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            z[static_cast<Eigen::Index>(j)] = parameters[j];
        }
        return from(clamped(z));
    }

private:
    struct start_variable {
        std::size_t experiment, state;
    };
    using vector = Eigen::VectorXd;

    static constexpr double hopeless_inflation = 4;

    void add_variable(interval const& side) {
        double const lo = side.lower();
        double const hi = side.upper();
        // Strictly within, so that the guess lies in the decimal prior and not only in its
        // enclosure.
        lower_.push_back(lo < hi ? std::nextafter(lo, hi) : lo);
        upper_.push_back(lo < hi ? std::nextafter(hi, lo) : hi);
    }
    [[nodiscard]] vector clamped(vector z) const {
        for (Eigen::Index i = 0; i < z.size(); ++i) {
            auto const k = static_cast<std::size_t>(i);
            z[i] = std::clamp(z[i], lower_[k], upper_[k]);
        }
        return z;
    }
    /// The centre, then points of a low-discrepancy sequence.
    [[nodiscard]] vector start_point(std::size_t k) const {
        vector z(static_cast<Eigen::Index>(lower_.size()));
        for (std::size_t i = 0; i < lower_.size(); ++i) {
            double const golden = std::fmod(
                0.5 + static_cast<double>(k) * std::sqrt(static_cast<double>(2 + 3 * i)), 1.0);
            z[static_cast<Eigen::Index>(i)] = lower_[i] + golden * (upper_[i] - lower_[i]);
        }
        return z;
    }

    /// Residuals of one experiment; false when its simulation fails.
    [[nodiscard]] bool residuals_of(std::size_t e, vector const& z, std::vector<double>& out) {
        approximate_trajectory run;
        try {
            run = simulators_[e](start_of(e, z), parameters(z), problem_->experiments[e].begin,
                                 times_[e]);
        } catch (std::exception const&) {
            return false;
        }
        out.clear();
        std::size_t row = 0;
        for (auto const& m : records_[e]) {
            while (times_[e][row] < m.time) ++row;
            double const size = std::max(rad(m.bound), std::numeric_limits<double>::min());
            double const r = (run.outputs[row][m.channel] - mid(m.bound)) / size;
            if (!std::isfinite(r)) return false;
            out.push_back(r);
        }
        return true;
    }
    [[nodiscard]] bool residuals(vector const& z, std::vector<std::vector<double>>& out) {
        out.resize(flows_.size());
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            if (!residuals_of(e, z, out[e])) return false;
        }
        return true;
    }
    [[nodiscard]] std::vector<double> parameters(vector const& z) const {
        auto const n = static_cast<Eigen::Index>(problem_->prior.size());
        return {z.data(), z.data() + n};
    }
    [[nodiscard]] std::vector<double> start_of(std::size_t e, vector const& z) const {
        auto x0 = mid(problem_->experiments[e].initial);
        for (std::size_t k = 0; k < free_starts_.size(); ++k) {
            if (free_starts_[k].experiment != e) continue;
            x0[free_starts_[k].state] = z[static_cast<Eigen::Index>(problem_->prior.size() + k)];
        }
        return x0;
    }
    [[nodiscard]] std::vector<std::vector<double>> starts(vector const& z) const {
        std::vector<std::vector<double>> x0;
        for (std::size_t e = 0; e < flows_.size(); ++e) x0.push_back(start_of(e, z));
        return x0;
    }
    /// The (q+1)-th largest |residual| of a experiment.
    [[nodiscard]] double experiment_inflation(std::vector<double> const& r, std::size_t q) const {
        std::vector<double> size;
        for (double const v : r) size.push_back(std::abs(v));
        if (q >= size.size()) return 0;
        std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(q), size.end(),
                         std::greater<>());
        return size[q];
    }
    [[nodiscard]] double inflation(std::vector<std::vector<double>> const& r) const {
        double worst = 0;
        for (std::size_t s = 0; s < r.size(); ++s) {
            worst = std::max(worst, experiment_inflation(r[s], problem_->experiments[s].outliers));
        }
        return worst;
    }
    /// sum w r^2 with w = |r / scale|^(power - 2), and nothing for the q largest of each
    /// experiment.
    [[nodiscard]] std::vector<double> weights(std::vector<std::vector<double>> const& r,
                                              double power) const {
        std::vector<double> w;
        double const scale = std::max(inflation(r), 1e-12);
        for (std::size_t s = 0; s < r.size(); ++s) {
            auto const q = problem_->experiments[s].outliers;
            double const limit =
                q > 0 ? experiment_inflation(r[s], q) : std::numeric_limits<double>::infinity();
            for (double const v : r[s]) {
                double const size = std::abs(v);
                w.push_back(size > limit ? 0.0 : std::pow(std::max(size / scale, 1e-3), power - 2));
            }
        }
        return w;
    }
    [[nodiscard]] static double cost(std::vector<std::vector<double>> const& r,
                                     std::vector<double> const& w) {
        double sum = 0;
        std::size_t k = 0;
        for (auto const& experiment : r) {
            for (double const v : experiment) sum += w[k++] * v * v;
        }
        return sum;
    }

    [[nodiscard]] approximate_fit from(vector z) {
        approximate_fit best;
        std::vector<std::vector<double>> r;
        if (!residuals(z, r)) return best;
        keep(best, z, r);
        for (double const power : {1.2, 2.0, 4.0, 8.0, 16.0, 32.0}) {
            descend(z, r, power, best);
            if (power >= 2 && best.inflation < 0.7) break;
        }
        return best;
    }
    void keep(approximate_fit& best, vector const& z,
              std::vector<std::vector<double>> const& r) const {
        double const now = inflation(r);
        if (!(now < best.inflation)) return;
        best = {parameters(z), starts(z), r, now};
    }
    void descend(vector& z, std::vector<std::vector<double>>& r, double power,
                 approximate_fit& best) {
        double damping = 1e-3;
        for (int round = 0; round < 25; ++round) {
            auto const w = weights(r, power);
            Eigen::MatrixXd normal;
            vector slope;
            if (!normal_equations(z, r, w, normal, slope)) return;
            double const before = cost(r, w);
            bool improved = false;
            for (int attempt = 0; attempt < 8 && !improved; ++attempt, damping *= 8) {
                Eigen::MatrixXd a = normal;
                a.diagonal() += damping * normal.diagonal().cwiseMax(1e-12);
                vector const step = a.ldlt().solve(slope);
                if (!step.allFinite()) continue;
                vector const trial = clamped(z - scaled(step));
                std::vector<std::vector<double>> next;
                if (!residuals(trial, next) || !(cost(next, w) < before)) continue;
                improved = true;
                double const gain = before - cost(next, w);
                z = trial;
                r = std::move(next);
                keep(best, z, r);
                damping /= 30;
                if (gain < 1e-6 * before) return;
            }
            if (!improved) return;
        }
    }
    /// Steps are in units of the variables' ranges.
    [[nodiscard]] double unit(std::size_t k) const {
        return std::max(upper_[k] - lower_[k], 1e-12);
    }
    [[nodiscard]] vector scaled(vector step) const {
        for (Eigen::Index i = 0; i < step.size(); ++i) step[i] *= unit(static_cast<std::size_t>(i));
        return step;
    }
    [[nodiscard]] bool normal_equations(vector const& z, std::vector<std::vector<double>> const& r,
                                        std::vector<double> const& w, Eigen::MatrixXd& normal,
                                        vector& slope) {
        auto const n = z.size();
        auto const rows = static_cast<Eigen::Index>(w.size());
        Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows, n);
        std::vector<double> up;
        std::vector<double> down;
        auto const parameters = static_cast<Eigen::Index>(problem_->prior.size());
        for (Eigen::Index c = 0; c < n; ++c) {
            auto const k = static_cast<std::size_t>(c);
            if (!(lower_[k] < upper_[k])) continue;
            vector high = z;
            vector low = z;
            double const d = 1e-5 * unit(k);
            high[c] = std::min(z[c] + d, upper_[k]);
            low[c] = std::max(z[c] - d, lower_[k]);
            if (!(high[c] > low[c])) return false;
            Eigen::Index row = 0;
            for (std::size_t e = 0; e < flows_.size(); ++e) {
                auto const count = static_cast<Eigen::Index>(records_[e].size());
                // A start moves its own experiment only.
                bool const moves =
                    c < parameters ||
                    free_starts_[static_cast<std::size_t>(c - parameters)].experiment == e;
                if (moves) {
                    if (!residuals_of(e, high, up) || !residuals_of(e, low, down)) return false;
                    for (Eigen::Index i = 0; i < count; ++i) {
                        auto const at = static_cast<std::size_t>(i);
                        j(row + i, c) = (up[at] - down[at]) / (high[c] - low[c]) * unit(k);
                    }
                }
                row += count;
            }
        }
        vector flat(rows);
        Eigen::Index row = 0;
        for (auto const& experiment : r) {
            for (double const v : experiment) flat[row++] = v;
        }
        vector const weight = Eigen::Map<vector const>(w.data(), rows);
        normal = j.transpose() * weight.asDiagonal() * j;
        slope = j.transpose() * (weight.array() * flat.array()).matrix();
        return normal.allFinite() && slope.allFinite();
    }

    identification_problem const* problem_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<approximate_simulator> simulators_;
    std::vector<record> records_;
    std::vector<std::vector<double>> times_;
    std::vector<start_variable> free_starts_;
    std::vector<double> lower_, upper_;
};

} // namespace sivid

#endif
