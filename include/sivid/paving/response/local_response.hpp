// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_LOCAL_RESPONSE_HPP
#define SIVID_PAVING_RESPONSE_LOCAL_RESPONSE_HPP

#include <sivid/paving/response/linear_contractor.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// A response on a part of its box, as affine functions of local unknowns \f$ d \in [-1,1]^N \f$:
///   \f$ y \in value + \sum_v slope_v d_v + [-rest, rest] \f$, with q = middle + reach * d.
struct local_response {
    std::vector<double> middle, reach; ///< per variable
    std::vector<double> value;         ///< per output
    std::vector<double> slope;         ///< [v * outputs + y]
    std::vector<double> rest;          ///< per output: non-affine part, radius and rounding
    std::vector<double> curvature;     ///< per variable: its share in all the rests
};

namespace paving_detail {

/// The normalised interval of one side within a part of the box.
inline void normalise(normalised_unknowns::side const& s, interval const& part, double& middle,
                      double& reach) {
    using traits = interval_traits<interval>;
    bool undefined = false;
    auto q =
        traits::div(traits::sub(part, traits::point(s.centre)), traits::point(s.radius), undefined);
    q = traits::intersect(q, traits::bounds(-1.0, 1.0));
    middle = is_empty(q) ? 0 : mid(q);
    reach = is_empty(q) ? 1 : rad(q);
}

} // namespace paving_detail

/// Puts q_v + by in place of q_v in polynomials whose coefficients stand side by side, monomial
/// after monomial.
inline void shift(std::vector<double>& coefficients, monomial_table const& table,
                  std::size_t outputs, std::size_t v, double by) {
    if (by == 0) return;
    table.shift(v, [&](std::size_t m, std::size_t k) {
        double* const to = coefficients.data() + m * outputs;
        double const* const above = coefficients.data() + k * outputs;
        for (std::size_t y = 0; y < outputs; ++y) to[y] += by * above[y];
    });
}

/// The polynomials of a response in q - middle.
struct shifted_response {
    std::vector<double> coefficients; ///< as those of the response
    std::vector<double> rounding;     ///< per output: errors of the coefficients, all together
};

/// @given  |middle| + reach <= 1 but for rounding, where d in [-1,1]^N stands for q = middle +
///         reach * d
/// @guarantee  rounding: with |middle| + reach <= 1 each stage is a contraction in the sum norm, so
///   the errors of all stages, and of scaling and summing the terms in d, stay below (variables *
///   (2 degree + 8)) units of the polynomial's norm
/// @cost  O(monomials * degree * outputs), streaming over the outputs
[[nodiscard]] inline shifted_response shifted(response const& known,
                                              std::vector<double> const& middle) {
    constexpr double unit = std::numeric_limits<double>::epsilon();
    auto const& table = *known.table;
    auto const outputs = known.outputs();
    auto const n = table.variables;
    shifted_response result{known.coefficients, std::vector<double>(outputs, 0.0)};
    auto& c = result.coefficients;
    auto& norm = result.rounding;
    for (std::size_t m = 0; m < table.size(); ++m) {
        double const* row = c.data() + m * outputs;
        for (std::size_t y = 0; y < outputs; ++y) norm[y] += std::abs(row[y]);
    }
    for (std::size_t v = 0; v < n; ++v) shift(c, table, outputs, v, middle[v]);
    double const errors = static_cast<double>((n + 1) * (2 * table.degree + 8) + table.size());
    for (auto& x : norm) x *= 2 * errors * unit;
    return result;
}

