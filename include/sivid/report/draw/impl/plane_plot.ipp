// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_PLANE_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_PLANE_PLOT_IPP

#include <sivid/report/draw/plane_plot.hpp>

namespace sivid::report {

SIVID_DECL std::vector<legend_entry> plane_plot_legend(plane_series const& s) {
    return legend_of({{!s.tube.empty(), {symbol::tube, "proven enclosure of the motion"}},
                      {!s.measured.empty(), {symbol::measured_box, "measured position"}},
                      {!s.reference.empty(), {symbol::reference, "reference, not validated"}},
                      {!s.poses.empty(), {symbol::heading, "heading on the reference"}}});
}

namespace detail {

SIVID_DECL std::vector<plane_box> joined(std::vector<plane_box> boxes, std::size_t most) {
    while (boxes.size() > std::max<std::size_t>(most, 1)) {
        std::size_t n = 0;
        for (std::size_t i = 0; i < boxes.size(); i += 2) {
            plane_box const& next = boxes[std::min(i + 1, boxes.size() - 1)];
            boxes[n++] = {hull(boxes[i].x, next.x), hull(boxes[i].y, next.y)};
        }
        boxes.resize(n);
    }
    return boxes;
}

inline void add_box(path_data& d, axes const& a, plane_box const& b, double least) {
    double const x = a.px(b.x.lo), y = a.py(b.y.hi);
    double const w = a.px(b.x.hi) - x, h = a.py(b.y.lo) - y;
    double const more_w = std::max(0.0, least - w), more_h = std::max(0.0, least - h);
    d.rect(x - more_w / 2, y - more_h / 2, w + more_w, h + more_h);
}

} // namespace detail

SIVID_DECL svg draw_plane_plot(plane_series const& s, plane_plot_options const& o) {
    svg out{o.width, o.height, o.title.empty() ? s.y_name + " against " + s.x_name : o.title};
    range xs;
    range ys;
    auto const include = [&](plane_box const& b) {
        if (is_finite(b.x) && is_finite(b.y)) {
            xs = hull(xs, b.x);
            ys = hull(ys, b.y);
        }
    };
    for (plane_box const& b : s.measured) include(b);
    for (point const& p : s.reference) include({{p.x, p.x}, {p.y, p.y}});
    // A tube that bursts must not hide the measurements.
    range const x_core = xs, y_core = ys;
    for (plane_box const& b : s.tube) include(b);
    if (!is_empty(x_core)) {
        double const room = std::max({approximate_width(x_core), approximate_width(y_core), 1e-9});
        xs = intersect(xs, {x_core.lo - room, x_core.hi + room});
        ys = intersect(ys, {y_core.lo - room, y_core.hi + room});
    }
    axes const a{{s.x_name, s.unit, with_margin(axis_range(xs), 0.04)},
                 {s.y_name, s.unit, with_margin(axis_range(ys), 0.08)},
                 {.width = o.width, .height = o.height, .title = o.title, .equal_aspect = true}};
    a.open(out);
    constexpr std::size_t most_boxes = 4000;
    path_data boxes;
    for (plane_box const& b : detail::joined(s.tube, most_boxes)) {
        if (!is_empty(b.x) && !is_empty(b.y)) detail::add_box(boxes, a, b, 1.2);
    }
    // One path: where boxes overlap, the colour does not add up.
    out.path(boxes,
             {.fill = palette::tube, .stroke = palette::tube_edge, .width = 0.5, .opacity = 0.6});
    path_data line;
    bool down = false;
    for (point const& p : s.reference) {
        if (is_finite(p)) down ? line.line(a.px(p.x), a.py(p.y)) : line.move(a.px(p.x), a.py(p.y));
        down = is_finite(p);
    }
    out.path(line, {.stroke = palette::truth, .width = 1.5, .dash = "5 3"});
    path_data measured;
    for (plane_box const& b : detail::joined(s.measured, most_boxes)) {
        if (is_finite(b.x) && is_finite(b.y)) detail::add_box(measured, a, b, 3);
    }
    out.path(measured, {.stroke = palette::measurement, .width = 1});
    path_data arrows;
    for (pose const& p : s.poses) {
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.heading)) {
            add_arrowhead(arrows, a.px(p.x), a.py(p.y), p.heading);
        }
    }
    out.path(arrows, {.fill = palette::paper, .stroke = palette::truth, .width = 1.2},
             "heading, not validated");
    if (!s.reference.empty() && is_finite(s.reference.front())) {
        point const& start = s.reference.front();
        out.circle(a.px(start.x), a.py(start.y), 4, {.fill = palette::ink}, "start");
        double const wide = approximate_text_width("start", 11) + 6;
        out.rect(a.px(start.x) - wide / 2, a.py(start.y) - 20, wide, 14,
                 {.fill = palette::paper, .opacity = 0.8}, 3);
        out.text(a.px(start.x), a.py(start.y) - 9, "start", {.size = 11, .align = anchor::middle});
    }
    a.close(out);
    if (boxes.empty() && measured.empty() && line.empty()) a.say(out, "no data");
    return out;
}

} // namespace sivid::report

#endif
