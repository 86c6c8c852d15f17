// SPDX-License-Identifier: MIT
// A response of random polynomials, whose values are known exactly.
#ifndef SIVID_TESTS_SUPPORT_RANDOM_RESPONSE_HPP
#define SIVID_TESTS_SUPPORT_RANDOM_RESPONSE_HPP

#include "support/models.hpp"
#include "support/random.hpp"
#include "support/taylor_models.hpp"

#include <sivid/paving/response/response.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace support {

/// Sides that are points have no variable.
template <std::size_t variables, std::size_t degree>
struct random_response {
    box initial, prior;
    sivid::response known;

    /// @param curvature  size of the coefficients beyond the affine part, whose size is 1
    /// @param radius     half of the outputs are known to so much only
    random_response(draws& d, box starts, box parameters, std::size_t outputs, double curvature,
                    double radius)
        : initial(std::move(starts)),
          prior(std::move(parameters)),
          known{sivid::normalised_unknowns(initial, prior),
                std::make_shared<sivid::monomial_table const>(sivid::monomial_table::of(
                    sivid::monomial_space::of(variables, degree), variables)),
                {},
                {},
                {},
                {},
                outputs,
                0} {
        auto const& table = *known.table;
        known.coefficients.assign(table.size() * outputs, 0.0);
        for (std::size_t m = 0; m < table.size(); ++m) {
            std::size_t total = 0;
            for (auto const e : table.exponents[m]) total += e;
            double const size = total <= 1 ? 1 : curvature;
            for (std::size_t y = 0; y < outputs; ++y) {
                known.coefficients[m * outputs + y] = d.uniform(-size, size);
            }
        }
        for (std::size_t y = 0; y < outputs; ++y) {
            known.radius.push_back(d.coin() ? 0 : d.uniform(0, radius));
        }
    }

    [[nodiscard]] std::size_t outputs() const { return known.radius.size(); }

    /// The polynomial of an output at normalised coordinates, exactly.
    [[nodiscard]] rational value(std::size_t y, std::vector<rational> const& q) const {
        rational sum = 0;
        auto const& table = *known.table;
        for (std::size_t m = 0; m < table.size(); ++m) {
            rational term(known.coefficients[m * outputs() + y]);
            for (std::size_t v = 0; v < q.size(); ++v) {
                for (std::size_t k = 0; k < table.exponents[m][v]; ++k) term *= q[v];
            }
            sum += term;
        }
        return sum;
    }
};

} // namespace support

#endif
