// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_FAR_TAILS_HPP
#define SIVID_MODEL_SERIES_DETAIL_FAR_TAILS_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

/// Functions that hardly change far from 0, however fast their argument does: a force of friction
/// while a body slides. For an argument \f$ A(s) \f$, a polynomial with
/// \f$ B \ge h^k |A^{[k]}| \f$ on [0, h] for each k >= 1, and \f$ f(A + w) = \sum_j c_j w^j \f$,
/// coefficient M of f(A(s)) times \f$ h^M \f$ is at most \f$ \sum_j |c_j| \binom{M-1}{j-1} B^j \f$:
/// so many ways M has of being a sum of j numbers. It bounds Lagrange's remainder.
namespace sivid::model_detail {

/// Makes computed products and sums of a few dozen non-negative numbers upper bounds.
inline constexpr double far_up = 1 + 1e-12;

/// An upper bound of \f$ e^x \f$.
[[nodiscard]] inline double exp_above(double x) {
    using traits = interval_traits<interval>;
    return traits::exp(traits::point(x)).upper();
}

/// exp: \f$ c_j \le e^A / j! \f$.
/// @param most   A is nowhere more
/// @param moves  B
[[nodiscard]] inline double far_exp_tail(double most, double moves, std::size_t order) {
    double term = moves, sum = moves;
    for (std::size_t j = 1; j < order; ++j) {
        term *= moves * static_cast<double>(order - j) / static_cast<double>(j * (j + 1));
        sum += term;
    }
    return exp_above(most) * sum * far_up;
}

/// tanh: for R below the distance L of A from 0, the function less its sign is at most
/// \f$ \tau = 2 / (e^{2(L-R)} - 1) \f$ on the disc of radius R about A, all of which lies on one
/// side of the imaginary axis. So \f$ |c_j| \le \tau R^{-j} \f$, and the sum is
/// \f$ \tau (B/R) (1 + B/R)^{M-1} \f$.
/// @param least  L, more than 1
/// @param moves  B
[[nodiscard]] inline double far_tanh_tail(double least, double moves, std::size_t order) {
    double best = std::numeric_limits<double>::infinity();
    for (double const part : {2.0, 4.0, 8.0, 16.0}) {
        double const radius = least / part;
        double const below = exp_above(-2 * (least - radius)); // less than 1/e
        double const ratio = moves / radius * far_up;
        double bound = 2 * below / (1 - below) * ratio;
        for (std::size_t k = 1; k < order; ++k) bound *= 1 + ratio;
        bound *= far_up;
        if (bound < best) best = bound;
    }
    return best;
}

/// What tanh changes at most where its argument does by 1: \f$ 1 - \tanh^2 x \le 4 e^{-2|x|} \f$.
/// @param least  |x| is nowhere less
[[nodiscard]] inline double steepest_tanh(double least) {
    return least > 1 ? std::min(1.0, 4 * exp_above(-2 * least) * far_up) : 1.0;
}

} // namespace sivid::model_detail

#endif
