// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_MISFIT_BLOCK_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_MISFIT_BLOCK_HPP

#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/space/linear_program/constraint_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// The misfits \f$ (y - m) / e \f$ of an experiment as affine functions of unknowns in [-1, 1]:
/// what is left of a response over a part of its box.
struct misfit_block {
    minimax_block functions;   ///< margin: what the rest of the response may add, and `allowed`
    std::vector<double> scale; ///< 1 / e; 0 where bounds are infinite
};

/// @param places   of the response's variables among the unknowns
/// @param allowed  size of a misfit that costs nothing
/// @param counts   (measurement) -> whether it takes part; those with infinite bounds or rests
/// never
///   do, their functions are 0 with an infinite margin
/// @guarantee  none: doubles, for programs that propose weights
template <class Counts>
[[nodiscard]] misfit_block misfits_of(response const& r, local_response const& local,
                                      std::vector<combined_polynomial::place> const& places,
                                      double allowed, Counts const& counts) {
    auto const count = r.outputs();
    misfit_block result;
    auto& f = result.functions;
    for (auto const& p : places) f.variable.push_back(p.unknown);
    f.slope = local.slope;
    f.offset.assign(count, 0.0);
    f.margin.assign(count, std::numeric_limits<double>::infinity());
    result.scale.assign(count, 0.0);
    for (std::size_t y = 0; y < count; ++y) {
        double const e = 0.5 * width(r.bounds[y]);
        double const scale = std::isfinite(e) ? 1 / std::max(e, 1e-100) : 0;
        result.scale[y] = scale;
        bool const of_use = counts(y) && scale > 0 && std::isfinite(local.rest[y]);
        for (std::size_t v = 0; v < places.size(); ++v) {
            auto& slope = f.slope[v * count + y];
            slope = of_use ? slope * scale : 0;
        }
        if (!of_use) continue;
        f.offset[y] = (local.value[y] - mid(r.bounds[y])) * scale;
        f.margin[y] = allowed + local.rest[y] * scale;
    }
    return result;
}

} // namespace sivid

#endif
