// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_CHECK_HPP

#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/preimage_volume.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/claim/detail/product_volume.hpp>
#include <sivid/verifier/claim/detail/stored_products.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sivid {

/// The sides are products through which alone the equations see the parameters, and there are as
/// many rows as stated, all within the products' ranges.
[[nodiscard]] inline check_finding
check_products(stored_products const& rebuilt, stored_identification::product_boxes const& stored) {
    using outcome = check_finding::outcome;
    std::string const what = "products";
    if (!rebuilt.malformed.empty()) return {what, outcome::refuted, rebuilt.malformed};
    std::map<std::string, std::size_t> counted;
    for (auto const& row : stored.rows) ++counted[std::string{to_string(row.verdict)}];
    if (io_detail::any_leaves(stored.rows, rebuilt.problem.prior)) {
        return {what, outcome::refuted, "a box leaves the range of the products"};
    }
    for (auto const* const kind : {"inside", "undecided", "pending"}) {
        auto const stated = stored.stated_rows.find(kind);
        if (stated == stored.stated_rows.end() || stated->second != counted[kind]) {
            return {what, outcome::refuted,
                    "the number of " + std::string{kind} + " products is not the one stated"};
        }
    }
    if (!rebuilt.unproved.empty()) return {what, outcome::undecided, rebuilt.unproved};
    return {what, outcome::verified, "the equations see the parameters through them only"};
}

