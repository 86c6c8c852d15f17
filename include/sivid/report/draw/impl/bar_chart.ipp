// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_BAR_CHART_IPP
#define SIVID_REPORT_DRAW_IMPL_BAR_CHART_IPP

#include <sivid/report/draw/bar_chart.hpp>

namespace sivid::report {

SIVID_DECL svg draw_bar_chart(std::vector<bar> const& bars, bar_chart_options const& o) {
    double const top = o.title.empty() ? 20 : 44;
    double const pitch = 28;
    double const bottom = top + pitch * static_cast<double>(std::max<std::size_t>(bars.size(), 1));
    svg out{o.width, bottom + 42, o.title.empty() ? o.quantity : o.title};
    double label_width = 30, note_width = 20;
    range shown{0, 0};
    for (bar const& b : bars) {
        label_width = std::max(label_width, approximate_text_width(shorten(b.label, 36), 12));
        note_width =
            std::max(note_width, approximate_text_width(outward_text(b.value) + b.note, 11) + 22);
        shown = hull(hull(shown, b.value.lo), b.value.hi);
    }
    if (o.threshold) shown = hull(shown, *o.threshold);
    shown = axis_range({shown.lo, shown.hi + 0.04 * (shown.hi - shown.lo)});
    double const left = std::min(label_width + 12, o.width * 0.4);
    double const right = std::max(o.width - note_width, left + 60);
    auto const px = [&](double v) {
        double const s = (v / 2 - shown.lo / 2) / (shown.hi / 2 - shown.lo / 2);
        return left + (right - left) * (std::isnan(s) ? 0.0 : std::clamp(s, 0.0, 1.0));
    };
    if (!o.title.empty()) out.text(0, 16, o.title, {.size = 13, .bold = true});
    tick_set const ticks =
        nice_ticks(shown, std::clamp(static_cast<int>((right - left) / 70), 2, 10));
    path_data grid;
    for (tick const& t : ticks.ticks) {
        grid.move(px(t.value), top).line(px(t.value), bottom);
        out.text(px(t.value), bottom + 15, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.path(grid, {.stroke = palette::grid});
    struct placed {
        double x, y;
        std::string text;
    };
    std::vector<placed> labels;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        bar const& b = bars[i];
        double const y = top + pitch * static_cast<double>(i);
        out.text(left - 8, y + 18, shorten(b.label, 36), {.size = 12, .align = anchor::end});
        if (is_empty(b.value)) {
            out.text(left + 6, y + 18, "no bound" + (b.note.empty() ? "" : ", " + b.note),
                     {.size = 11, .fill = palette::muted_ink});
            continue;
        }
        double const zero = px(0), low = px(b.value.lo), high = px(b.value.hi);
        out.rect(std::min(zero, low), y + 6, std::abs(low - zero), 16, {.fill = palette::blue});
        out.rect(
            low, y + 6, high - low, 16,
            {.fill = out.hatch("#ffffff", palette::blue), .stroke = palette::blue, .width = 1});
        std::string const label = outward_text(b.value) + (b.note.empty() ? "" : "  " + b.note);
        double const text_x = std::max(high, zero) + 7;
        labels.push_back({text_x, y, label});
    }
    out.line(left, top, left, bottom, {.stroke = palette::frame});
    if (o.threshold) {
        double const x = px(*o.threshold);
        out.line(x, top - 4, x, bottom, {.stroke = palette::black, .width = 1.3, .dash = "4 3"});
        out.text(x, top - 7, o.threshold_label,
                 {.size = 11, .align = x > (left + right) / 2 ? anchor::end : anchor::start});
    }
    // Last and on a light ground, so that the threshold does not strike them through.
    for (placed const& l : labels) {
        out.rect(l.x - 3, l.y + 7, approximate_text_width(l.text, 11) + 4, 14,
                 {.fill = palette::paper, .opacity = 0.85});
        out.text(l.x, l.y + 18, l.text, {.size = 11});
    }
    out.text((left + right) / 2, bottom + 33, axis_text(o.quantity, o.unit, ticks.exponent),
             {.size = 11.5, .align = anchor::middle});
    return out;
}

} // namespace sivid::report

#endif
