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
#include <set>
#include <string>
#include <utility>
#include <vector>

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

SIVID_DECL std::string sum_text(std::vector<std::string> const& names,
                                std::vector<int> const& signs) {
    std::string text;
    for (std::size_t j = 0; j < signs.size(); ++j) {
        if (signs[j] == 0) continue;
        if (text.empty()) {
            text = signs[j] > 0 ? "" : "-";
        } else {
            text += signs[j] > 0 ? " + " : " - ";
        }
        text += names[j];
    }
    return text;
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

namespace model_detail {

/// Which parameters stand in each tree of sums and differences and nowhere else, with their signs.
class sum_finder {
public:
    explicit sum_finder(bound_model const& model) : model_(&model), users_(model.g.size(), 0) {
        std::vector<node_id> open = model.rate;
        open.insert(open.end(), model.observe.begin(), model.observe.end());
        roots_ = open;
        std::vector<bool> seen(model.g.size(), false);
        while (!open.empty()) {
            auto const i = open.back();
            open.pop_back();
            if (seen[i]) continue;
            seen[i] = true;
            reached_.push_back(i);
            for (auto const operand : operands(i)) {
                ++users_[operand];
                open.push_back(operand);
            }
        }
        for (auto const i : roots_) users_[i] += 2; // nobody else may change them
    }

    /// In the order of the parameters.
    [[nodiscard]] std::set<std::vector<int>> operator()() const {
        std::set<node_id> inner;
        for (auto const i : reached_)
            if (is_sum(i))
                for (auto const operand : operands(i))
                    if (is_sum(operand) && users_[operand] == 1) inner.insert(operand);
        std::set<std::vector<int>> found;
        for (auto const i : reached_) {
            if (!is_sum(i) || inner.count(i) != 0) continue;
            auto signs = terms_of(i);
            auto const terms =
                std::count_if(signs.begin(), signs.end(), [](int s) { return s != 0; });
            if (terms >= 2) found.insert(std::move(signs));
        }
        return found;
    }

private:
    [[nodiscard]] bool is_sum(node_id i) const {
        auto const op = model_->g[i].op;
        return op == operation::add || op == operation::sub || op == operation::neg;
    }
    [[nodiscard]] std::vector<node_id> operands(node_id i) const {
        auto const n = model_->g[i];
        if (is_leaf(n.op)) return {};
        if (is_binary(n.op)) return {n.a, n.b};
        return {n.a};
    }
    [[nodiscard]] std::vector<int> terms_of(node_id root) const {
        std::vector<int> signs(model_->parameter_count(), 0);
        std::vector<std::pair<node_id, int>> open{{root, 1}};
        while (!open.empty()) {
            auto const [i, sign] = open.back();
            open.pop_back();
            auto const n = model_->g[i];
            if (i != root && users_[i] != 1) continue;
            if (n.op == operation::constant) signs[static_cast<std::size_t>(n.index)] = sign;
            if (!is_sum(i)) continue;
            open.emplace_back(n.a, n.op == operation::neg ? -sign : sign);
            if (n.op != operation::neg)
                open.emplace_back(n.b, n.op == operation::sub ? -sign : sign);
        }
        return signs;
    }

    bound_model const* model_;
    std::vector<std::size_t> users_; ///< among what rates and outputs depend on
    std::vector<node_id> roots_, reached_;
};

} // namespace model_detail

SIVID_DECL std::vector<combination> find_sums(std::vector<bound_model const*> const& models) {
    if (models.empty()) return {};
    auto common = model_detail::sum_finder(*models.front())();
    for (auto const* m : models) {
        auto const own = model_detail::sum_finder(*m)();
        std::erase_if(common, [&](auto const& signs) { return own.count(signs) == 0; });
    }
    std::vector<combination> result;
    auto const& model = *models.front();
    std::vector<std::string> names;
    for (auto const c : model.parameters) names.emplace_back(model.about.constants[c].name);
    for (auto const& signs : common) {
        auto const first = std::find_if(signs.begin(), signs.end(), [](int s) { return s != 0; });
        auto const unit =
            model.about.constants[model.parameters[static_cast<std::size_t>(first - signs.begin())]]
                .unit;
        result.push_back({std::vector<int>(signs.size(), 0), model_detail::sum_text(names, signs),
                          std::string(unit), signs});
    }
    return result;
}

} // namespace sivid

#endif
