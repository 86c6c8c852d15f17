// SPDX-License-Identifier: MIT
// The matrix exponential in 100 digits.
#ifndef SIVID_TESTS_SUPPORT_MATRIX_EXPONENTIAL_HPP
#define SIVID_TESTS_SUPPORT_MATRIX_EXPONENTIAL_HPP

#include "support/power_series.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace support {

using mp_matrix = std::vector<std::vector<mp>>;

inline mp_matrix times(mp_matrix const& a, mp_matrix const& b) {
    auto const n = a.size();
    mp_matrix c(n, std::vector<mp>(n, mp(0)));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t j = 0; j < n; ++j) c[i][j] += a[i][k] * b[k][j];
        }
    }
    return c;
}

/// \f$ e^{h A} \f$, by 60 terms at a norm of at most 1/4 and squaring.
inline mp_matrix exact_exponential(Eigen::MatrixXd const& a, mp const& h) {
    auto const n = static_cast<std::size_t>(a.rows());
    int squarings = 8;
    double const norm = a.cwiseAbs().rowwise().sum().maxCoeff() * h.convert_to<double>();
    while (std::ldexp(norm, -squarings) > 0.25) ++squarings;
    mp const scale = ldexp(h, -squarings);
    mp_matrix z(n, std::vector<mp>(n));
    mp_matrix sum(n, std::vector<mp>(n, mp(0)));
    for (std::size_t i = 0; i < n; ++i) {
        sum[i][i] = 1;
        for (std::size_t j = 0; j < n; ++j) {
            z[i][j] = scale * mp(a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        }
    }
    auto term = sum;
    for (int k = 1; k < 60; ++k) {
        term = times(term, z);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) sum[i][j] += (term[i][j] /= k);
        }
    }
    for (int k = 0; k < squarings; ++k) sum = times(sum, sum);
    return sum;
}

} // namespace support

#endif
