// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_RESIDUAL_PLOT_HPP
#define SIVID_REPORT_DRAW_RESIDUAL_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/time_plot.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

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
#include <sivid/report/draw/impl/residual_plot.ipp>
#endif

#endif
