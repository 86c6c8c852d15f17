// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_IMPL_FIND_COMBINATIONS_IPP
#define SIVID_MODEL_STRUCTURE_IMPL_FIND_COMBINATIONS_IPP

#include <sivid/model/structure/find_combinations.hpp>

#include <sivid/model/graph/normal_form.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/space/exact/integer_span.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>

namespace sivid {

namespace model_detail {

SIVID_DECL void collect_monomials(bound_model const& model, monomial_set& found) {
    auto g = model.g;
    multiplied_out<function_coefficients> multiplied(function_coefficients(g),
                                                     {std::numeric_limits<std::size_t>::max(), 64});
    std::vector<node_id> open = model.rate;
    open.insert(open.end(), model.observe.begin(), model.observe.end());
    for (auto const i : open) (void)multiplied(i);
    open.insert(open.end(), multiplied.opaque().begin(), multiplied.opaque().end());
    std::set<node_id> seen;
    while (!open.empty()) {
        auto const i = open.back();
        open.pop_back();
        if (!seen.insert(i).second) continue;
        auto const& terms = multiplied(i);
        auto const n = g[i];
        if (multiplied.indivisible(i)) {
            open.push_back(n.a);
            if (is_binary(n.op)) open.push_back(n.b);
            continue;
        }
        for (auto const& term : terms) {
            std::vector<int> exponents(model.parameter_count(), 0);
            for (auto const& [factor, e] : term.first) {
                if (g[factor].op != operation::constant) continue;
                exponents[static_cast<std::size_t>(g[factor].index)] = e;
            }
            found.insert(std::move(exponents));
        }
    }
    found.erase(std::vector<int>(model.parameter_count(), 0));
}

SIVID_DECL std::string product_text(std::vector<std::string> const& names,
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

SIVID_DECL combination named_combination(std::vector<int> exponents, bound_model const& model) {
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

SIVID_DECL dependence_structure find_combinations(std::vector<bound_model const*> const& models) {
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
    integer_span all(count);
    for (auto const& row : rows) all.add(row);
    if (all.rank() == count) return result;
    for (std::size_t j = 0; j < count; ++j) {
        std::vector<int> alone(count, 0);
        alone[j] = 1;
        if (!all.contains(alone)) result.entangled.push_back(j);
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
    integer_span basis(count);
    for (auto const& row : rows) {
        if (!basis.add(row)) continue;
        result.combinations.push_back(model_detail::named_combination(row, model));
    }
    return result;
}

} // namespace sivid

#endif
