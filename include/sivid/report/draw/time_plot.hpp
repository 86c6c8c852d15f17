// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_TIME_PLOT_HPP
#define SIVID_REPORT_DRAW_TIME_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/channel_series.hpp>
#include <sivid/report/draw/legend.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::report {

struct time_plot_options {
    double width = 360;
    double height = 230;
    std::string title{};
    range time{};                   ///< empty: what the data need
    bool legend = false;            ///< draw the legend below (for a picture that stands alone)
    std::size_t most_samples = 400; ///< more are thinned evenly; outliers are always drawn
};

/// The legend of time plots, with the symbols that the series use.
[[nodiscard]] SIVID_DECL std::vector<legend_entry>
time_plot_legend(std::vector<channel_series> const& all);

namespace detail {

/// A frame over time.
[[nodiscard]] inline axes time_axes(time_plot_options const& o, range const& time,
                                    std::string const& unit, axis y) {
    return {{"time", unit, is_empty(o.time) ? time : o.time},
            std::move(y),
            {.width = o.width, .height = o.height, .title = o.title}};
}

/// Draws bars for the regular samples, one in `stride`. @returns the others
SIVID_DECL std::vector<measured_sample const*> draw_regular(svg& out, axes const& a,
                                                            channel_series const& c,
                                                            std::size_t stride,
                                                            std::string_view colour);

/// Draws the tube: one outline for each run without a gap; pieces thinner than half a unit of the
/// drawing are joined by their hull, so the picture never shows less than the tube.
SIVID_DECL void draw_tube(svg& out, axes const& a, std::vector<tube_piece> const& tube);

SIVID_DECL void draw_reference(svg& out, axes const& a, std::vector<point> const& line,
                               paint const& how = {
                                   .stroke = palette::truth, .width = 1.2, .dash = "5 3"});

/// Draws the symbol of a marked sample, or an arrow at the frame when it lies outside.
SIVID_DECL void draw_outlier(svg& out, axes const& a, measured_sample const& m, double middle,
                             std::string_view tip);

} // namespace detail

/// Measured intervals over time as bars, the proven tube as a band, outliers marked, and a
/// reference line that is not validated: the report's Figure 4.1.
/// @cost  O(samples + pieces); the text grows with neither beyond a few hundred marks
[[nodiscard]] SIVID_DECL svg draw_time_plot(channel_series const& c,
                                            time_plot_options const& o = {});

/// True when a sample can be compared with the model: both intervals finite, the bound above zero.
[[nodiscard]] SIVID_DECL bool has_residual(measured_sample const& m);

/// The model's enclosure in units of the measurement's own bound, for drawing:
///   \f$ (\text{enclosure} - \text{mid}) / \text{rad} \f$; inside [-1, 1] the sample is met.
[[nodiscard]] SIVID_DECL range approximate_residual(measured_sample const& m);

/// Where the model's enclosure lies within each measured interval: 0 is its middle, +-1 its ends.
/// What a time plot hides in a line as thin as a pixel is seen here.
[[nodiscard]] SIVID_DECL svg draw_residual_plot(channel_series const& c,
                                                time_plot_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/time_plot.ipp>
#endif

#endif
