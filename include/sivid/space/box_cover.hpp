// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_BOX_COVER_HPP
#define SIVID_SPACE_BOX_COVER_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Whether a side stands for one number: a point, or a few floats around a decimal.
[[nodiscard]] inline bool is_one_number(interval const& side) {
    return side.upper() - side.lower() <= 0x1p-50 * mag(side);
}

/// What a family of boxes leaves of a whole, and where it counts something twice.
struct box_cover {
    /// Boxes with disjoint interiors: together the closure of the whole without the family.
    std::vector<box> gaps;
    /// Pairs of the family whose interiors meet by more than the tolerance; a pair may stand here
    /// more than once.
    std::vector<std::pair<std::size_t, std::size_t>> overlaps;
    bool complete = true; ///< else gaps may share volume with boxes, and overlaps be missing
};

/// Subtracts a family of boxes from a whole by recursive cuts along their faces.
///   A cell that no box meets is a gap, and so is a slice of a few floats that several meet. Any
///   other is narrowed to the hull of what the boxes cover of it, what that leaves being gaps; a
///   single box then covers it, several are parted by a cut at a face.
class box_subtraction {
public:
    /// @param tolerance  overlaps up to this share of a side's magnitude are rounding
    /// @param keep_going  once false, the rest is left as it is; may be empty
    box_subtraction(box const& whole, std::vector<box> const& family, double tolerance,
                    std::function<bool()> keep_going = nullptr)
        : whole_(&whole),
          family_(&family),
          tolerance_(tolerance),
          keep_going_(std::move(keep_going)) {}

    [[nodiscard]] box_cover operator()() {
        std::vector<std::size_t> all(family_->size());
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
        divide(*whole_, all);
        return std::move(result_);
    }

private:
    static constexpr std::size_t few = 6;

    [[nodiscard]] bool thick(std::size_t i) const { return !is_one_number((*whole_)[i]); }

