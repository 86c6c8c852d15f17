// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONFIDENCE_SIGN_PERTURBED_SUMS_HPP
#define SIVID_PAVING_CONFIDENCE_SIGN_PERTURBED_SUMS_HPP

#include <sivid/paving/verdict.hpp>
#include <sivid/work_clock.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// Random numbers that are the same on every machine, and in every language by three lines:
/// splitmix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014).
class sign_source {
public:
    explicit sign_source(std::uint64_t seed) : state_(seed) {}
    std::uint64_t operator()() {
        auto z = state_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }

private:
    std::uint64_t state_;
};

/// Outputs over a box as affine functions of \f$ d \in [-1,1]^n \f$: row i of `forms` is a
/// constant, then n slopes; what is not affine stays below rest[i].
struct output_forms {
    Eigen::MatrixXd forms;
    Eigen::VectorXd rest;
    Eigen::VectorXd radius; ///< what of `rest` only a new enclosure would narrow
};

/// What the sums say of a box. Column j of `sum` encloses \f$ S_{0j} \f$ with rest[j], as `forms`.
struct rank_verdict {
    box_verdict verdict = box_verdict::undecided;
    Eigen::MatrixXd sum;
    Eigen::VectorXd rest;
    double reach = 0; ///< |S_0| is at most so large where the box meets the region
    double blur = 0;  ///< the largest share of `radius` in the spread of a component
};

/// The sums \f$ S_k(p) = \sum_i \alpha_{ki} w_i (y_i - \hat y_i(p)) \f$, k = 0 ... m-1, with
/// \f$ \alpha_0 = 1 \f$ and random signs else, for vectors w_i that no measured value \f$ y_i \f$
/// chose. The region: all p for which at least `above` of the other norms \f$ |S_k(p)| \f$ are
/// larger than \f$ |S_0(p)| \f$, equal ones as a random order drawn with the signs has them.
///   Where the errors \f$ y_i - \hat y_i(p^*) \f$ are independent and symmetric about zero, the m
/// norms at the truth p* are, given the errors' sizes, independent and alike. So \f$ |S_0| \f$ has
/// each rank with one probability, and p* is in the region with probability 1 - above / m exactly,
/// over errors and signs.
///   Draws: for k = 0 ... m-1 the place of S_k among equals; then for k = 1 ... m-1 and each i a
/// sign, minus where the top bit is set.
/// @ref  B. Csaji, M. Campi, E. Weyer, IEEE Trans. Signal Processing 63 (2015) 169
class sign_perturbed_sums {
public:
    /// @param weights  a row w_i for each measurement
    /// @given  0 < above < sums
    sign_perturbed_sums(Eigen::VectorXd measured, Eigen::MatrixXd weights, std::uint64_t seed,
                        std::size_t sums, std::size_t above)
        : measured_(std::move(measured)), weights_(std::move(weights)), above_(above) {
        sign_source draw(seed);
        auto const own = draw();
        for (std::size_t k = 1; k < sums; ++k) wins_.push_back(draw() > own);
        minus_.resize(measured_.size(), static_cast<Eigen::Index>(sums - 1));
        for (Eigen::Index k = 0; k < minus_.cols(); ++k)
            for (Eigen::Index i = 0; i < minus_.rows(); ++i) minus_(i, k) = draw() >> 63U ? 1 : 0;
    }