/// The hull follows from the hulls of all boxes and of all products.
/// @tparam I  in which the bounds of products are solved for their factors
template <class I>
[[nodiscard]] check_finding check_hull_of_products(identification_problem const& problem,
                                                   stored_identification const& stored,
                                                   stored_products const& rebuilt) {
    using traits = interval_traits<I>;
    auto const n = problem.prior.size();
    auto const& rows = stored.products->rows;
    std::string fault;
    if (rows.empty() && !stored.rows.empty()) fault = "boxes without products";
    std::vector<interval> range(n, interval_traits<interval>::empty());
    int roundings = 8;
    if (fault.empty() && !stored.rows.empty()) {
        auto const products = io_detail::hull_of(rows), boxes = io_detail::hull_of(stored.rows);
        auto p = io_detail::in<I>(problem.prior);
        for (std::size_t k = 0; k < rebuilt.sides.size(); ++k) {
            auto const& e = rebuilt.sides[k].exponents();
            roundings += 4 * rebuilt.sides[k].degree();
            for (std::size_t j = 0; j < n; ++j) {
                if (e[j] != 1) continue;
                auto const others = rebuilt.sides[k].without(j).over(p);
                typename traits::mask undefined{};
                if (!others) continue;
                auto const allowed = traits::div(io_detail::in<I>(products[k]), *others, undefined);
                if (!undefined) p[j] = traits::intersect(p[j], allowed);
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            range[j] = intersect(boxes[j], io_detail::in_doubles(p[j]));
        }
    }
    for (std::size_t j = 0; j < n && fault.empty(); ++j) {
        if (!io_detail::states(stored.parameters[j].range, range[j], roundings)) {
            fault = "the hull of " + stored.parameters[j].name +
                    " is not that of the boxes and products";
        }
    }
    if (fault.empty()) fault = between_fault(problem, stored);
    return io_detail::agreement("hull", fault, "that of all boxes and products");
}

/// The ranges of the combinations are those of the products.
[[nodiscard]] inline check_finding
check_combinations_of_products(stored_identification const& stored) {
    auto const& own = *stored.products;
    std::string fault;
    std::size_t products = 0;
    for (auto const& side : own.sides) {
        products += side.find_first_of("*/^") != std::string::npos ? 1 : 0;
    }
    if (stored.combinations.size() != products && !stored.rows.empty()) {
        fault = "not every product is a combination";
    }
    for (auto const& c : stored.combinations) {
        auto const k = static_cast<std::size_t>(
            std::find(own.sides.begin(), own.sides.end(), c.name) - own.sides.begin());
        auto range = interval_traits<interval>::empty();
        for (auto const& row : own.rows) {
            if (k < own.sides.size()) range = hull(range, row.set[k]);
        }
        if (!io_detail::states(c.range, range)) {
            fault = "the range of " + c.name + " is not that of the products";
        }
    }
    return io_detail::agreement("combinations", fault,
                                std::to_string(products) + " read from the products");
}

/// The verdict follows, and a volume that it rests on alone is that of products that are inside.
/// @param prior  of the parameters
template <class I>
[[nodiscard]] check_finding
check_verdict_of_products(stored_identification const& stored, stored_products const& rebuilt,
                          box const& prior, std::function<bool()> const& keep_going = {}) {
    auto found = check_verdict(stored);
    if (found.found != check_finding::outcome::verified || stored.verdict != verdict::consistent ||
        stored.witness || io_detail::any_inside(stored.rows)) {
        return found;
    }
    product_volume<I> const share(rebuilt, prior);
    for (auto const& row : stored.products->rows) {
        if (row.verdict == box_verdict::inside &&
            interval_traits<I>::lower(share({row.set}, 256, keep_going)) > 0) {
            return found;
        }
    }
    return {found.what, check_finding::outcome::undecided,
            "no proof that any parameters have the products that are inside"};
}

/// The volumes are those of the preimages of the products' boxes.
///   The enclosure by `product_volume` proves them where it lies within what is stated; they must
///   also be as the identification computes them from these boxes.
template <class I>
[[nodiscard]] check_finding
check_volumes_of_products(identification_problem const& problem,
                          stored_identification const& stored, stored_products const& rebuilt,
                          std::function<bool()> const& keep_going = {}) {
    using outcome = check_finding::outcome;
    std::string const what = "volumes";
    std::vector<box> inside, left;
    for (auto const& row : stored.products->rows) {
        left.push_back(row.set);
        if (row.verdict == box_verdict::inside) inside.push_back(row.set);
    }
    auto const map = reduction::find(problem, dependence_of(problem));
    if (!map || map->side_names() != stored.products->sides) {
        return {what, outcome::undecided, "other products than the model's"};
    }
    preimage_volume const again(*map, problem.prior);
    product_volume<I> const anew(rebuilt, problem.prior);
    std::size_t const cells = std::clamp<std::size_t>(200'000 / (left.size() + 1), 64, 4000);
    bool proved = true;
    for (bool const inner : {true, false}) {
        auto const& boxes = inner ? inside : left;
        auto const& stated = inner ? stored.inner : stored.outer;
        std::string const which = inner ? "inner" : "outer";
        auto const share = anew(boxes, cells, keep_going);
        auto const volume =
            intersect(io_detail::in_doubles(share), interval_traits<interval>::bounds(0.0, 1.0));
        // Of each end: what is next to nothing of all that is left may be all that is inside.
        double const below = 1e-9 * volume.lower(), above = 1e-9 * volume.upper();
        if (is_empty(stated) || stated.lower() > volume.upper() + above ||
            stated.upper() < volume.lower() - below) {
            return {what, outcome::refuted, "the " + which + " volume is not that of the products"};
        }
        auto const repeated = again(boxes, volume_cells(left.size()), 2e-3, keep_going);
        if (keep_going && !keep_going()) return io_detail::late(what);
        double const slack = 0.05 * width(repeated) + above;
        if (std::abs(repeated.lower() - stated.lower()) > slack ||
            std::abs(repeated.upper() - stated.upper()) > slack) {
            return {what, outcome::refuted,
                    "the " + which + " volume is not the one found for the products"};
        }
        proved = proved && stated.lower() <= volume.lower() + below &&
                 volume.upper() <= stated.upper() + above;
    }
    if (!proved) return {what, outcome::undecided, "as found, but the enclosures are too wide"};
    return {what, outcome::verified,
            "of the preimages of " + std::to_string(left.size()) + " boxes of products"};
}

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_PRODUCT_CHECK_HPP