/// Re-expands a response in d, where q = middle + reach * d for each of its variables.
/// @given  |middle| + reach <= 1 but for rounding
/// @guarantee  encloses the outputs for all d in [-1,1]^N; see `shifted` for rounding
[[nodiscard]] inline local_response expand(response const& known, std::vector<double> middle,
                                           std::vector<double> reach) {
    auto const& table = *known.table;
    auto const outputs = known.outputs();
    auto const n = table.variables;
    work_clock::count(known.coefficients.size() * (n + 2), 0.4);
    auto const [c, rounding] = shifted(known, middle);
    local_response local;
    local.middle = std::move(middle);
    local.reach = std::move(reach);
    local.value.assign(outputs, 0.0);
    local.rest.assign(outputs, 0.0);
    local.slope.assign(n * outputs, 0.0);
    local.curvature.assign(n, 0.0);
    for (std::size_t m = 0; m < table.size(); ++m) {
        auto const& e = table.exponents[m];
        double factor = 1;
        std::size_t degree = 0;
        bool even = true;
        for (std::size_t v = 0; v < n; ++v) {
            degree += e[v];
            even = even && e[v] % 2 == 0;
            for (std::size_t k = 0; k < e[v]; ++k) factor *= local.reach[v];
        }
        double const* const row = c.data() + m * outputs;
        if (degree == 0) {
            for (std::size_t y = 0; y < outputs; ++y) local.value[y] += row[y];
        } else if (degree == 1) {
            auto const v = static_cast<std::size_t>(std::find(e.begin(), e.end(), 1) - e.begin());
            for (std::size_t y = 0; y < outputs; ++y)
                local.slope[v * outputs + y] = row[y] * factor;
        } else {
            double total = 0;
            if (even) { // d^e lies in [0, 1]: half of it moves the value
                for (std::size_t y = 0; y < outputs; ++y) {
                    double const half = 0.5 * row[y] * factor;
                    local.value[y] += half;
                    local.rest[y] += std::abs(half);
                    total += std::abs(half);
                }
            } else {
                for (std::size_t y = 0; y < outputs; ++y) {
                    double const size = std::abs(row[y] * factor);
                    local.rest[y] += size;
                    total += size;
                }
            }
            for (std::size_t v = 0; v < n; ++v) local.curvature[v] += e[v] > 0 ? total : 0.0;
        }
    }
    for (std::size_t y = 0; y < outputs; ++y) {
        local.rest[y] = (local.rest[y] + known.radius[y] + rounding[y]) * (1 + 1e-12) + 1e-290;
        if (!(local.rest[y] >= 0)) local.rest[y] = std::numeric_limits<double>::infinity();
    }
    return local;
}

/// Where a part of a response's box lies among its unknowns: q = middle + reach * d.
struct unknowns_of_part {
    std::vector<double> middle, reach; ///< per variable; starts keep all of their range

    /// @param parameters  a box inside the one that the response was computed for (trusted)
    unknowns_of_part(response const& known, box const& parameters)
        : middle(known.table->variables, 0.0), reach(known.table->variables, 1.0) {
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            auto const& side = known.unknowns.parameters[j];
            if (side.radius == 0) continue;
            paving_detail::normalise(side, parameters[j], middle[side.variable],
                                     reach[side.variable]);
        }
    }
};

/// Re-expands a response about the middle of a part of its box.
/// @param parameters  a box inside the one that the response was computed for (trusted)
/// @guarantee  encloses the outputs for all parameters in the part and all starts of the response
[[nodiscard]] inline local_response expand(response const& known, box const& parameters) {
    unknowns_of_part part(known, parameters);
    return expand(known, std::move(part.middle), std::move(part.reach));
}

/// Encloses each output that was reached, over a part of the response's box.
[[nodiscard]] inline std::vector<interval> output_ranges(response const& known,
                                                         local_response const& local) {
    using traits = interval_traits<interval>;
    auto const outputs = known.outputs();
    auto const n = known.table->variables;
    std::vector<interval> ranges(outputs);
    for (std::size_t y = 0; y < outputs; ++y) {
        double affine = 0;
        for (std::size_t v = 0; v < n; ++v) affine += std::abs(local.slope[v * outputs + y]);
        double const spread = (affine + local.rest[y]) * (1 + 1e-14 * static_cast<double>(n + 4));
        ranges[y] = std::isfinite(spread) ? traits::add(traits::point(local.value[y]),
                                                        traits::bounds(-spread, spread))
                                          : traits::entire();
    }
    return ranges;
}
[[nodiscard]] inline std::vector<interval> output_ranges(response const& known,
                                                         box const& parameters) {
    return output_ranges(known, expand(known, parameters));
}

/// What a response says of a part of its box.
struct response_verdict {
    std::size_t held = 0;
    std::size_t failed = 0;
    bool refuted = false;   ///< no parameter in the part is feasible
    bool explained = false; ///< at least n - q measurements hold for all of the part
    /// For better starts so many could hold: the parameters alone do not spread them over the
    /// bounds.
    bool may_hold = false;
    /// Largest share of an undecided output's width that does not shrink with the part, among those
    /// where it matters against the measurement.
    double sharpness = 0;
    /// Largest radius of an undecided output against the half-width of its measurement.
    double blur = 0;
    std::vector<double> smear; ///< per parameter
};

/// What a point d in [-1, 1]^n of a part meets where output y keeps its bound: slope . d in target.
[[nodiscard]] inline linear_constraint constraint_of(response const& known,
                                                     local_response const& local, std::size_t y) {
    using traits = interval_traits<interval>;
    linear_constraint row;
    row.gradient.resize(known.table->variables);
    for (std::size_t v = 0; v < row.gradient.size(); ++v) {
        row.gradient[v] = local.slope[v * known.outputs() + y];
    }
    row.target =
        traits::sub(known.bounds[y], traits::add(traits::point(local.value[y]),
                                                 traits::bounds(-local.rest[y], local.rest[y])));
    return row;
}

