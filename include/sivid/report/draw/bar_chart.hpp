// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_BAR_CHART_HPP
#define SIVID_REPORT_DRAW_BAR_CHART_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/draw/ticks.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace sivid::report {

/// One bar: a non-negative quantity known within an interval. The bar is full up to the lower
/// bound and hatched up to the upper one; an infinite upper bound runs to the frame.
struct bar {
    std::string label{};
    range value{};
    std::string note{}; ///< shown after the numbers
};

struct bar_chart_options {
    double width = 740;
    std::string title{};
    std::string quantity{}; ///< the axis label
    std::string unit{};
    std::optional<double> threshold{}; ///< a dashed line, e.g. inflation 1
    std::string threshold_label{};
};

/// Horizontal bars of bounded quantities, with their numbers, and a threshold line.
[[nodiscard]] SIVID_DECL svg draw_bar_chart(std::vector<bar> const& bars,
                                            bar_chart_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/bar_chart.ipp>
#endif

#endif
