// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_DETAIL_DRAWING_HPP
#define SIVID_PAVING_PRODUCTS_DETAIL_DRAWING_HPP

#include <sivid/paving/identification.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/products/detail/preimage_volume.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// Tests boxes of the original parameters by a paving of the reduced ones, without any integration:
/// with it `invert` draws a paving of the original prior.
class preimage_test {
    using traits = interval_traits<interval>;

public:
    /// @param reduced  covers the reduced prior, outside boxes kept; both are kept by reference
    preimage_test(reduction const& map, subpaving const& reduced)
        : map_(&map), reduced_(&reduced) {}

    /// Which boxes an image meets; all that the image of a part can meet.
    struct knowledge {
        box image;
        std::vector<std::size_t> met;
    };

    /// @guarantee  inside: every point maps into inside boxes; outside: none maps into a box that
    ///             is not
    [[nodiscard]] assessment<knowledge>
    operator()(box const& p, std::shared_ptr<knowledge const> const& given) const {
        assessment<knowledge> result{.rest = p};
        auto found = std::make_shared<knowledge>();
        found->image = map_->forward(p);
        box around;
        auto const look = [&](std::size_t k) {
            auto const& b = reduced_->boxes()[k];
            auto const part = intersect(b.set, found->image);
            if (is_empty(part)) return;
            found->met.push_back(k);
            if (b.verdict == box_verdict::outside) return;
            around = around.size() == 0 ? part : hull(around, part);
        };
        if (given && subset(found->image, given->image)) {
            for (auto const k : given->met) look(k);
        } else {
            for (std::size_t k = 0; k < reduced_->boxes().size(); ++k) look(k);
        }
        if (is_empty(found->image) || around.size() == 0) {
            result.verdict = box_verdict::outside;
            return result;
        }
        result.rest = map_->backward(p, around);
        if (is_empty(result.rest)) {
            result.verdict = box_verdict::outside;
            return result;
        }
        auto const image = map_->forward(result.rest);
        if (subset(image, found->image) && is_inside(image, found->met)) {
            result.verdict = box_verdict::inside;
        }
        result.knowledge = std::move(found);
        return result;
    }

private:
    /// Whether inside boxes cover r: the boxes cover the prior, so no other meets its interior.
    [[nodiscard]] bool is_inside(box const& r, std::vector<std::size_t> const& met) const {
        return std::none_of(met.begin(), met.end(), [&](std::size_t index) {
            auto const& b = reduced_->boxes()[index];
            if (b.verdict == box_verdict::inside) return false;
            for (std::size_t k = 0; k < r.size(); ++k) {
                double const lo = b.set[k].lower();
                double const hi = b.set[k].upper();
                bool const flat = !(r[k].lower() < r[k].upper()) || !(lo < hi);
                bool const meets = flat ? lo <= r[k].upper() && r[k].lower() <= hi
                                        : lo < r[k].upper() && r[k].lower() < hi;
                if (!meets) return false;
            }
            return true;
        });
    }

    reduction const* map_;
    subpaving const* reduced_;
};

namespace paving_detail {

/// What boxes that are not outside leave of the combinations of a problem's parameters.
/// @param reduced  what is left of the reduced parameters; null where these are the problem's own
template <class Boxes>
[[nodiscard]] std::vector<combination_hull> hulls_of(dependence_structure const& structure,
                                                     box const* reduced, Boxes const& boxes) {
    std::vector<combination_hull> result;
    for (std::size_t c = 0; c < structure.combinations.size(); ++c) {
        auto const& what = structure.combinations[c];
        auto range = reduced != nullptr ? (*reduced)[c] : interval_traits<interval>::empty();
        for (auto const& b : boxes) {
            if (reduced == nullptr && b.verdict != box_verdict::outside)
                range = hull(range, what.over(b.set));
        }
        result.push_back({what, range});
    }
    return result;
}

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

/// What is left of the combinations of a problem's parameters, sums among them.
/// @param map   to sides of which `left` is left; null where these are the parameters
inline std::vector<combination_hull> combinations_left(dependence_structure const& structure,
                                                       reduction const* map, box const& left,
                                                       subpaving const& paving) {
    bool const sums = map != nullptr && map->has_sums();
    auto result = hulls_of(structure, map == nullptr || sums ? nullptr : &left, paving.boxes());
    for (auto const& known : sums ? map->products_over(left) : std::vector<combination_hull>{})
        if (known.what.is_sum()) result.push_back(known);
    return result;
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
    auto const left = reduced.has_outer() ? map.backward(prior, reduced.outer_hull()) : prior;
    if (map.has_sums()) { // of their preimages neither volumes nor certificates are known
        result.paving = within(result.paving, left); // boxes that wait, too
        result.proof = {};
    } else {
        auto const [inner, outer] = preimage_volumes(map, reduced, prior);
        result.paving.set_volumes(inner, outer);
        result.volumes = volume_source::preimage;
        result.products.emplace(product_paving{map, reduced});
    }
    result.hull = result.paving.outer_hull();
    if (result.paving.has_outer()) result.hull = intersect(result.hull, left);
}

} // namespace paving_detail

} // namespace sivid

#endif
