// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_PAVING_PLOT_HPP
#define SIVID_REPORT_DRAW_PAVING_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/detail/paving_raster.hpp>
#include <sivid/report/draw/legend.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

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

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/paving_plot.ipp>
#endif

#endif
