// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_DETAIL_AFFINE_OUTPUT_HPP
#define SIVID_PAVING_RESPONSE_DETAIL_AFFINE_OUTPUT_HPP

#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/enclosure/observation.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sivid {

/// The table of 1 and the unknowns themselves.
[[nodiscard]] inline std::shared_ptr<monomial_table const> linear_table(std::size_t variables) {
    auto t = std::make_shared<monomial_table>();
    t->variables = variables;
    t->degree = 1;
    t->exponents.emplace_back(variables, std::uint8_t{0});
    for (std::size_t v = 0; v < variables; ++v) {
        t->exponents.emplace_back(variables, std::uint8_t{0});
        t->exponents.back()[v] = 1;
    }
    t->find_lines();
    return t;
}

/// What a set of first order says of an output, in the normalised unknowns.
/// @param deviation  \f$ r_0 = (x_0, p) - centre \f$ over the family
/// @guarantee  encloses the output for every member of the family
[[nodiscard]] inline output_polynomial affine_output(observation<interval> const& y,
                                                     normalised_unknowns const& unknowns,
                                                     box const& deviation) {
    using traits = interval_traits<interval>;
    // y = gradient . r + rest, r = radius * q; sides without a variable join the rest.
    output_polynomial result{std::vector<double>(unknowns.variables + 1, 0.0)};
    auto const n = unknowns.initial.size();
    auto rest = y.defined ? y.rest : traits::entire();
    for (std::size_t k = 0; k < y.gradient.size(); ++k) {
        auto const& side = k < n ? unknowns.initial[k] : unknowns.parameters[k - n];
        auto const g = traits::point(y.gradient[k]);
        if (side.radius == 0) {
            rest = traits::add(rest, traits::mul(g, deviation[k]));
            continue;
        }
        auto const exact = traits::mul(g, traits::point(side.radius));
        result.coefficients[1 + side.variable] = mid(exact);
        auto const lost = rad(exact);
        rest = traits::add(rest, traits::bounds(-lost, lost));
    }
    result.coefficients[0] = mid(rest);
    result.radius = rad(rest);
    return result;
}

} // namespace sivid

#endif
