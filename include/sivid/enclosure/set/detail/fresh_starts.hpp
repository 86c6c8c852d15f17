// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SET_DETAIL_FRESH_STARTS_HPP
#define SIVID_ENCLOSURE_SET_DETAIL_FRESH_STARTS_HPP

#include <sivid/enclosure/set/parametric_set.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sivid::enclosure_detail {

/// A set that contains another one, with new variables for where the states are: polynomials carry
/// on what had been lost to generators. The dependence on the parameters alone stays. That on the
/// initial states ends: a variable beyond those of the parameters means another thing before and
/// after. So this is for sets that are asked for their ranges, and for nothing that relates times.
///   With \f$ p \f$ the terms of P in the first variables alone, x - p(q) is a sum of terms
/// \f$ c_\alpha q^\alpha \f$, \f$ q^\alpha \in [-1,1] \f$, or [0, 1] where all exponents are even,
/// and of generators. All of them lie in a box in a frame along the longest of them:
/// \f$ x \in p(q) + \sum_k s_k Q_k b_k, \; b \in [-1,1]^n \f$.
/// @param kept   the first variables, so many, are those of parameters
/// @param shape  for these and one more for each state, together at least as many as there were
/// @throws std::logic_error  for fewer
[[nodiscard]] inline parametric_set<taylor_model<double>>
with_fresh_starts(parametric_set<taylor_model<double>> const& set, std::size_t kept,
                  model_shape<double> const& shape) {
    using model = taylor_model<double>;
    auto const n = set.centre.size();
    std::vector<double> lost(n), unit;
    std::vector<model> own; // p
    model const* largest = &set.centre.front();
    for (std::size_t i = 0; i < n; ++i) {
        auto const& p = set.centre[i];
        if (p.terms() > largest->terms()) largest = &p; // others may be numbers
        unit.push_back(p.spread() + set.reach[i]);
        lost[i] = set.tail.empty() ? 0.0 : std::abs(set.tail[i]);
        own.push_back(p);
    }
    auto moving = set.columns;
    auto const& space = largest->space();
    for (std::size_t m = 1; m < largest->terms(); ++m) {
        auto const* const e = space.exponents(m);
        auto const* const end = e + space.variables();
        if (std::all_of(e + kept, end, [](std::uint8_t k) { return k == 0; })) continue;
        bool const even = std::all_of(e, end, [](std::uint8_t k) { return k % 2 == 0; });
        auto& g = moving.emplace_back(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (m >= own[i].terms()) continue;
            double c = std::exchange(own[i].c(m), 0.0);
            if (even) { // in [0, 1]
                c *= 0.5;
                own[i].c(0) += c;
                lost[i] += std::abs(own[i].c(0)) * model::unit + model::tiny;
            }
            g[i] = model::constant(c);
        }
    }
    if (moving.empty()) moving.emplace_back(n); // a set that does not vary but by parameters
    framed_box<model> const around(moving.begin(), moving.end(), unit);
    parametric_set<model> result(n, shape);
    result.time = set.time;
    for (std::size_t i = 0; i < n; ++i) {
        own[i].finish();
        auto& p = result.centre[i];
        p = model(shape);
        auto const c = converted(own[i], shape); // of a number: itself
        std::copy_n(c.c(), c.terms(), p.c());
        lost[i] += c.r();
    }
    for (std::size_t k = 0; k < n; ++k) {
        auto const edge = around.edge(k, lost);
        for (std::size_t i = 0; i < n; ++i) {
            result.centre[i].c(shape.space->variable(kept + k)) = edge[i];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        result.centre[i].finish();
        lost[i] *= 1 + 1e-12;
    }
    result.append(lost);
    result.measure();
    return result;
}

} // namespace sivid::enclosure_detail

#endif
