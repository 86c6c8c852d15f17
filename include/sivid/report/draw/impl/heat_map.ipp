// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_HEAT_MAP_IPP
#define SIVID_REPORT_DRAW_IMPL_HEAT_MAP_IPP

#include <sivid/report/draw/heat_map.hpp>

namespace sivid::report {

SIVID_DECL double largest_value(heat_map const& m) {
    double largest = 0;
    for (auto const& row : m.values) {
        for (double const v : row) largest = std::isfinite(v) ? std::max(largest, v) : largest;
    }
    return largest;
}

SIVID_DECL svg draw_heat_map(heat_map const& m, heat_map_options const& o) {
    double const top = o.title.empty() ? 10 : 34;
    double const pitch = 26;
    double const bottom =
        top + pitch * static_cast<double>(std::max<std::size_t>(m.rows.size(), 1));
    svg out{o.width, bottom + (o.key ? 84 : 42), o.title.empty() ? m.quantity : o.title};
    double label_width = 30;
    for (std::string const& name : m.rows) {
        label_width = std::max(label_width, approximate_text_width(shorten(name, 24), 12));
    }
    double const left = std::min(label_width + 12, o.width * 0.4), right = o.width - 14;
    range span;
    for (double const t : m.times) span = hull(span, t);
    span = axis_range(span);
    double largest = largest_value(m);
    double const full = m.threshold > 0 ? m.threshold : 1;
    largest = std::isfinite(o.largest) ? std::max(largest, o.largest) : largest;
    // Beyond a thousand times the threshold all is one colour, so that one wild value leaves the
    // others told apart.
    double const excess = std::clamp(largest, 2 * full, 1000 * full);
    // Below the threshold linear; above it logarithmic, since a gap may be a hundred times its
    // bound.
    auto const colour = [&](double v) {
        return v <= full
                   ? blue_ramp.at(v / full * 0.8)
                   : orange_ramp.at(std::log(std::min(v, excess) / full) / std::log(excess / full));
    };
    auto const px = [&](double t) {
        return left + (right - left) * std::clamp((t - span.lo) / (span.hi - span.lo), 0.0, 1.0);
    };
    if (!o.title.empty()) out.text(0, 16, o.title, {.size = 13, .bold = true});
    std::string const unknown = out.hatch("#ffffff", palette::grid);
    out.rect(left, top, right - left, bottom - top, {.fill = unknown});
    path_data crosses;
    for (std::size_t r = 0; r < m.rows.size(); ++r) {
        double const y = top + pitch * static_cast<double>(r);
        out.text(left - 8, y + 17, shorten(m.rows[r], 24), {.size = 12, .align = anchor::end});
        for (std::size_t c = 0;
             r < m.values.size() && c < m.values[r].size() && c + 1 < m.times.size(); ++c) {
            double const v = m.values[r][c];
            double const x = px(m.times[c]), w = px(m.times[c + 1]) - x;
            if (std::isnan(v) || std::isnan(x) || std::isnan(w)) continue;
            std::string const fill = colour(v);
            out.rect(x, y, w + 0.3, pitch, {.fill = fill}, 0,
                     m.times.size() < 120 ? m.rows[r] + ": " + rounded_text(v, rounding::nearest)
                                          : std::string{});
            if (v > full && w > 5) {
                double const mx = x + w / 2, my = y + pitch / 2;
                crosses.move(mx - 2.5, my - 2.5)
                    .line(mx + 2.5, my + 2.5)
                    .move(mx - 2.5, my + 2.5)
                    .line(mx + 2.5, my - 2.5);
            }
        }
    }
    out.path(crosses, {.stroke = palette::paper, .width = 3, .opacity = 0.75});
    out.path(crosses, {.stroke = palette::ink, .width = 1.2});
    path_data rules;
    for (std::size_t r = 0; r + 1 < m.rows.size(); ++r) {
        rules.move(left, top + pitch * static_cast<double>(r + 1))
            .line(right, top + pitch * static_cast<double>(r + 1));
    }
    out.path(rules, {.stroke = palette::paper, .width = 2});
    out.path(path_data{}.rect(left, top, right - left, bottom - top), {.stroke = palette::frame});
    for (tick const& t :
         nice_ticks(span, std::clamp(static_cast<int>((right - left) / 70), 2, 12)).ticks) {
        out.line(px(t.value), bottom, px(t.value), bottom + 4, {.stroke = palette::frame});
        out.text(px(t.value), bottom + 16, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.text((left + right) / 2, bottom + 33, "time [" + unit_text(m.time_unit) + "]",
             {.size = 11.5, .align = anchor::middle});

    if (!o.key) return out;
    // The colour bar: left half up to the threshold, right half beyond.
    double const bar_y = bottom + 50, bar_width = std::min(260.0, right - left),
                 half = bar_width / 2;
    for (int i = 0; i < 24; ++i) {
        double const s = i / 24.0;
        std::string const low = blue_ramp.at(s * 0.8), high = orange_ramp.at(s);
        out.rect(left + s * half, bar_y, half / 24 + 0.3, 10, {.fill = low});
        out.rect(left + half + s * half, bar_y, half / 24 + 0.3, 10, {.fill = high});
    }
    auto const mark = [&](double x, double v, anchor align) {
        out.text(x, bar_y + 23,
                 (largest > v && v == excess ? "\xE2\x89\xA5 " : "") +
                     rounded_text(v, rounding::nearest, {.significant = 2, .shift = 0}),
                 {.size = 10.5, .align = align, .fill = palette::muted_ink});
    };
    mark(left, 0, anchor::start);
    mark(left + half, full, anchor::middle);
    mark(left + bar_width, excess, anchor::end);
    out.text(left + bar_width + 12, bar_y + 9, m.quantity, {.size = 11.5});
    return out;
}

} // namespace sivid::report

#endif