/// Contracts a part by constraints of which some may fail. @returns false when nothing is left
[[nodiscard]] inline bool contract_by(std::vector<linear_constraint> const& rows,
                                      std::size_t may_fail, response const& known,
                                      local_response const& local, box& parameters) {
    using traits = interval_traits<interval>;
    box d(known.table->variables);
    for (std::size_t v = 0; v < d.size(); ++v) d[v] = traits::bounds(-1.0, 1.0);
    if (!relaxed_contract(d, rows, may_fail)) return false;
    bool left = true;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        auto const& side = known.unknowns.parameters[j];
        if (side.radius == 0) continue;
        auto const v = side.variable;
        if (d[v].lower() == -1 && d[v].upper() == 1) continue;
        auto const q = traits::add(traits::point(local.middle[v]),
                                   traits::mul(traits::point(local.reach[v]), d[v]));
        auto const p =
            traits::add(traits::point(side.centre), traits::mul(traits::point(side.radius), q));
        parameters[j] = traits::intersect(parameters[j], p);
        left = left && !traits::is_empty(parameters[j]);
    }
    return left;
}

/// Tests a part of a response's box, and contracts it.
/// @guarantee  no feasible parameter is removed: a point that more than q measurements exclude,
/// each
///             on its own, is infeasible whatever the start
[[nodiscard]] inline response_verdict assess(response const& known, box& parameters) {
    using traits = interval_traits<interval>;
    auto const local = expand(known, parameters);
    auto const outputs = known.outputs();
    auto const n = known.table->variables;
    response_verdict result;
    result.smear.assign(parameters.size(), 0.0);
    std::vector<double> smear(n, 0.0);
    std::vector<linear_constraint> open;
    std::size_t spoilt = 0;
    std::vector<bool> is_parameter(n, false);
    for (auto const& side : known.unknowns.parameters) {
        if (side.radius > 0) is_parameter[side.variable] = true;
    }
    auto const values = output_ranges(known, local);
    for (std::size_t y = 0; y < outputs; ++y) {
        auto const& bound = known.bounds[y];
        auto const& value = values[y];
        if (traits::disjoint(value, bound)) {
            result.refuted = ++result.failed > known.allowed;
            if (result.refuted) return result;
            continue;
        }
        if (traits::subset(value, bound)) {
            ++result.held;
            continue;
        }
        if (!std::isfinite(rad(value))) {
            result.sharpness = 1;
            continue;
        }
        double const scale = 1 / std::max(rad(bound), 1e-300);
        result.blur = std::max(result.blur, known.radius[y] * scale);
        auto row = constraint_of(known, local, y);
        double moved = 0;
        for (std::size_t v = 0; v < n; ++v) {
            smear[v] += std::abs(row.gradient[v]) * scale;
            if (is_parameter[v]) moved += std::abs(row.gradient[v]);
        }
        spoilt += moved > rad(bound) ? 1 : 0;
        // A radius below a hundredth of the measurement leaves only a thin undecided rim, also
        // where little room is left between the data and what explains them.
        double const radius = known.shrinking_radius(y);
        if (radius > 0.01 * rad(bound)) {
            result.sharpness = std::max(result.sharpness, radius / (moved + local.rest[y]));
        }
        open.push_back(std::move(row));
    }
    result.explained = result.held + known.allowed >= known.measurements;
    result.may_hold = outputs == known.measurements && result.failed + spoilt <= known.allowed;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        auto const& side = known.unknowns.parameters[j];
        if (side.radius > 0) result.smear[j] = smear[side.variable];
    }
    if (result.explained || open.empty()) return result;
    // Measurements that certainly fail have used up a part of the budget.
    result.refuted = !contract_by(open, known.allowed - result.failed, known, local, parameters);
    return result;
}

/// Whether a sharper run might show that a point meets its measurements. Where all may be
/// violated, as many as none.
[[nodiscard]] inline bool on_the_brink(response const& r, box const& point) {
    auto const values = output_ranges(r, point);
    std::size_t missed = 0, open = 0;
    for (std::size_t y = 0; y < values.size(); ++y) {
        bool const apart = disjoint(values[y], r.bounds[y]);
        missed += apart ? 1 : 0;
        open += apart || subset(values[y], r.bounds[y]) ? 0 : 1;
    }
    auto const most = r.allowed < r.measurements ? r.allowed : 0;
    return missed <= most && missed + open > most;
}

} // namespace sivid

#endif
