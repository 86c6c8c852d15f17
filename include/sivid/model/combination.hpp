// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_COMBINATION_HPP
#define SIVID_MODEL_COMBINATION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/space/box.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace sivid {

/// A product of powers of parameters, \f$ \prod_j p_j^{e_j} \f$.
struct combination {
    std::vector<int> exponents; ///< one per unknown parameter
    std::string formula;        ///< for instance "L*Sg"
    std::string unit;

    /// Encloses its range over a box of parameters.
    [[nodiscard]] interval over(box const& p) const {
        using traits = interval_traits<interval>;
        bool undefined = false;
        auto above = traits::point(1.0);
        auto below = traits::point(1.0);
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (exponents[j] == 0) continue;
            auto const power = traits::pown(p[j], std::abs(exponents[j]), undefined);
            auto& side = exponents[j] > 0 ? above : below;
            side = traits::mul(side, power);
        }
        auto const value = traits::div(above, below, undefined);
        return undefined ? traits::entire() : value;
    }
};

/// Through which products of parameters a model's outputs depend on them.
struct dependence_structure {
    /// All products that the equations contain.
    std::vector<combination> products;
    /// Parameters that no output determines alone, because they enter only through `combinations`:
    /// changing them with all combinations fixed changes no trajectory and no output. Proved from
    /// the structure of the equations, whatever the data.
    std::vector<std::size_t> entangled;
    /// Independent products that replace the entangled parameters.
    std::vector<combination> combinations;
};

namespace model_detail {

/// Exponent vector of each maximal product in which parameters stand, added to `found`.
inline void collect_monomials(bound_model const& model, std::set<std::vector<int>>& found) {
    auto const& g = model.g;
    auto const count = model.parameter_count();
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    std::vector<bool> needed(g.size(), false);
    for (auto const i : outputs) needed[i] = true;
    for (std::size_t k = g.size(); k-- > 0;) {
        auto const& n = g.nodes()[k];
        if (!needed[k] || is_leaf(n.op)) continue;
        needed[n.a] = true;
        if (is_binary(n.op)) needed[n.b] = true;
    }
    std::vector<std::vector<int>> power(g.size(), std::vector<int>(count, 0));
    auto const use = [&](node_id i) { found.insert(power[i]); };
    for (std::size_t k = 0; k < g.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = g.nodes()[k];
        auto const combine = [&](int sign) {
            for (std::size_t j = 0; j < count; ++j)
                power[k][j] = power[n.a][j] + sign * power[n.b][j];
        };
        switch (n.op) {
        case operation::constant:
            power[k][static_cast<std::size_t>(n.index)] = 1;
            break;
        case operation::neg:
            power[k] = power[n.a];
            break;
        case operation::mul:
            combine(1);
            break;
        case operation::div:
            combine(-1);
            break;
        case operation::sqr:
            for (std::size_t j = 0; j < count; ++j) power[k][j] = 2 * power[n.a][j];
            break;
        case operation::pown:
            for (std::size_t j = 0; j < count; ++j) power[k][j] = n.index * power[n.a][j];
            break;
        default: // any other operation sees its operands' products as they are
            if (is_leaf(n.op)) break;
            use(n.a);
            if (is_binary(n.op)) use(n.b);
        }
    }
    for (auto const i : outputs) use(i);
    found.erase(std::vector<int>(count, 0));
}

inline Eigen::Index rank_of(std::vector<std::vector<int>> const& rows, std::size_t columns) {
    if (rows.empty()) return 0;
    Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
        }
    }
    return Eigen::FullPivLU<Eigen::MatrixXd>(m).rank();
}

inline combination named_combination(std::vector<int> exponents, bound_model const& model) {
    combination c;
    unit u;
    std::string below;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        if (exponents[j] == 0) continue;
        auto const& constant = model.about.constants[model.parameters[j]];
        u = u.times(unit(constant.unit), exponents[j]);
        int const size = std::abs(exponents[j]);
        auto const factor = constant.name + (size > 1 ? "^" + std::to_string(size) : "");
        auto& side = exponents[j] > 0 ? c.formula : below;
        if (!side.empty()) side += "*";
        side += factor;
    }
    if (c.formula.empty()) c.formula = "1";
    if (!below.empty()) {
        c.formula += "/" + (below.find('*') == std::string::npos ? below : "(" + below + ")");
    }
    c.unit = u.text();
    c.exponents = std::move(exponents);
    return c;
}

} // namespace model_detail

/// Finds the products of parameters through which all rates and outputs depend on them.
///   The equations contain the parameters only in the monomials collected here; where those span
///   fewer dimensions than there are parameters (in logarithms), some parameters are entangled.
/// @param models  the same model bound to the inputs of each experiment, since an input that
/// vanishes
///                takes terms with it
/// @guarantee  `entangled` is a theorem about the equations. Parameters that are not listed may
/// still
///             be left open by the data, or be tied by sums, which this does not look for.
[[nodiscard]] inline dependence_structure
find_combinations(std::vector<bound_model const*> const& models) {
    dependence_structure result;
    if (models.empty()) return result;
    auto const& model = *models.front();
    auto const count = model.parameter_count();
    std::set<std::vector<int>> found;
    for (auto const* m : models) model_detail::collect_monomials(*m, found);
    std::vector<std::vector<int>> rows(found.begin(), found.end());
    // Short products first, so that the basis reads well.
    auto const length = [](std::vector<int> const& e) {
        int sum = 0;
        for (int const v : e) sum += std::abs(v);
        return sum;
    };
    std::stable_sort(rows.begin(), rows.end(),
                     [&](auto const& a, auto const& b) { return length(a) < length(b); });
    for (auto const& row : rows) {
        result.products.push_back(model_detail::named_combination(row, model));
    }
    auto const rank = model_detail::rank_of(rows, count);
    if (rank == static_cast<Eigen::Index>(count)) return result;
    for (std::size_t j = 0; j < count; ++j) {
        auto with = rows;
        std::vector<int> alone(count, 0);
        alone[j] = 1;
        with.push_back(alone);
        if (model_detail::rank_of(with, count) > rank) result.entangled.push_back(j);
    }
    // A basis of the products that involve entangled parameters.
    std::vector<std::vector<int>> basis;
    for (auto const& row : rows) {
        bool const involved = std::any_of(result.entangled.begin(), result.entangled.end(),
                                          [&](std::size_t j) { return row[j] != 0; });
        if (!involved) continue;
        auto with = basis;
        with.push_back(row);
        if (model_detail::rank_of(with, count) == static_cast<Eigen::Index>(basis.size())) continue;
        basis.push_back(row);
        result.combinations.push_back(model_detail::named_combination(row, model));
    }
    return result;
}

} // namespace sivid

#endif