    /// A slice between faces that differ by rounding, of which nothing finer is told.
    [[nodiscard]] bool is_rounding(box const& x) const {
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (thick(i) && x[i].upper() - x[i].lower() <= 0x1p-51 * mag(x[i])) return true;
        }
        return false;
    }
    /// Whether the interiors meet; in sides where the whole is no thicker than a number, the sides.
    [[nodiscard]] bool meets(box const& a, box const& b) const {
        for (std::size_t i = 0; i < a.size(); ++i) {
            double const low = std::max(a[i].lower(), b[i].lower());
            double const high = std::min(a[i].upper(), b[i].upper());
            if (thick(i) ? !(low < high) : !(low <= high)) return false;
        }
        return true;
    }
    [[nodiscard]] bool overlap(box const& a, box const& b) const {
        for (std::size_t i = 0; i < a.size(); ++i) {
            if (!thick(i)) continue;
            double const low = std::max(a[i].lower(), b[i].lower());
            double const high = std::min(a[i].upper(), b[i].upper());
            if (!(high - low > tolerance_ * mag((*whole_)[i]))) return false;
        }
        return meets(a, b);
    }
    void note_overlaps(std::vector<std::size_t> const& list) {
        for (std::size_t a = 0; a < list.size(); ++a) {
            for (std::size_t b = a + 1; b < list.size(); ++b) {
                if (overlap((*family_)[list[a]], (*family_)[list[b]])) {
                    result_.overlaps.emplace_back(list[a], list[b]);
                }
            }
        }
    }

    void subtract(box const& cell, std::vector<std::size_t> const& list) {
        std::vector<box> left{cell};
        for (auto const k : list) {
            std::vector<box> next;
            for (auto const& piece : left) {
                if (!meets(piece, (*family_)[k])) {
                    next.push_back(piece);
                    continue;
                }
                for (auto& rest : difference(piece, (*family_)[k])) next.push_back(std::move(rest));
            }
            left = std::move(next);
        }
        for (auto& piece : left) result_.gaps.push_back(std::move(piece));
    }

    /// A face in the cell that boxes cross least, up to rounding, and of these the one that leaves
    /// the fewest boxes in the fuller part; one that parts nothing does not count.
    [[nodiscard]] std::optional<std::pair<std::size_t, double>>
    best_cut(box const& cell, std::vector<std::size_t> const& list) const {
        std::optional<std::pair<std::size_t, double>> best;
        std::pair<std::size_t, std::size_t> least{list.size(), list.size()};
        for (std::size_t i = 0; i < cell.size(); ++i) {
            if (!thick(i)) continue;
            std::vector<double> lows, highs, faces;
            for (auto const k : list) {
                lows.push_back((*family_)[k][i].lower());
                highs.push_back((*family_)[k][i].upper());
            }
            std::sort(lows.begin(), lows.end());
            std::sort(highs.begin(), highs.end());
            std::merge(lows.begin(), lows.end(), highs.begin(), highs.end(),
                       std::back_inserter(faces));
            double const room = tolerance_ * mag((*whole_)[i]);
            for (double const f : faces) {
                if (!(cell[i].lower() < f && f < cell[i].upper())) continue;
                auto const below = static_cast<std::size_t>(
                    std::upper_bound(highs.begin(), highs.end(), f + room) - highs.begin());
                auto const above = static_cast<std::size_t>(
                    lows.end() - std::lower_bound(lows.begin(), lows.end(), f - room));
                auto const n = list.size();
                std::pair const cost{n - std::min(n, below + above), n - std::min(below, above)};
                if (cost.second >= n || !(cost < least)) continue;
                least = cost;
                best = {i, f};
            }
        }
        return best;
    }

    void divide(box cell, std::vector<std::size_t> const& from) {
        if (!result_.complete || (keep_going_ && !keep_going_())) {
            result_.complete = false;
            result_.gaps.push_back(std::move(cell));
            return;
        }
        std::vector<std::size_t> list;
        box around;
        for (auto const k : from) {
            if (!meets(cell, (*family_)[k])) continue;
            auto const part = intersect(cell, (*family_)[k]);
            around = list.empty() ? part : hull(around, part);
            list.push_back(k);
        }
        if (list.empty() || (list.size() > few && is_rounding(cell))) {
            result_.gaps.push_back(std::move(cell));
            return;
        }
        if (list.size() > 1 && is_rounding(cell)) return subtract(cell, list);
        // What lies beyond all of them is few large gaps; cuts through it would make many.
        for (auto& beyond : difference(cell, around)) result_.gaps.push_back(std::move(beyond));
        cell = std::move(around);
        if (list.size() == 1) return;
        auto const cut = best_cut(cell, list);
        if (!cut) { // every box covers more of the cell than a cut could part
            if (list.size() <= few) {
                note_overlaps(list);
            } else {
                for (std::size_t k = 1; k < list.size(); ++k) {
                    if (overlap((*family_)[list[0]], (*family_)[list[k]])) {
                        result_.overlaps.emplace_back(list[0], list[k]);
                    }
                }
            }
            subtract(cell, list);
            return;
        }
        auto const [below, above] = bisect(cell, cut->first, cut->second);
        divide(below, list);
        divide(above, list);
    }

    box const* whole_;
    std::vector<box> const* family_;
    double tolerance_;
    std::function<bool()> keep_going_;
    box_cover result_;
};

/// @param keep_going  once false, `complete` is, and gaps hold what was not worked out
/// @guarantee  on the doubles of the bounds a point of the whole lies in a box of the family or in
/// a gap; gaps share volume with boxes only in slices of a few floats
/// @cost  about n log n for n boxes that share few cuts, more when cuts meet many boxes
[[nodiscard]] inline box_cover cover(box const& whole, std::vector<box> const& family,
                                     double tolerance = 2e-15,
                                     std::function<bool()> keep_going = nullptr) {
    return box_subtraction(whole, family, tolerance, std::move(keep_going))();
}

} // namespace sivid

#endif