    /// @guarantee  inside: all of the box is in the region; outside: nothing is. Rounding is
    ///             included, to nearest (`guard.hpp`)
    /// @cost  O(m (N r n + r n^2)) for N measurements, r components, n unknowns
    [[nodiscard]] rank_verdict operator()(output_forms const& y) const {
        auto const n = y.forms.cols(), r = weights_.cols(), count = measured_.size();
        Eigen::MatrixXd residuals = -y.forms, terms(n * r, count);
        residuals.col(0) += measured_;
        for (Eigen::Index j = 0; j < r; ++j)
            terms.middleRows(j * n, n) = residuals.transpose() * weights_.col(j).asDiagonal();
        rank_verdict result;
        result.sum = terms.rowwise().sum().reshaped(n, r);
        // Lost to remainders and rounding, at most, whatever the signs.
        Eigen::VectorXd const sizes = measured_.cwiseAbs() + y.forms.cwiseAbs().rowwise().sum();
        double const errors = 2 * unit * static_cast<double>(count + n + 8);
        result.rest = weights_.cwiseAbs().transpose() * (y.rest + errors * sizes) * (1 + 1e-10);
        result.rest.array() += 1e-290;
        Eigen::ArrayXd const blurred = weights_.cwiseAbs().transpose() * y.radius;
        Eigen::ArrayXd const spread = result.sum.bottomRows(n - 1).cwiseAbs().colwise().sum();
        result.blur = (blurred / (blurred + spread + 1e-290)).maxCoeff();
        Eigen::MatrixXd const minus = terms * minus_;
        work_clock::count(static_cast<std::size_t>(minus.cols() * n * r * (count + n)), 0.04);
        std::size_t certain = 0, possible = 0;
        std::vector<double> most;
        Eigen::Array<bool, Eigen::Dynamic, 1> const counted =
            weights_.cwiseAbs().rowwise().sum().array() > 0;
        for (Eigen::Index k = 0; k < minus.cols(); ++k) {
            auto const own = counted.select(minus_.col(k).array(), 0.0).sum();
            if (own == 0 || own == static_cast<double>(counted.count())) { // S_k = +-S_0 everywhere
                bool const wins = wins_[static_cast<std::size_t>(k)];
                certain += wins ? 1 : 0;
                possible += wins ? 1 : 0;
                most.push_back(wins ? HUGE_VAL : -1);
                continue;
            }
            auto const m = minus.col(k).reshaped(n, r);
            auto const [low, high] = product(m, result.sum - m, result.rest);
            certain += high < 0 ? 1 : 0;
            possible += low > 0 ? 0 : 1;
            auto const sizes_k = (result.sum - 2 * m).cwiseAbs().colwise().sum().transpose();
            double const square = (sizes_k + result.rest).squaredNorm() * (1 + 1e-10);
            most.push_back(std::isfinite(square) ? square : HUGE_VAL);
        }
        if (certain >= above_) result.verdict = box_verdict::inside;
        if (possible < above_) result.verdict = box_verdict::outside;
        auto const last = most.begin() + static_cast<std::ptrdiff_t>(above_ - 1);
        std::nth_element(most.begin(), last, most.end(), std::greater<>());
        result.reach = std::sqrt(std::max(*last, 0.0)) * (1 + 1e-14);
        return result;
    }

private:
    static constexpr double unit = 0x1p-52;

    /// Bounds \f$ M \cdot P = (|S_0|^2 - |S_k|^2) / 4 \f$ as one polynomial of second degree, M the
    /// sum of the terms with a minus, P that of the others. Compares false where unbounded.
    static std::pair<double, double> product(Eigen::MatrixXd const& m, Eigen::MatrixXd const& p,
                                             Eigen::VectorXd const& rest) {
        Eigen::VectorXd const size_m = m.cwiseAbs().colwise().sum();
        Eigen::VectorXd const size_p = p.cwiseAbs().colwise().sum();
        double const roundings = static_cast<double>(4 * m.cols() + 4 * m.rows() * m.rows() + 32);
        double const error = rest.dot(size_m + size_p + rest) * (1 + 1e-10) +
                             unit * roundings * size_m.dot(size_p) + 1e-290;
        Eigen::MatrixXd const products = m * p.transpose();
        double low = products(0, 0) - error, high = products(0, 0) + error;
        for (Eigen::Index v = 1; v < m.rows(); ++v) {
            double const slope = std::abs(products(0, v) + products(v, 0));
            low += least_of_parabola(slope, products(v, v));
            high -= least_of_parabola(slope, -products(v, v));
            for (Eigen::Index w = 1; w < v; ++w) {
                double const mixed = std::abs(products(v, w) + products(w, v));
                low -= mixed;
                high += mixed;
            }
        }
        return {low, high};
    }
    /// Of \f$ b d^2 - a |d| \f$ for \f$ |d| \le 1 \f$, a >= 0.
    static double least_of_parabola(double a, double b) {
        return a < 2 * b ? -a * (a / (4 * b)) : b - a;
    }

    Eigen::VectorXd measured_;
    Eigen::MatrixXd weights_, minus_; ///< minus_(i, k): 1 where the sign of S_(k+1) is minus
    std::size_t above_;
    std::vector<bool> wins_; ///< S_(k+1) over S_0, where they are equal
};

} // namespace sivid

#endif
