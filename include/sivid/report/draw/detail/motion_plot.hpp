// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_DETAIL_MOTION_PLOT_HPP
#define SIVID_REPORT_DRAW_DETAIL_MOTION_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/channel_series.hpp>
#include <sivid/report/draw/legend.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/text/range.hpp>

#include <string>
#include <vector>

namespace sivid::report {

/// A predicted quantity: its tube, a dashed line that proves nothing, and a full line of a single
/// motion.
struct motion_series {
    channel_series tube{};       ///< its `reference` is the dashed line
    std::vector<point> single{}; ///< the full line
    bool zero = false;           ///< a margin: draw the line that it must not fall below
};

/// @param full  what the full line is
[[nodiscard]] SIVID_DECL std::vector<legend_entry>
motion_plot_legend(std::vector<motion_series> const& all,
                   std::string const& full = "witness, not validated");

[[nodiscard]] SIVID_DECL svg draw_motion_plot(motion_series const& m,
                                              time_plot_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/motion_plot.ipp>
#endif

#endif
