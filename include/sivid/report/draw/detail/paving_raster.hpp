// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_DETAIL_PAVING_RASTER_HPP
#define SIVID_REPORT_DRAW_DETAIL_PAVING_RASTER_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/text/range.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

/// The shadow of a paving on a plane.
///
/// Rule: a point of the plane is *inside* when some inside box projects onto it; otherwise
/// *undecided* when an undecided box does; otherwise *pending* when a pending box does; it is
/// *outside* only when everything above it is outside.
namespace sivid::report {

enum class region : std::uint8_t { outside, pending, undecided, inside };

/// One box of the paving, projected on two of its coordinates.
struct projected_box {
    range x{};
    range y{};
    region verdict = region::undecided;
};

inline constexpr std::string_view projection_rule =
    "A point of a projection is painted inside when at least one proven-inside box lies above it; "
    "undecided or pending "
    "when the best box above it is undecided or pending; outside only when every box above it is "
    "proved outside.";

/// The plane cut in cells by break points, each cell with the best region above it.
struct region_raster {
    std::vector<double> xs{};
    std::vector<double> ys{};
    std::vector<region> cells{}; ///< row by row, (ys.size()-1) rows of xs.size()-1
    bool exact = true; ///< the breaks are the boxes' own ends; else each cell has the best region
                       ///< that touches it
    [[nodiscard]] std::size_t columns() const { return xs.size() - 1; }
    [[nodiscard]] std::size_t rows() const { return ys.size() - 1; }
    [[nodiscard]] region at(std::size_t column, std::size_t row) const {
        return cells[row * columns() + column];
    }
};

/// A merged rectangle of cells of one region.
struct region_rect {
    std::size_t left, right, low, high; ///< cell numbers, right and high exclusive
    region what;
};

/// Projects boxes on a window of the plane, at most `most` cells a side. What no box covers is
/// outside: contraction removes proven-outside parts without leaving a box.
/// @given  window finite, of positive width
/// @cost   O(boxes log(cells) + cells), whatever the overlap
[[nodiscard]] SIVID_DECL region_raster project_paving(std::vector<projected_box> const& boxes,
                                                      range const& x, range const& y,
                                                      std::size_t most);

/// Joins cells of one region to rectangles: runs along rows, equal runs over rows. The outside is
/// left out (it is the ground).
[[nodiscard]] SIVID_DECL std::vector<region_rect> merge_cells(region_raster const& raster);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/paving_raster.ipp>
#endif

#endif
