// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SUBPAVING_HPP
#define SIVID_PAVING_SUBPAVING_HPP

#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// A box with what is known of it.
struct paved_box {
    box set;
    box_verdict verdict = box_verdict::pending;
};

/// Boxes that cover the prior and overlap at most in their faces. Everything that no inside,
/// undecided or pending box covers is proved outside, whether or not the outside boxes were kept.
class subpaving {
public:
    explicit subpaving(box prior) : prior_(std::move(prior)), hull_(empty_box(prior_.size())) {}

    void add(box set, box_verdict v) {
        auto const volume = relative_volume(set, prior_);
        if (v == box_verdict::inside) inner_ = sum(inner_, volume);
        if (v != box_verdict::outside) {
            outer_ = sum(outer_, volume);
            hull_ = hull(hull_, set);
            has_outer_ = true;
        }
        boxes_.push_back({std::move(set), v});
    }

    /// Volumes that are known better than from the boxes: of a set in between, say, to which the
    /// boxes are drawn in less detail.
    /// @given  `inner` encloses the volume of a set proved inside, `outer` that of one around all
    ///         that is inside
    void set_volumes(interval const& inner, interval const& outer) {
        inner_ = inner;
        outer_ = outer;
    }

    [[nodiscard]] box const& prior() const { return prior_; }
    [[nodiscard]] std::vector<paved_box> const& boxes() const { return boxes_; }
    /// Volume proved inside, relative to the prior.
    [[nodiscard]] interval inner_volume() const { return inner_; }
    /// Volume of all that is not proved outside, relative to the prior.
    [[nodiscard]] interval outer_volume() const { return outer_; }
    /// Whether anything is not proved outside.
    [[nodiscard]] bool has_outer() const { return has_outer_; }
    /// The smallest box around all that is not proved outside; empty sides when all is.
    [[nodiscard]] box const& outer_hull() const { return hull_; }
    /// The largest box of a verdict against the prior, null when there is none.
    [[nodiscard]] box const* largest(box_verdict v) const {
        box const* best = nullptr;
        double most = -1;
        for (auto const& b : boxes_) {
            if (b.verdict != v) continue;
            double const volume = relative_volume(b.set, prior_).upper();
            if (volume > most) {
                most = volume;
                best = &b.set;
            }
        }
        return best;
    }
    [[nodiscard]] std::size_t count(box_verdict v) const {
        std::size_t n = 0;
        for (auto const& b : boxes_) n += b.verdict == v ? 1 : 0;
        return n;
    }

private:
    static interval sum(interval const& a, interval const& b) {
        return interval_traits<interval>::add(a, b);
    }

    box prior_;
    std::vector<paved_box> boxes_;
    interval inner_{0.0};
    interval outer_{0.0};
    box hull_;
    bool has_outer_ = false;
};

/// What a paving proves of the whole prior.
[[nodiscard]] inline verdict proved_verdict(subpaving const& paving) {
    if (paving.inner_volume().lower() > 0 || paving.count(box_verdict::inside) > 0) {
        return verdict::consistent;
    }
    return paving.has_outer() ? verdict::undecided : verdict::inconsistent;
}

/// The same paving, where what a box that is proved inside covers is inside: boxes that were not
/// decided are cut along its faces.
/// @given  all of `core` is proved inside; the volumes are those of the boxes
[[nodiscard]] inline subpaving with_inside(subpaving const& paving, box const& core) {
    subpaving result(paving.prior());
    for (auto const& b : paving.boxes()) {
        auto common = intersect(b.set, core);
        bool thick = !is_empty(common);
        for (std::size_t i = 0; thick && i < common.size(); ++i) {
            thick = width(common[i]) > 0 || width(b.set[i]) == 0;
        }
        if (!thick || b.verdict == box_verdict::outside || b.verdict == box_verdict::inside) {
            result.add(b.set, b.verdict);
            continue;
        }
        for (auto& part : difference(b.set, common)) result.add(std::move(part), b.verdict);
        result.add(std::move(common), box_verdict::inside);
    }
    return result;
}

/// The same paving, where all outside a box is proved outside.
/// @given  `rest` holds all that can be inside; the volumes are those of the boxes
[[nodiscard]] inline subpaving within(subpaving const& paving, box const& rest) {
    subpaving result(paving.prior());
    for (auto const& b : paving.boxes()) {
        bool const open = b.verdict == box_verdict::undecided || b.verdict == box_verdict::pending;
        auto left = open ? intersect(b.set, rest) : b.set;
        if (!is_empty(left)) result.add(std::move(left), b.verdict);
    }
    return result;
}

/// The same paving, where outside boxes were not kept.
/// @given  the volumes are those of the boxes
[[nodiscard]] inline subpaving without_outside(subpaving const& paving) {
    subpaving result(paving.prior());
    for (auto const& b : paving.boxes()) {
        if (b.verdict != box_verdict::outside) result.add(b.set, b.verdict);
    }
    return result;
}

} // namespace sivid

#endif
