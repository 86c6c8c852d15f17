// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EXPLAINED_HULL_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EXPLAINED_HULL_HPP

#include <sivid/model/structure/combination.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What contains every parameter that explains some data: a box, and ranges of products and sums of
/// parameters, of which the data may tell far more than of each factor.
struct explained_hull {
    box parameters;
    std::vector<combination_hull> products{};

    [[nodiscard]] bool contains(explained_hull const& other) const {
        return parameters.size() != 0 && subset(other.parameters, parameters) &&
               std::all_of(products.begin(), products.end(), [&](auto const& p) {
                   return subset(range_of(p.what, other.parameters, other.products), p.hull);
               });
    }
    /// Another product that is known, or the same one better.
    void add(combination_hull more) {
        for (auto& p : products) {
            if (!p.what.same_as(more.what)) continue;
            p.hull = interval_traits<interval>::intersect(p.hull, more.hull);
            return;
        }
        products.push_back(std::move(more));
    }
    /// Grows until it contains another one of the same parameters, too.
    void join(explained_hull const& more) {
        if (parameters.size() == 0) {
            *this = more;
            return;
        }
        auto const both = hull(parameters, more.parameters);
        std::vector<combination_hull> joined;
        auto const add = [&](combination const& what) {
            auto const range = hull(range_of(what, parameters, products),
                                    range_of(what, more.parameters, more.products));
            if (std::isfinite(mag(range))) joined.push_back({what, range});
        };
        for (auto const& p : products) add(p.what);
        for (auto const& p : more.products) {
            bool const known = std::any_of(products.begin(), products.end(),
                                           [&](auto const& q) { return q.what.same_as(p.what); });
            if (!known) add(p.what);
        }
        parameters = both;
        products = std::move(joined);
    }
};

/// A combination of parameters of one order, told by another order of them.
/// @returns  nothing where one that it has is not among those
[[nodiscard]] inline std::optional<combination_hull> reordered(combination_hull product,
                                                               std::vector<std::string> const& from,
                                                               std::vector<std::string> const& to) {
    auto const& own = product.what;
    std::vector<int> exponents(to.size(), 0), signs(own.is_sum() ? to.size() : 0, 0);
    for (std::size_t j = 0; j < from.size(); ++j) {
        if (!own.has(j)) continue;
        auto const at = std::find(to.begin(), to.end(), from[j]);
        if (at == to.end()) return std::nullopt;
        auto const k = static_cast<std::size_t>(at - to.begin());
        exponents[k] = own.exponents[j];
        if (own.is_sum()) signs[k] = own.signs[j];
    }
    product.what.exponents = std::move(exponents);
    product.what.signs = std::move(signs);
    return product;
}

} // namespace sivid

#endif
