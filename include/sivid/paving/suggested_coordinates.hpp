// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SUGGESTED_COORDINATES_HPP
#define SIVID_PAVING_SUGGESTED_COORDINATES_HPP

#include <sivid/paving/change_of_variables.hpp>
#include <sivid/paving/identifiability.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// A coordinate that takes the place of a parameter: the product or sum of `formula`.
struct coordinate_formula {
    std::size_t pivot = 0;    ///< the parameter that it replaces, with weight 1 or -1
    motion_kind kind = motion_kind::scaling;
    std::vector<int> weights; ///< one per parameter
};

/// The formula's value, without the parameter `left_out`.
template <class T>
[[nodiscard]] T value_of(coordinate_formula const& f, std::vector<T> const& p,
                         std::size_t left_out) {
    bool const product = f.kind == motion_kind::scaling;
    T value = product ? T(1) : T(0);
    for (std::size_t j = 0; j < p.size(); ++j) {
        if (j == left_out || f.weights[j] == 0) continue;
        if (!product) {
            value = value + p[j] * f.weights[j];
            continue;
        }
        auto const power = pown(p[j], std::abs(f.weights[j]));
        value = f.weights[j] > 0 ? value * power : value / power;
    }
    return value;
}

} // namespace paving_detail

/// Coordinates for `changed_problem`: the products and sums through which parameters act, each in the
/// place of one of its factors or terms; the other parameters stay. Long strips of feasible
/// parameters become boxes there.
///   Formulas that were found numerically do as well: what is proved in other coordinates does not
///   depend on how these came about. A formula with starts in it, or none of whose parameters it
///   could replace, is left out.
/// @param nearly  also through which parameters act nearly
/// @returns nothing when there is no such formula
[[nodiscard]] inline std::optional<change_of_variables>
suggested_coordinates(identification_problem const& problem, identifiability const& found,
                      bool nearly = true) {
    auto const parameters = problem.prior.size();
    auto formulas = found.fixed;
    if (nearly) {
        formulas.insert(formulas.end(), found.nearly_fixed.begin(), found.nearly_fixed.end());
    }
    std::vector<paving_detail::coordinate_formula> chosen;
    std::vector<change_of_variables::coordinate> coordinates;
    for (auto const& name : problem.choice.unknown) {
        auto const& constants = problem.model.about.constants;
        coordinates.push_back({name, constants[index_of(constants, name, "constant")].unit});
    }
    auto const units = coordinates;
    for (auto const& f : formulas) {
        paving_detail::coordinate_formula c{parameters, f.kind, std::vector<int>(parameters, 0)};
        bool starts = false;
        for (std::size_t k = 0; k < found.unknowns.size(); ++k) {
            auto const& q = found.unknowns[k];
            if (f.weights[k] == 0) continue;
            starts = starts || q.experiment.has_value();
            if (!q.experiment) c.weights[q.index] = f.weights[k];
        }
        // The parameter that is replaced must stand in no other formula.
        for (std::size_t j = parameters; !starts && j-- > 0;) {
            bool const shared = std::any_of(chosen.begin(), chosen.end(), [&](auto const& other) {
                return other.weights[j] != 0;
            });
            if (std::abs(c.weights[j]) == 1 && !shared) c.pivot = j;
        }
        bool const touches = std::any_of(chosen.begin(), chosen.end(), [&](auto const& other) {
            return c.weights[other.pivot] != 0;
        });
        if (c.pivot == parameters || touches) continue;
        unit u;
        for (std::size_t j = 0; j < parameters; ++j) {
            if (c.kind == motion_kind::scaling) u = u.times(unit(units[j].unit), c.weights[j]);
        }
        coordinates[c.pivot] = {f.formula,
                                c.kind == motion_kind::scaling ? u.text() : units[c.pivot].unit};
        chosen.push_back(std::move(c));
    }
    if (chosen.empty()) return std::nullopt;
    auto const forward = [&](std::vector<expression> const& p) {
        auto q = p;
        for (auto const& c : chosen) q[c.pivot] = paving_detail::value_of(c, p, parameters);
        return q;
    };
    auto const backward = [&](std::vector<expression> const& q) {
        auto p = q;
        for (auto const& c : chosen) {
            // The others of a formula are no pivots: they are what they were.
            auto const rest = paving_detail::value_of(c, q, c.pivot);
            bool const direct = c.weights[c.pivot] > 0;
            if (c.kind == motion_kind::scaling) {
                p[c.pivot] = direct ? q[c.pivot] / rest : rest / q[c.pivot];
            } else {
                p[c.pivot] = direct ? q[c.pivot] - rest : rest - q[c.pivot];
            }
        }
        return p;
    };
    return change_of_variables{std::move(coordinates), recorded_map(parameters, forward),
                               recorded_map(parameters, backward)};
}

} // namespace sivid

#endif
