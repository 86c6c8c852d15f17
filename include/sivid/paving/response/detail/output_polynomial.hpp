// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_DETAIL_OUTPUT_POLYNOMIAL_HPP
#define SIVID_PAVING_RESPONSE_DETAIL_OUTPUT_POLYNOMIAL_HPP

#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// An output of a family of trajectories at one time as a polynomial in the family's normalised
/// unknowns, \f$ y \in \sum_\alpha c_\alpha q^\alpha \pm radius \f$, by the monomials of a table.
struct output_polynomial {
    std::vector<double> coefficients;
    double radius = 0;

    /// The size of all that is not constant.
    [[nodiscard]] double spread() const {
        double sum = 0;
        for (std::size_t m = 1; m < coefficients.size(); ++m) sum += std::abs(coefficients[m]);
        return sum;
    }
};

} // namespace sivid

#endif
