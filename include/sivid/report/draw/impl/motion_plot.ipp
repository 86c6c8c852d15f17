// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_MOTION_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_MOTION_PLOT_IPP

#include <sivid/report/draw/detail/motion_plot.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/palette.hpp>
#include <sivid/report/draw/time_plot.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace sivid::report {

SIVID_DECL std::vector<legend_entry> motion_plot_legend(std::vector<motion_series> const& all,
                                                        std::string const& full) {
    auto const any = [&](auto const& has) { return std::any_of(all.begin(), all.end(), has); };
    return legend_of({{any([](motion_series const& m) { return !m.tube.tube.empty(); }),
                       {symbol::tube, "all parameters and starts (proved)"}},
                      {any([](motion_series const& m) { return !m.single.empty(); }),
                       {symbol::line_after, full}},
                      {any([](motion_series const& m) { return !m.tube.reference.empty(); }),
                       {symbol::line_before, "least squares, not validated"}}});
}

SIVID_DECL svg draw_motion_plot(motion_series const& m, time_plot_options const& o) {
    auto all = m.tube;
    all.reference.insert(all.reference.end(), m.single.begin(), m.single.end());
    auto values = detail::value_range(all);
    if (m.zero) {
        values = hull(values, 0.0);
        values = with_margin(values, 0.03);
    }
    svg out{o.width, o.height, (o.title.empty() ? m.tube.name : o.title) + " over time"};
    auto const a = detail::time_axes(o, detail::time_range(all), m.tube.time_unit,
                                     {m.tube.name, m.tube.unit, values});
    a.open(out);
    if (m.zero) {
        double const y = a.py(0);
        out.rect(a.left(), y, a.right() - a.left(), std::max(0.0, a.bottom() - y),
                 {.fill = palette::outlier, .opacity = 0.10}, 0, "violated below this line");
    }
    detail::draw_tube(out, a, m.tube.tube);
    if (m.zero)
        out.line(a.left(), a.py(0), a.right(), a.py(0), {.stroke = palette::ink, .width = 1.3});
    detail::draw_reference(out, a, m.tube.reference, line_before_paint);
    detail::draw_reference(out, a, m.single, line_after_paint);
    a.close(out);
    return out;
}

} // namespace sivid::report

#endif
