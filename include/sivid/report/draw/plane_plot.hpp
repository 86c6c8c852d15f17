// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_PLANE_PLOT_HPP
#define SIVID_REPORT_DRAW_PLANE_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/legend.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

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

namespace detail {

/// Joins neighbours by their hull until at most `most` boxes are left.
SIVID_DECL std::vector<plane_box> joined(std::vector<plane_box> boxes, std::size_t most);

} // namespace detail

/// A motion seen from above: the proven boxes step by step, the measured positions and a
/// reference line that is not validated; equal scales on both axes. Beyond some thousand boxes
/// neighbours are joined, which only enlarges them.
[[nodiscard]] SIVID_DECL svg draw_plane_plot(plane_series const& s,
                                             plane_plot_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/plane_plot.ipp>
#endif

#endif
