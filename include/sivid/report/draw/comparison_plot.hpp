// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_COMPARISON_PLOT_HPP
#define SIVID_REPORT_DRAW_COMPARISON_PLOT_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/heat_map.hpp>
#include <sivid/report/draw/time_plot.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

/// One channel of one scenario with two models. Lines and misfits are not validated.
struct comparison_series {
    std::string name{};
    std::string unit{};
    std::vector<measured_sample> measured{};
    std::vector<point> before{};        ///< (t, value): best fit of the model as it is
    std::vector<point> after{};         ///< (t, value): best fit with the effect
    std::vector<tube_piece> tube{};     ///< predicted with the effect
    std::vector<point> misfit_before{}; ///< (t, |y - m| / bound)
    std::vector<point> misfit_after{};
    std::string time_unit = "s";
};

namespace detail {

/// The channel as a time plot sees it: data and the better line decide on the range shown, the
/// worse line may stretch it a little.
SIVID_DECL channel_series plain_series(comparison_series const& c);

} // namespace detail

/// The legend of comparison plots, with what is in any of them.
/// @param second  what the second model is
[[nodiscard]] SIVID_DECL std::vector<legend_entry>
comparison_legend(std::vector<comparison_series> const& all,
                  std::string const& second = "with the effect");

/// Measured intervals over time, with the model's line before and after an effect is joined.
[[nodiscard]] SIVID_DECL svg draw_comparison_plot(comparison_series const& c,
                                                  time_plot_options const& o = {});

/// How far the channels miss their bounds, over time: each cell holds the largest misfit of the
/// samples in it; a sample of a slow channel reaches half way to its neighbours.
[[nodiscard]] SIVID_DECL heat_map misfit_map(std::vector<comparison_series> const& channels,
                                             bool after, std::size_t most_columns = 60);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/comparison_plot.ipp>
#endif

#endif
