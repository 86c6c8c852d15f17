// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_PAVING_PLOT_HPP
#define SIVID_REPORT_DRAW_PAVING_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
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

/// The projection of a paving on two parameters. Outside boxes may be left out: what no box covers
/// counts as outside.
struct paving_projection {
    axis x{}; ///< bounds: the prior
    axis y{};
    std::vector<projected_box> boxes{};
    std::optional<point> witness{}; ///< a verified point
};

struct paving_plot_options {
    double width = 360;
    double height = 300;
    std::string title{};
    range x_window{}; ///< empty: the prior
    range y_window{};
    bool mark_zoom = false;           ///< outline the window of `zoom_window`
    std::size_t finest = 640;         ///< cells a side before the text limit
    std::size_t most_bytes = 150'000; ///< of the regions' outlines; coarser cells until it is met
};

struct plane_window {
    range x{};
    range y{};
};

/// What the regions of a paving mean.
struct paving_words {
    std::string inside = "inside: proved to explain the data";
    std::string outside = "outside: proved impossible";
    std::string point = "witness";
    std::string whole = "whole prior";
};

/// The boxes behind the projections of one paving, for the page's script: attributes of the figure
/// that shows them. Ends are rounded to the nearest of 10^4 steps over all boxes: enough to show
/// where a box lies, no bound.
/// @given  box i of each projection belongs to the same box of the paving; else nothing comes back
/// @param most  of so many boxes, the largest; how many are left out is said
[[nodiscard]] SIVID_DECL std::vector<attribute_text>
paving_attributes(std::vector<paving_projection> const& all, std::size_t most = 3000,
                  paving_words const& words = {});

/// What is worth a closer look: the hull of inside and undecided boxes, or of the inside boxes
/// when that is nearly all of the prior. Nothing when the whole view shows it well.
[[nodiscard]] SIVID_DECL std::optional<plane_window> zoom_window(paving_projection const& p,
                                                                 double most_share = 0.55);

/// The legend of paving plots, with the regions that occur.
[[nodiscard]] SIVID_DECL std::vector<legend_entry>
paving_plot_legend(std::vector<paving_projection> const& all, paving_words const& words = {});

/// The projection of a paving within a window. However many boxes come in, the text stays within
/// `most_bytes` and a small constant: cells of one region are joined, and coarser cells are taken
/// until they fit.
[[nodiscard]] SIVID_DECL svg draw_paving_plot(paving_projection const& p,
                                              paving_plot_options const& o = {});

/// A paving with what its sides are called.
struct named_paving {
    subpaving const* paving = nullptr;
    std::vector<axis> sides{};     ///< bounds: the prior
    std::vector<range> hull{};     ///< per side: what the data leave of it
    std::vector<double> witness{}; ///< a verified point; may be empty
};

/// The projections worth a picture: on all pairs of sides when these are few, else of the four that
/// the data narrow most.
/// @param first  sides whose pairs come first
/// @param most   so many projections
[[nodiscard]] SIVID_DECL std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most);

/// A box of the plane.
struct plane_box {
    range x{};
    range y{};
};

/// A place and heading [rad] of the craft on the non-validated line.
struct pose {
    double x = 0;
    double y = 0;
    double heading = 0;
};

/// A motion in the plane.
struct plane_series {
    std::string x_name = "x";
    std::string y_name = "y";
    std::string unit = "m";
    std::vector<plane_box> tube{};     ///< proven enclosures, one for each step
    std::vector<plane_box> measured{}; ///< measured position intervals
    std::vector<point> reference{};    ///< not validated
    std::vector<pose> poses{};         ///< not validated; drawn as small arrowheads
};

struct plane_plot_options {
    double width = 740;
    double height = 300;
    std::string title{};
};

[[nodiscard]] SIVID_DECL std::vector<legend_entry> plane_plot_legend(plane_series const& s);

/// Joins neighbours by their hull until at most `most` boxes are left.
[[nodiscard]] SIVID_DECL std::vector<plane_box> merged(std::vector<plane_box> boxes,
                                                       std::size_t most);

/// A motion seen from above: the proven boxes step by step, the measured positions and a
/// reference line that is not validated; equal scales on both axes. Beyond some thousand boxes
/// neighbours are joined, which only enlarges them.
[[nodiscard]] SIVID_DECL svg draw_plane_plot(plane_series const& s,
                                             plane_plot_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/paving_plot.ipp>
#endif

#endif
