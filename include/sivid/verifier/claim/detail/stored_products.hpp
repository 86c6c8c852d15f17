// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_STORED_PRODUCTS_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_STORED_PRODUCTS_HPP

#include <sivid/io/result/detail/product_formula.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/homogeneity.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The problem in products of parameters that a stored result speaks of, rebuilt from the formulas
/// alone: each product takes the place of one of its factors, its pivot, and the other factors are
/// set to 1.
struct stored_products {
    identification_problem problem;
    std::vector<product_formula> sides;
    std::vector<std::size_t> pivots; ///< of each side: a factor of power one in no other side
    std::string malformed;           ///< why there is no such problem; else empty
    std::string unproved;            ///< why it may have other trajectories; else empty
};

namespace io_detail {

inline std::optional<std::size_t> pivot_of(std::vector<product_formula> const& sides,
                                           std::size_t k) {
    auto const& own = sides[k].exponents();
    for (std::size_t j = 0; j < own.size(); ++j) {
        bool alone = own[j] == 1;
        for (std::size_t other = 0; other < sides.size() && alone; ++other) {
            alone = other == k || sides[other].exponents()[j] == 0;
        }
        if (alone) return j;
    }
    return std::nullopt;
}

} // namespace io_detail

/// @tparam I  in which the ranges of the products over the prior are computed
/// @guarantee  where both texts are empty: parameters of the prior, none of whose replaced factors
/// is 0, have the trajectories of their products in `problem`, and its prior contains the products.
/// Shown by dimensional analysis: scaling a replaced factor against the pivots leaves all equations
/// as they are.
template <class I>
[[nodiscard]] stored_products rebuild_products(identification_problem const& original,
                                               std::vector<std::string> const& formulas) {
    using traits = interval_traits<I>;
    stored_products result;
    auto const& names = original.choice.unknown;
    for (auto const& text : formulas) {
        auto const side = product_formula::parse(text, names);
        if (!side) {
            result.malformed = "the side " + text + " is no product of the parameters";
            return result;
        }
        result.sides.push_back(*side);
    }
    result.problem = original;
    auto& choice = result.problem.choice;
    choice.unknown.clear();
    std::vector<bool> is_pivot(names.size(), false);
    result.problem.prior = box(result.sides.size());
    auto const prior = io_detail::in<I>(original.prior);
    for (std::size_t k = 0; k < result.sides.size(); ++k) {
        auto const pivot = io_detail::pivot_of(result.sides, k);
        auto const range = result.sides[k].over(prior);
        if (!pivot || !range || !std::isfinite(traits::mag(*range))) {
            result.malformed = "the side " + formulas[k] + " cannot replace a parameter";
            return result;
        }
        result.pivots.push_back(*pivot);
        is_pivot[*pivot] = true;
        choice.unknown.push_back(names[*pivot]);
        result.problem.prior[k] = io_detail::in_doubles(*range);
    }
    std::vector<bound_model> models;
    for (auto const& e : original.experiments) {
        models.push_back(bind(original.model, original.choice, e.inputs));
    }
    for (std::size_t j = 0; j < names.size(); ++j) {
        if (is_pivot[j]) continue;
        choice.fixed[names[j]] = interval(1.0);
        std::vector<int> weights(names.size(), 0);
        weights[j] = 1;
        bool used = false;
        for (std::size_t k = 0; k < result.sides.size(); ++k) {
            weights[result.pivots[k]] = -result.sides[k].exponents()[j];
            used = used || result.sides[k].exponents()[j] != 0;
        }
        if (used && contains(original.prior[j], 0.0)) {
            result.unproved = names[j] + " may be 0";
        }
        if (!std::all_of(models.begin(), models.end(),
                         [&](auto const& m) { return is_scale_invariant(m, weights); })) {
            result.unproved = names[j] + " may act otherwise than through the products";
        }
    }
    return result;
}

/// Whether a parameter is a factor of several sides: parameters reach only some points of the box
/// of their ranges then.
[[nodiscard]] inline bool share_a_factor(stored_products const& products) {
    std::vector<bool> used;
    for (auto const& side : products.sides) {
        auto const& exponents = side.exponents();
        used.resize(exponents.size(), false);
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (exponents[j] == 0) continue;
            if (used[j]) return true;
            used[j] = true;
        }
    }
    return false;
}

namespace io_detail {

/// Whether parameters of a prior reach a box of products.
enum class reach { all, some, none };

/// @guarantee  all: with some of the factors as they are, the pivots reach each of its points;
///             none: no parameter has its products there
[[nodiscard]] inline reach reach_of(stored_products const& products, box near, box const& r) {
    using traits = interval_traits<interval>;
    auto const prior = near;
    for (std::size_t k = 0; k < r.size(); ++k) {
        auto const& exponents = products.sides[k].exponents();
        for (std::size_t j = 0; j < near.size(); ++j) {
            if (std::abs(exponents[j]) != 1) continue;
            auto const others = products.sides[k].without(j).over(near);
            if (!others) continue;
            bool undefined = false;
            auto const allowed = exponents[j] == 1 ? traits::div(r[k], *others, undefined)
                                                   : traits::div(*others, r[k], undefined);
            if (undefined) continue; // 0 among the divisors excludes nothing
            near[j] = traits::intersect(near[j], allowed);
            if (is_empty(near[j])) return reach::none;
        }
    }
    auto const factors = point_box(mid(near));
    for (std::size_t k = 0; k < r.size(); ++k) {
        auto const pivot = products.pivots[k];
        auto const others = products.sides[k].without(pivot).over(factors);
        bool undefined = !others;
        if (undefined || !subset(traits::div(r[k], *others, undefined), prior[pivot]) || undefined)
            return reach::some;
    }
    return reach::all;
}

} // namespace io_detail

/// Boxes within boxes of products, of which parameters of a prior reach every point: as many as
/// halving finds.
/// @given  nothing in `products` is malformed
/// @param tested  boxes, at most so many more than there are
[[nodiscard]] inline std::vector<box> reached_within(stored_products const& products,
                                                     box const& prior, std::vector<box> boxes,
                                                     std::size_t tested) {
    std::vector<box> result;
    tested += boxes.size();
    for (std::size_t at = 0; at < boxes.size(); ++at) {
        auto const r = boxes[at]; // a copy: there will be more
        auto const found = io_detail::reach_of(products, prior, r);
        if (found == io_detail::reach::all) result.push_back(r);
        if (found != io_detail::reach::some || boxes.size() + 2 > tested) continue;
        std::size_t widest = 0;
        double most = 0;
        for (std::size_t k = 0; k < r.size(); ++k) {
            double const share = width(r[k]) / width(products.problem.prior[k]);
            if (share > most) widest = k, most = share;
        }
        double const middle = mid(r[widest]);
        if (!(r[widest].lower() < middle && middle < r[widest].upper())) continue;
        auto const [low, high] = bisect(r, widest, middle);
        boxes.push_back(low);
        boxes.push_back(high);
    }
    return result;
}

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_STORED_PRODUCTS_HPP
