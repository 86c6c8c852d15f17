// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_WEIGHTED_CERTIFICATE_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_WEIGHTED_CERTIFICATE_HPP

#include <sivid/paving/response/combined_polynomial.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// The unknowns of several experiments over a part of their boxes, \f$ d \in [-1,1]^n \f$: first
/// the parameters, which all share, then the starts of each.
struct shared_unknowns {
    std::size_t count = 0;
    std::vector<std::vector<combined_polynomial::place>> places; ///< per response and variable

    /// @param part    inside the boxes of parameters that the responses were computed for (trusted)
    /// @param starts  inside those of their starts (trusted); none given: these
    shared_unknowns(response_list const& known, box const& part,
                    std::vector<box> const& starts = {})
        : count(part.size()) {
        for (std::size_t s = 0; s < known.size(); ++s) {
            auto const& of = known[s]->unknowns;
            auto& mine = places.emplace_back(known[s]->table->variables);
            for (std::size_t j = 0; j < part.size(); ++j) {
                auto const& side = of.parameters[j];
                if (side.radius > 0) mine[side.variable] = within(side, part[j], j);
            }
            for (std::size_t i = 0; i < of.initial.size(); ++i) {
                auto const& side = of.initial[i];
                if (!(side.radius > 0)) continue;
                auto& place = mine[side.variable];
                if (!starts.empty()) place = within(side, starts[s][i], 0);
                place.unknown = count++;
            }
        }
    }

private:
    /// mid + rad d = centre + radius q for a part of a side
    [[nodiscard]] static combined_polynomial::place
    within(normalised_unknowns::side const& side, interval const& part, std::size_t unknown) {
        using traits = interval_traits<interval>;
        bool undefined = false;
        auto const radius = traits::point(side.radius);
        auto const off = traits::sub(traits::point(mid(part)), traits::point(side.centre));
        return {unknown, traits::div(off, radius, undefined),
                traits::div(traits::point(rad(part)), radius, undefined)};
    }
};

/// A number that the largest misfit of the weighted measurements exceeds or meets everywhere,
///   \f$ \min_d \sum_i w_i (y_i(d) - m_i) / \sum_i |w_i| e_i \f$, or 0 when that is negative.
/// @guarantee  for any weights: bad ones prove little, never too much. Nonlinear terms of different
///   measurements cancel, remainders do not.
/// @given  bounded measurements
/// @cost  O(terms) interval operations for each weight
[[nodiscard]] inline double certified_inflation(response_list const& known,
                                                shared_unknowns const& unknowns,
                                                std::vector<measurement_weight> const& weights) {
    using traits = interval_traits<interval>;
    combined_polynomial sum(unknowns.count);
    auto size = traits::point(0.0);
    for (std::size_t s = 0; s < known.size(); ++s) {
        auto const& r = *known[s];
        std::vector<std::pair<std::size_t, double>> mine;
        for (auto const& w : weights) {
            if (w.experiment != s) continue;
            auto const half = traits::mul(traits::point(0.5), traits::point(w.value));
            auto const [lo, hi] = measured_ends(r.bounds[w.output]);
            sum.add_constant(traits::neg(traits::mul(half, traits::add(lo, hi))));
            size = traits::add(size, traits::abs(traits::mul(half, traits::sub(hi, lo))));
            mine.emplace_back(w.output, w.value);
        }
        if (!mine.empty()) sum.add(r, mine, unknowns.places[s]);
    }
    double const least = sum.lower_bound();
    if (!(least > 0)) return 0;
    if (!(upper(size) > 0)) return detail::greatest; // bounds of no width
    bool undefined = false;
    return std::max(
        0.0, lower(traits::div(traits::point(least), traits::point(upper(size)), undefined)));
}

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

    /// What it cannot exceed, less what the outputs are at least; infinite where they have no
    /// least.
    /// @param planes  see `combined_polynomial::lower_bound`
    [[nodiscard]] double reach(std::vector<combined_polynomial::plane> const& planes = {}) const {
        using traits = interval_traits<interval>;
        double const least = outputs.lower_bound(planes);
        if (!std::isfinite(least)) return detail::infinity;
        return upper(traits::sub(most, traits::point(least)));
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
    double const reach = sum.reach();
    return reach < 1 ? reach : 1;
}

} // namespace sivid

#endif
