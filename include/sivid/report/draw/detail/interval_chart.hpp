// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_DETAIL_INTERVAL_CHART_HPP
#define SIVID_REPORT_DRAW_DETAIL_INTERVAL_CHART_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/report/draw/legend.hpp>
#include <sivid/report/draw/ticks.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace sivid::report {

/// One parameter: what was known before, and what is left.
struct interval_row {
    std::string name{};
    std::string unit{};
    range prior{};
    range hull{};
    std::optional<double> witness{};
};

struct interval_chart_options {
    double width = 740;
    std::string title{};
};

/// For each parameter its prior as a grey bar and its hull as a coloured bar on it, each row on its
/// own scale, with the numbers of both.
[[nodiscard]] SIVID_DECL svg draw_interval_chart(std::vector<interval_row> const& rows,
                                                 interval_chart_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/interval_chart.ipp>
#endif

#endif
