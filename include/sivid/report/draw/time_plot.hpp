// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_TIME_PLOT_HPP
#define SIVID_REPORT_DRAW_TIME_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/number_text.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

/// What is known about one measured interval.
enum class sample_state {
    regular,
    forced_outlier, ///< violated, by proof, by every parameter that explains the data
    suspect         ///< violated by the witness
};

/// One measured interval and, where it is known, the proven enclosure of the model's output then.
struct measured_sample {
    double time = 0;
    range value{};
    sample_state state = sample_state::regular;
    range enclosure{};
};

/// The proven enclosure of a channel over a time span.
struct tube_piece {
    double from = 0;
    double to = 0;
    range value{};
};

/// What is drawn of one quantity over time. What is called proved is; lines are not validated.
struct channel_series {
    std::string name{};
    std::string unit{};
    std::vector<measured_sample> measured{};
    std::vector<tube_piece> tube{}; ///< proved, in order of time
    std::vector<point> reference{}; ///< (t, value): one motion
    std::string time_unit = "s";
    std::vector<point> before{};        ///< the first of two motions that are compared, dashed
    std::vector<point> after{};         ///< the second, or an estimate: a full line
    std::vector<point> misfit_before{}; ///< (t, |y - m| / bound)
    std::vector<point> misfit_after{};
    std::vector<tube_piece> band{};    ///< uncertainty of an estimate, at its times
    std::vector<tube_piece> windows{}; ///< proved bounds of the mean over each window
    bool zero = false;                 ///< draw the line of 0
    bool margin = false;               ///< must not fall below it
};

/// What the parts of a drawing are, in its legend.
struct series_words {
    std::string tube = "proven enclosure of the model";
    std::string before = "model as it is, best fit (estimate)";
    std::string after = "estimate";
};

/// The legend of time plots, with the symbols that the series use.
[[nodiscard]] SIVID_DECL std::vector<legend_entry>
time_plot_legend(std::vector<channel_series> const& all, series_words const& words = {});

/// The time that a plot of the series shows.
[[nodiscard]] SIVID_DECL range time_range(channel_series const& c);
/// The values worth showing: regular measurements and the better lines decide; the tube, outliers
/// and the worse line may stretch it by at most twice its width, so that one wild value does not
/// flatten the rest.
[[nodiscard]] SIVID_DECL range value_range(channel_series const& c);

struct time_plot_options {
    double width = 360;
    double height = 230;
    std::string title{};
    range time{};                   ///< empty: what the data need
    range values{};                 ///< likewise
    bool legend = false;            ///< draw the legend below (for a picture that stands alone)
    std::size_t most_samples = 400; ///< more are thinned evenly; outliers are always drawn
};

/// Measured intervals over time as bars, the proven tube as a band, outliers marked, and lines that
/// are not validated: the report's Figure 4.1.
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
