// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_CUT_CERTIFICATE_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_CUT_CERTIFICATE_HPP

#include <sivid/paving/contract/detail/inflation_certificate.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// What weighted measurements say of all unknowns that meet them.
struct measured_sum {
    combined_polynomial outputs; ///< \f$ start + \sum_i w_i y_i(d) \f$
    interval most{0.0};          ///< what it cannot exceed

    /// @param start  what the outputs are added to
    /// @given  measurements that are bounded in the direction of their weights
    measured_sum(response_list const& known, shared_unknowns const& unknowns,
                 std::vector<measurement_weight> const& weights, combined_polynomial start)
        : outputs(std::move(start)) {
        using traits = interval_traits<interval>;
        for (std::size_t s = 0; s < known.size(); ++s) {
            auto const& r = *known[s];
            std::vector<std::pair<std::size_t, double>> mine;
            for (auto const& w : weights) {
                if (w.experiment != s) continue;
                auto const& bound = r.bounds[w.output];
                double const end = w.value > 0 ? bound.upper() : bound.lower();
                most = traits::add(most, traits::mul(traits::point(w.value), traits::point(end)));
                mine.emplace_back(w.output, w.value);
            }
            if (!mine.empty()) outputs.add(r, mine, unknowns.places[s]);
        }
    }
};

/// Whether no unknown meets all weighted measurements.
/// @param planes  see `combined_polynomial::lower_bound`
/// @guarantee  for any weights
[[nodiscard]] inline bool
certified_empty(response_list const& known, shared_unknowns const& unknowns,
                std::vector<measurement_weight> const& weights,
                std::vector<combined_polynomial::plane> const& planes = {}) {
    measured_sum const sum(known, unknowns, weights, combined_polynomial(unknowns.count));
    return sum.outputs.lower_bound(planes) > upper(sum.most);
}

/// A number that \f$ d_j \f$ (or \f$ -d_j \f$) exceeds for no unknowns that meet all weighted
/// measurements; 1 when there is none below: \f$ d_j \le \sum_i w_i b_i - \min_d (\sum_i w_i y_i(d)
/// - d_j) \f$ with the ends b_i.
/// @guarantee  for any weights: bad ones prove little, never too much. Nonlinear terms of different
///   measurements cancel, remainders do not.
/// @cost  O(terms) interval operations for each weight
[[nodiscard]] inline double certified_reach(response_list const& known,
                                            shared_unknowns const& unknowns,
                                            std::vector<measurement_weight> const& weights,
                                            std::size_t j, bool upwards) {
    using traits = interval_traits<interval>;
    combined_polynomial start(unknowns.count);
    start.add_linear(j, traits::point(upwards ? -1.0 : 1.0));
    measured_sum const sum(known, unknowns, weights, std::move(start));
    double const least = sum.outputs.lower_bound();
    if (!std::isfinite(least)) return 1;
    double const reach = upper(traits::sub(sum.most, traits::point(least)));
    return reach < 1 ? reach : 1;
}

} // namespace sivid

#endif
