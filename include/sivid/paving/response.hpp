// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_HPP
#define SIVID_PAVING_RESPONSE_HPP

#include <sivid/paving/linear_contraction.hpp>
#include <sivid/paving/relaxed_intersection.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// One measured output over a box of parameters and starts, as an affine function of the deviations
/// from a centre: \f$ y \in gradient \cdot r + rest \f$, and \f$ y \in value \f$.
struct affine_output {
    std::vector<double> gradient; ///< by initial state, then by parameter
    interval rest;
    interval value;
    interval bound; ///< the measurement
};

/// What one experiment answers, for all parameters in a box: the outputs at the measurements that
/// were reached. It stays valid, and gets sharper, on every part of the box.
struct response {
    box start_deviation; ///< of the initial state from its centre
    std::vector<double> parameter_centre;
    std::vector<affine_output> outputs; ///< the measurements that were reached, in their order
    std::size_t measurements = 0;       ///< all of the experiment
    std::size_t allowed = 0;            ///< outliers

    /// \f$ r = (x_0, p) - centre \f$ over a box of parameters.
    [[nodiscard]] box deviation(box const& parameters) const {
        using traits = interval_traits<interval>;
        auto const n = start_deviation.size();
        box r(n + parameters.size());
        for (std::size_t i = 0; i < n; ++i) r[i] = start_deviation[i];
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            r[n + j] = traits::sub(parameters[j], traits::point(parameter_centre[j]));
        }
        return r;
    }
};

/// Encloses an output over deviations r.
[[nodiscard]] inline interval over(affine_output const& y, box const& r) {
    using traits = interval_traits<interval>;
    auto sum = y.rest;
    for (std::size_t j = 0; j < r.size(); ++j) {
        if (y.gradient[j] == 0) continue;
        sum = traits::add(sum, traits::mul(traits::point(y.gradient[j]), r[j]));
    }
    return traits::intersect(sum, y.value);
}

/// What a response says of a part of its box.
struct response_verdict {
    std::size_t held = 0;
    std::size_t failed = 0;
    bool refuted = false;      ///< no parameter in the part is feasible
    bool explained = false;    ///< at least n - q measurements hold for all of the part
    double sharpness = 0;      ///< largest share of an undecided output's width that is not affine
    std::vector<double> smear; ///< per parameter
};

/// Tests a box of parameters on a response, and contracts it.
/// @guarantee  no feasible parameter is removed: a point that more than q measurements exclude,
/// each
///             on its own, is infeasible whatever the start
[[nodiscard]] inline response_verdict assess(response const& known, box& parameters) {
    using traits = interval_traits<interval>;
    response_verdict result;
    result.smear.assign(parameters.size(), 0.0);
    auto const n = known.start_deviation.size();
    auto r = known.deviation(parameters);
    std::vector<linear_constraint> open;
    for (auto const& y : known.outputs) {
        auto const value = over(y, r);
        if (traits::is_empty(value) || traits::disjoint(value, y.bound)) {
            if (++result.failed > known.allowed) {
                result.refuted = true;
                return result;
            }
            continue;
        }
        if (traits::subset(value, y.bound)) {
            ++result.held;
            continue;
        }
        double const total = width(value);
        if (total > 0) result.sharpness = std::max(result.sharpness, width(y.rest) / total);
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            result.smear[j] += std::abs(y.gradient[n + j]) * width(r[n + j]) / width(y.bound);
        }
        open.push_back({y.gradient, traits::sub(y.bound, y.rest)});
    }
    result.explained = result.held + known.allowed >= known.measurements;
    if (result.explained || open.empty()) return result;
    // Measurements that certainly fail have used up a part of the budget.
    std::size_t const q = known.allowed - result.failed;
    bool left = true;
    if (q == 0) {
        left = contract(r, open);
    } else {
        for (int pass = 0; pass < 3 && left && open.size() > q; ++pass) {
            std::vector<std::vector<interval>> sides(r.size());
            std::size_t excluded = 0;
            for (auto const& row : open) {
                auto mine = r;
                if (contract(mine, row)) {
                    for (std::size_t j = 0; j < r.size(); ++j) sides[j].push_back(mine[j]);
                } else {
                    ++excluded;
                }
            }
            left = excluded <= q;
            auto const before = r;
            for (std::size_t j = 0; left && j < r.size(); ++j) {
                r[j] = traits::intersect(r[j], relaxed_intersection(sides[j], q - excluded));
                left = !traits::is_empty(r[j]);
            }
            bool moved = false;
            for (std::size_t j = 0; j < r.size(); ++j) {
                moved = moved || width(r[j]) < 0.95 * width(before[j]);
            }
            if (!moved) break;
        }
    }
    if (!left) {
        result.refuted = true;
        return result;
    }
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        auto const p = traits::add(traits::point(known.parameter_centre[j]), r[n + j]);
        parameters[j] = traits::intersect(parameters[j], p);
        result.refuted = result.refuted || traits::is_empty(parameters[j]);
    }
    return result;
}

} // namespace sivid

#endif
