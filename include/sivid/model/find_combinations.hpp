// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_FIND_COMBINATIONS_HPP
#define SIVID_MODEL_FIND_COMBINATIONS_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/combination.hpp>
#include <sivid/model/rewrite.hpp>
#include <sivid/model/unit.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace model_detail {

using parameter_monomial = std::vector<int>; ///< exponents, one per unknown parameter
using monomial_set = std::set<parameter_monomial>;

/// All products of a member of one set and one of the other, or its inverse.
inline monomial_set products(monomial_set const& a, monomial_set const& b, int sign) {
    monomial_set result;
    for (auto const& left : a) {
        for (auto const& right : b) {
            auto both = left;
            for (std::size_t j = 0; j < both.size(); ++j) both[j] += sign * right[j];
            result.insert(std::move(both));
        }
    }
    return result;
}

/// Monomials of the parameters through which all rates and outputs depend on them, added to
/// `found`. Sums are multiplied out: each node is a sum of monomials, whose coefficients depend on
/// the parameters through what was found already.
inline void collect_monomials(bound_model const& model, monomial_set& found) {
    constexpr std::size_t most = 24; // longer sums are functions of their monomials
    auto const& g = model.g;
    auto const count = model.parameter_count();
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const needed = operands_of(g, outputs);
    parameter_monomial const none(count, 0);
    std::vector<monomial_set> terms(g.size(), monomial_set{none});
    auto const use = [&](node_id i) { found.insert(terms[i].begin(), terms[i].end()); };
    for (std::size_t k = 0; k < g.size(); ++k) {
        if (!needed[k]) continue;
        auto const& n = g.nodes()[k];
        if (n.op == operation::constant) {
            auto own = none;
            own[static_cast<std::size_t>(n.index)] = 1;
            terms[k] = {std::move(own)};
        }
        if (is_leaf(n.op)) continue;
        auto const& a = terms[n.a];
        std::size_t const terms_of_b = is_binary(n.op) ? terms[n.b].size() : 1;
        bool opaque = a.size() * terms_of_b > most;
        if (!opaque) {
            switch (n.op) {
            case operation::neg:
                terms[k] = a;
                break;
            case operation::add:
            case operation::sub:
                terms[k] = a;
                terms[k].insert(terms[n.b].begin(), terms[n.b].end());
                break;
            case operation::mul:
                terms[k] = products(a, terms[n.b], 1);
                break;
            case operation::div:
                if (terms_of_b > 1) use(n.b);
                terms[k] = terms_of_b > 1 ? a : products(a, terms[n.b], -1);
                break;
            case operation::sqr:
                terms[k] = products(a, a, 1);
                break;
            case operation::pown:
                opaque = a.size() > 1;
                if (opaque) break;
                terms[k] = a;
                for (int times = 1; times < n.index; ++times) terms[k] = products(terms[k], a, 1);
                break;
            default:
                opaque = true;
            }
        }
        if (!opaque) continue;
        use(n.a);
        if (is_binary(n.op)) use(n.b);
        terms[k] = {none};
    }
    for (auto const i : outputs) use(i);
    found.erase(none);
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

/// A product of powers, for instance "L*Sg/(Iz^2*m)".
inline std::string product_text(std::vector<std::string> const& names,
                                std::vector<int> const& exponents) {
    std::string above, below;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        if (exponents[j] == 0) continue;
        int const size = std::abs(exponents[j]);
        auto& side = exponents[j] > 0 ? above : below;
        if (!side.empty()) side += "*";
        side += names[j] + (size > 1 ? "^" + std::to_string(size) : "");
    }
    if (above.empty()) above = "1";
    if (below.empty()) return above;
    return above + "/" + (below.find('*') == std::string::npos ? below : "(" + below + ")");
}

inline combination named_combination(std::vector<int> exponents, bound_model const& model) {
    combination c;
    unit u;
    std::vector<std::string> names;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        auto const& constant = model.about.constants[model.parameters[j]];
        u = u.times(unit(constant.unit), exponents[j]);
        names.push_back(constant.name);
    }
    c.formula = product_text(names, exponents);
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
    // A basis of the products that involve entangled parameters. Parameters that are known alone
    // are divided out: what is left replaces the entangled ones whatever those are.
    for (auto& row : rows) {
        for (std::size_t j = 0; j < count; ++j) {
            bool const known = std::find(result.entangled.begin(), result.entangled.end(), j) ==
                               result.entangled.end();
            if (known) row[j] = 0;
        }
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [&](auto const& a, auto const& b) { return length(a) < length(b); });
    std::vector<std::vector<int>> basis;
    for (auto const& row : rows) {
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
