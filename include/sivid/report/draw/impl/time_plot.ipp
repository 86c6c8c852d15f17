// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_TIME_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_TIME_PLOT_IPP

#include <sivid/report/draw/time_plot.hpp>

namespace sivid::report {

SIVID_DECL std::vector<legend_entry> time_plot_legend(std::vector<channel_series> const& all) {
    bool measured = false, forced = false, suspect = false, tube = false, reference = false;
    for (channel_series const& c : all) {
        tube = tube || !c.tube.empty();
        reference = reference || !c.reference.empty();
        for (measured_sample const& m : c.measured) {
            measured = measured || m.state == sample_state::regular;
            forced = forced || m.state == sample_state::forced_outlier;
            suspect = suspect || m.state == sample_state::suspect;
        }
    }
    return legend_of({{measured, {symbol::measured, "measured interval"}},
                      {tube, {symbol::tube, "proven enclosure of the model"}},
                      {forced, {symbol::forced_outlier, "outlier (proved)"}},
                      {suspect, {symbol::suspect, "suspected outlier"}},
                      {reference, {symbol::reference, "reference, not validated"}}});
}

namespace detail {

SIVID_DECL std::vector<measured_sample const*> draw_regular(svg& out, axes const& a,
                                                            channel_series const& c,
                                                            std::size_t stride,
                                                            std::string_view colour) {
    std::vector<measured_sample const*> marked;
    for (std::size_t i = 0; i < c.measured.size(); ++i) {
        measured_sample const& m = c.measured[i];
        if (!is_finite(m.value) || !std::isfinite(m.time)) continue;
        if (m.state != sample_state::regular) {
            marked.push_back(&m);
        } else if (i % stride == 0) {
            draw_measured(out, a.px(m.time), a.py(m.value.lo), a.py(m.value.hi), colour,
                          stride == 1 ? sample_tip(c, m) : "");
        }
    }
    return marked;
}

SIVID_DECL void draw_tube(svg& out, axes const& a, std::vector<tube_piece> const& tube) {
    struct column {
        double left, right, top, bottom;
    };
    std::vector<column> run;
    path_data band;
    path_data edge;
    auto const flush = [&] {
        if (run.empty()) return;
        band.move(run.front().left, run.front().top);
        edge.move(run.front().left, run.front().top);
        for (column const& c : run) {
            band.line(c.left, c.top).line(c.right, c.top);
            edge.line(c.left, c.top).line(c.right, c.top);
        }
        edge.move(run.back().right, run.back().bottom);
        for (auto c = run.rbegin(); c != run.rend(); ++c) {
            band.line(c->right, c->bottom).line(c->left, c->bottom);
            edge.line(c->right, c->bottom).line(c->left, c->bottom);
        }
        band.close();
        run.clear();
    };
    for (tube_piece const& t : tube) {
        if (is_empty(t.value) || !(t.from <= t.to)) continue;
        column c{a.px(t.from), a.px(t.to), a.py(t.value.hi), a.py(t.value.lo)};
        double const thin = std::max(0.0, 1.2 - (c.bottom - c.top)) / 2;
        c.top -= thin;
        c.bottom += thin;
        if (!run.empty() && std::abs(c.left - run.back().right) > 0.02) flush();
        if (!run.empty() && run.back().right - run.back().left < 0.5) {
            run.back() = {run.back().left, c.right, std::min(c.top, run.back().top),
                          std::max(c.bottom, run.back().bottom)};
        } else {
            run.push_back(c);
        }
    }
    flush();
    out.path(band, {.fill = palette::tube, .opacity = 0.45});
    out.path(edge, {.stroke = palette::tube_edge, .width = 0.8});
}

SIVID_DECL void draw_reference(svg& out, axes const& a, std::vector<point> const& line,
                               paint const& how) {
    path_data d;
    bool pen_down = false;
    double last_x = 0, last_y = 0;
    for (point const& p : line) {
        if (!is_finite(p)) {
            pen_down = false;
            continue;
        }
        double const x = a.px(p.x), y = a.py(p.y);
        if (pen_down && std::abs(x - last_x) + std::abs(y - last_y) < 0.5) continue;
        pen_down ? d.line(x, y) : d.move(x, y);
        pen_down = true;
        last_x = x;
        last_y = y;
    }
    out.path(d, how);
}

SIVID_DECL void draw_outlier(svg& out, axes const& a, measured_sample const& m, double middle,
                             std::string_view tip) {
    double const y = a.py(middle);
    bool const above = y < a.top() + 6;
    bool const below = y > a.bottom() - 6;
    double const shown = std::clamp(y, a.top() + 12, a.bottom() - 12);
    m.state == sample_state::forced_outlier ? draw_forced_outlier(out, a.px(m.time), shown, tip)
                                            : draw_suspect(out, a.px(m.time), shown, tip);
    if (above || below) {
        draw_beyond(out, a.px(m.time), above ? shown - 6 : shown + 6, above,
                    m.state == sample_state::forced_outlier ? palette::outlier : palette::suspect);
    }
}

/// Says that regular samples are left out.
inline void say_stride(svg& out, axes const& a, std::size_t stride) {
    if (stride == 1) return;
    out.text(a.right(), a.top() - 11, "1 in " + std::to_string(stride) + " drawn",
             {.size = 10, .align = anchor::end, .fill = palette::muted_ink});
}

} // namespace detail

SIVID_DECL svg draw_time_plot(channel_series const& c, time_plot_options const& o) {
    auto const entries = o.legend ? time_plot_legend({c}) : std::vector<legend_entry>{};
    svg measure{0, 0, ""};
    double const below = draw_legend(measure, entries, 0, 0, o.width - 60);
    svg out{o.width, o.height + below, (o.title.empty() ? c.name : o.title) + " over time"};
    auto const a = detail::time_axes(o, detail::time_range(c), c.time_unit,
                                     {c.name, c.unit, detail::value_range(c)});
    a.open(out);
    detail::draw_tube(out, a, c.tube);
    detail::draw_reference(out, a, c.reference);

    std::size_t const stride = c.measured.size() / std::max<std::size_t>(o.most_samples, 1) + 1;
    auto const marked = detail::draw_regular(out, a, c, stride, palette::measurement);
    for (std::size_t i = 0; i < marked.size(); ++i) {
        measured_sample const& m = *marked[i];
        draw_measured(out, a.px(m.time), a.py(m.value.lo), a.py(m.value.hi), palette::outlier);
        if (i < 4 * o.most_samples) {
            detail::draw_outlier(out, a, m, approximate_middle(m.value), detail::sample_tip(c, m));
        }
    }
    a.close(out);
    if (c.measured.empty() && c.tube.empty() && c.reference.empty()) {
        a.say(out, "no data");
    } else {
        detail::say_stride(out, a, stride);
    }
    draw_legend(out, entries, a.left(), o.height + 4, o.width - 60);
    return out;
}

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
    auto const a =
        detail::time_axes(o, detail::time_range(c), c.time_unit, {"model / bound", "", shown});
    a.open(out);
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
        if (!has_residual(m) || (m.state == sample_state::regular && i % stride != 0)) continue;
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
    a.close(out);
    if (drawn == 0) {
        a.say(out, "no enclosure at the samples", a.py(0) + 4);
    } else {
        detail::say_stride(out, a, stride);
    }
    return out;
}

} // namespace sivid::report

#endif
