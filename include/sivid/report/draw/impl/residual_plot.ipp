// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_RESIDUAL_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_RESIDUAL_PLOT_IPP

#include <sivid/report/draw/residual_plot.hpp>

namespace sivid::report {

SIVID_DECL bool has_residual(measured_sample const& m) {
    return is_finite(m.value) && is_finite(m.enclosure) && approximate_width(m.value) > 0;
}

SIVID_DECL range approximate_residual(measured_sample const& m) {
    double const middle = approximate_middle(m.value);
    double const half = approximate_width(m.value) / 2;
    return {(m.enclosure.lo - middle) / half, (m.enclosure.hi - middle) / half};
}

SIVID_DECL svg draw_residual_plot(channel_series const& c, time_plot_options const& o) {
    svg out{o.width, o.height, (o.title.empty() ? c.name : o.title) + " against its bounds"};
    range shown{-1.3, 1.3};
    for (measured_sample const& m : c.measured) {
        if (has_residual(m)) {
            range const r = with_margin(approximate_residual(m), 0.05);
            shown = hull(hull(shown, std::clamp(r.lo, -4.0, 4.0)), std::clamp(r.hi, -4.0, 4.0));
        }
    }
    axes const a{{"time", "s", is_empty(o.time) ? detail::time_range(c) : o.time},
                 {"model / bound", "", shown},
                 {.width = o.width, .height = o.height, .title = o.title}};
    a.draw_ground(out);
    out.clip(a.left(), a.top(), a.right() - a.left(), a.bottom() - a.top());
    out.rect(a.left(), a.py(1), a.right() - a.left(), a.py(-1) - a.py(1), {.fill = "#eef2f6"});
    out.path(path_data{}
                 .move(a.left(), a.py(1))
                 .line(a.right(), a.py(1))
                 .move(a.left(), a.py(-1))
                 .line(a.right(), a.py(-1)),
             {.stroke = palette::ink, .width = 1.1});
    std::size_t const stride = c.measured.size() / std::max<std::size_t>(o.most_samples, 1) + 1;
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < c.measured.size(); ++i) {
        measured_sample const& m = c.measured[i];
        if (!has_residual(m) || (m.state == sample_state::regular && i % stride != 0)) {
            continue;
        }
        ++drawn;
        range const r = approximate_residual(m);
        double const top = a.py(r.hi), low = a.py(r.lo), x = a.px(m.time);
        std::string const tip =
            stride == 1 || m.state != sample_state::regular ? detail::sample_tip(c, m) : "";
        if (m.state == sample_state::regular) {
            out.rect(x - 2.4, top - 0.5, 4.8, low - top + 1,
                     {.fill = palette::tube, .stroke = palette::tube_edge, .width = 0.9}, 1, tip);
        } else {
            out.line(x, top, x, low, {.stroke = palette::outlier, .width = 2});
            detail::draw_outlier(out, a, m, approximate_middle(r), tip);
        }
    }
    out.close();
    a.draw_frame(out);
    if (drawn == 0) {
        out.text((a.left() + a.right()) / 2, a.py(0) + 4, "no enclosure at the samples",
                 {.size = 12, .align = anchor::middle, .fill = palette::muted_ink});
    } else if (stride > 1) {
        out.text(a.right(), a.top() - 11, std::string{"1 in "} + std::to_string(stride) + " drawn",
                 {.size = 10, .align = anchor::end, .fill = palette::muted_ink});
    }
    return out;
}

} // namespace sivid::report

#endif
