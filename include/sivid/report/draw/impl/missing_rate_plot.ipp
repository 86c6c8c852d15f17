// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_MISSING_RATE_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_MISSING_RATE_PLOT_IPP

#include <sivid/report/draw/missing_rate_plot.hpp>

namespace sivid::report {

namespace detail {

SIVID_DECL range rate_range(missing_rate_series const& s) {
    range core{0, 0};
    range rest{0, 0};
    for (rate_sample const& p : s.estimate) {
        core = hull(core, p.value);
        rest = hull(hull(rest, p.band.lo), p.band.hi);
    }
    for (tube_piece const& t : s.certified) {
        if (is_empty(t.value)) continue;
        double const nearest = t.value.lo > 0 ? t.value.lo : t.value.hi < 0 ? t.value.hi : 0;
        core = hull(core, nearest);
        rest = hull(hull(rest, t.value.lo), t.value.hi);
    }
    range const scale = axis_range(core.lo == core.hi ? rest : core);
    range const most = with_margin(scale, 1);
    range const wanted = hull(
        scale, range{std::clamp(rest.lo, most.lo, most.hi), std::clamp(rest.hi, most.lo, most.hi)});
    return with_margin(wanted, 0.06);
}

inline range rate_times(missing_rate_series const& s) {
    range out;
    for (rate_sample const& p : s.estimate) out = hull(out, p.time);
    for (tube_piece const& t : s.certified) out = hull(hull(out, t.from), t.to);
    return with_margin(axis_range(out), 0.015);
}

inline void draw_rate_band(svg& out, axes const& a, std::vector<rate_sample> const& all) {
    path_data band;
    std::vector<rate_sample const*> run;
    auto const flush = [&] {
        if (run.size() > 1) {
            band.move(a.px(run.front()->time), a.py(run.front()->band.hi));
            for (rate_sample const* p : run) band.line(a.px(p->time), a.py(p->band.hi));
            for (auto p = run.rbegin(); p != run.rend(); ++p) {
                band.line(a.px((*p)->time), a.py((*p)->band.lo));
            }
            band.close();
        }
        run.clear();
    };
    for (rate_sample const& p : all) {
        if (is_empty(p.band) || !std::isfinite(p.time)) {
            flush();
        } else {
            run.push_back(&p);
        }
    }
    flush();
    out.path(band, {.fill = palette::prior, .opacity = 0.75});
}

} // namespace detail

SIVID_DECL std::vector<legend_entry>
missing_rate_legend(std::vector<missing_rate_series> const& all) {
    bool line = false, band = false, box = false, idle = false;
    for (missing_rate_series const& s : all) {
        line = line || !s.estimate.empty();
        for (rate_sample const& p : s.estimate) band = band || !is_empty(p.band);
        for (tube_piece const& t : s.certified) {
            bool const zero = t.value.lo <= 0 && t.value.hi >= 0;
            (zero ? idle : box) = true;
        }
    }
    std::vector<legend_entry> out;
    if (line) out.push_back({symbol::line_after, "estimate"});
    if (band) out.push_back({symbol::prior, "its uncertainty (estimate)"});
    if (box) out.push_back({symbol::certified_window, "window mean without zero (proved)"});
    if (idle) out.push_back({symbol::measured_box, "window mean that may be zero (proved)"});
    return out;
}

SIVID_DECL svg draw_missing_rate(missing_rate_series const& s, time_plot_options const& o,
                                 range values) {
    svg out{o.width, o.height,
            "missing in " + s.equation + " over time" + (o.title.empty() ? "" : ", " + o.title)};
    axes const a{
        {"time", "s", is_empty(o.time) ? detail::rate_times(s) : o.time},
        {"missing in " + s.equation, s.unit, is_empty(values) ? detail::rate_range(s) : values},
        {.width = o.width, .height = o.height, .title = o.title}};
    a.draw_ground(out);
    out.clip(a.left(), a.top(), a.right() - a.left(), a.bottom() - a.top());
    detail::draw_rate_band(out, a, s.estimate);
    out.line(a.left(), a.py(0), a.right(), a.py(0), {.stroke = palette::ink, .width = 1.1});
    for (tube_piece const& t : s.certified) {
        if (is_empty(t.value) || !(t.from <= t.to)) continue;
        double const left = a.px(t.from), top = a.py(t.value.hi);
        double const wide = std::max(a.px(t.to) - left, 1.0);
        double const high = std::max(a.py(t.value.lo) - top, 1.5);
        std::string const tip = given_text(t.from) + " to " + given_text(t.to) + " s" + ": " +
                                outward_text(t.value) + unit_suffix(s.unit) + ", proved";
        bool const zero = t.value.lo <= 0 && t.value.hi >= 0;
        if (zero) {
            out.rect(left, top, wide, high, {.stroke = palette::measurement}, 0, tip);
        } else {
            out.rect(left, top, wide, high, {.fill = palette::inside, .opacity = 0.28}, 0, tip);
            out.rect(left, top, wide, high, {.stroke = palette::inside, .width = 1.6});
        }
    }
    std::vector<point> line;
    for (rate_sample const& p : s.estimate) line.push_back({p.time, p.value});
    detail::draw_reference(out, a, line, line_after_paint);
    out.close();
    a.draw_frame(out);
    if (s.estimate.empty() && s.certified.empty()) {
        out.text((a.left() + a.right()) / 2, a.top() + 16, "nothing known",
                 {.size = 12, .align = anchor::middle, .fill = palette::muted_ink});
    }
    return out;
}

} // namespace sivid::report

#endif
