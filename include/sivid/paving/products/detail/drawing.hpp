// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_DETAIL_DRAWING_HPP
#define SIVID_PAVING_PRODUCTS_DETAIL_DRAWING_HPP

#include <sivid/paving/identification.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/products/detail/preimage_paving.hpp>
#include <sivid/paving/products/detail/preimage_volume.hpp>
#include <sivid/paving/products/reduction.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// The paving of the prior by the test. Sides that do not act are left out while it is drawn: no
/// box is cut there.
inline subpaving drawn(preimage_test& test, reduction const& map, box const& prior,
                       inversion_options const& options) {
    auto thin = prior;
    bool any = false;
    for (std::size_t j = 0; j < prior.size(); ++j) {
        if (map.acts(j)) continue;
        thin[j] = interval(mid(prior[j]));
        any = true;
    }
    auto paving = invert(test, thin, options).paving;
    if (!any) return paving;
    subpaving result(prior);
    for (auto const& b : paving.boxes()) {
        auto set = b.set;
        for (std::size_t j = 0; j < prior.size(); ++j) {
            if (!map.acts(j)) set[j] = prior[j];
        }
        result.add(std::move(set), b.verdict);
    }
    return result;
}

/// The volumes, in the original prior, of what a paving of the reduced one proves inside, and of
/// all that it leaves.
inline std::pair<interval, interval> preimage_volumes(reduction const& map,
                                                      subpaving const& reduced, box const& prior) {
    std::vector<box> inside, left;
    for (auto const& b : reduced.boxes()) {
        if (b.verdict == box_verdict::outside) continue;
        left.push_back(b.set);
        if (b.verdict == box_verdict::inside) inside.push_back(b.set);
    }
    preimage_volume const volume(map, prior);
    auto const cells = volume_cells(left.size());
    return {volume(inside, cells), volume(left, cells)};
}

/// Draws the paving of a reduced prior in the original one, and measures it there.
/// @param reduced  covers the reduced prior, outside boxes kept
/// @param boxes    tested to draw it
inline void draw(identification& result, reduction const& map, subpaving const& reduced,
                 box const& prior, inversion_options drawing, std::size_t boxes) {
    preimage_test test(map, reduced);
    drawing.boxes = boxes;
    drawing.seconds = std::min(10.0, drawing.seconds); // nothing is integrated
    drawing.progress = nullptr;
    drawing.hull_gain = 0;
    drawing.memory = inversion_options{}.memory; // few boxes
    drawing.checkpoint = nullptr;
    drawing.resume = nullptr;
    drawing.proof_bytes = 0;
    result.paving = drawn(test, map, prior, drawing);
    auto const [inner, outer] = preimage_volumes(map, reduced, prior);
    result.paving.set_volumes(inner, outer);
    result.volumes = volume_source::preimage;
    result.products.emplace(product_paving{map, reduced});
    result.hull = result.paving.outer_hull();
    if (!result.paving.has_outer()) return;
    result.hull = intersect(result.hull, map.backward(prior, reduced.outer_hull()));
}

} // namespace paving_detail

} // namespace sivid

#endif
