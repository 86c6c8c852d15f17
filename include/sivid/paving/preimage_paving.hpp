// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PREIMAGE_PAVING_HPP
#define SIVID_PAVING_PREIMAGE_PAVING_HPP

#include <sivid/paving/reduction.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>

namespace sivid {

/// Tests boxes of the original parameters by a paving of the reduced ones, without any integration:
/// with it `invert` draws a paving of the original prior.
class preimage_test {
    using traits = interval_traits<interval>;

public:
    /// @param reduced  covers the reduced prior, outside boxes kept; both are kept by reference
    preimage_test(reduction const& map, subpaving const& reduced)
        : map_(&map), reduced_(&reduced) {}

    /// @guarantee  inside: every point maps into inside boxes; outside: none maps into a box that
    ///             is not
    [[nodiscard]] assessment<> operator()(box const& p) const {
        assessment<> result{.rest = p};
        auto const image = map_->forward(p);
        box around;
        for (auto const& b : reduced_->boxes()) {
            if (b.verdict == box_verdict::outside) continue;
            auto const part = intersect(b.set, image);
            if (is_empty(part)) continue;
            around = around.size() == 0 ? part : hull(around, part);
        }
        if (is_empty(image) || around.size() == 0) {
            result.verdict = box_verdict::outside;
            return result;
        }
        result.rest = map_->backward(p, around);
        if (is_empty(result.rest)) {
            result.verdict = box_verdict::outside;
        } else if (is_inside(map_->forward(result.rest))) {
            result.verdict = box_verdict::inside;
        }
        return result;
    }

private:
    /// Whether inside boxes cover r: the boxes cover the prior, so no other meets its interior.
    [[nodiscard]] bool is_inside(box const& r) const {
        for (auto const& b : reduced_->boxes()) {
            if (b.verdict == box_verdict::inside) continue;
            bool meets = true;
            for (std::size_t k = 0; k < r.size() && meets; ++k) {
                bool const flat =
                    !(r[k].lower() < r[k].upper()) || !(b.set[k].lower() < b.set[k].upper());
                double const lo = b.set[k].lower();
                double const hi = b.set[k].upper();
                meets = flat ? lo <= r[k].upper() && r[k].lower() <= hi
                             : lo < r[k].upper() && r[k].lower() < hi;
            }
            if (meets) return false;
        }
        return true;
    }

    reduction const* map_;
    subpaving const* reduced_;
};

} // namespace sivid

#endif
