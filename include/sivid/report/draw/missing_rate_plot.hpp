// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_MISSING_RATE_PLOT_HPP
#define SIVID_REPORT_DRAW_MISSING_RATE_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/channel_series.hpp>
#include <sivid/report/draw/legend.hpp>
#include <sivid/report/draw/time_plot.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sivid::report {

/// An estimate at one time with its uncertainty; none of it is proved.
struct rate_sample {
    double time = 0;
    double value = 0;
    range band{}; ///< empty: not known
};

/// What one equation lacks in one scenario, over time.
struct missing_rate_series {
    std::string equation{};
    std::string scenario{};
    std::string unit{};
    std::vector<rate_sample> estimate{};
    std::vector<tube_piece> certified{}; ///< proved bounds of the mean over each window
    std::string time_unit = "s";
};

namespace detail {

/// The range worth showing: the estimate and the boxes' nearest ends decide, the rest may stretch
/// it by at most its own width on each side; always with zero.
SIVID_DECL range rate_range(missing_rate_series const& s);

} // namespace detail

[[nodiscard]] SIVID_DECL std::vector<legend_entry>
missing_rate_legend(std::vector<missing_rate_series> const& all);

/// The estimated curve with its band, and certified windows as boxes [from, to] x [missing].
[[nodiscard]] SIVID_DECL svg draw_missing_rate(missing_rate_series const& s,
                                               time_plot_options const& o = {}, range values = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/missing_rate_plot.ipp>
#endif

#endif
