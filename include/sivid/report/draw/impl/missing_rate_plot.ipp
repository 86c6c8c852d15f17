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
    return legend_of({{line, {symbol::line_after, "estimate"}},
                      {band, {symbol::prior, "its uncertainty (estimate)"}},
                      {box, {symbol::certified_window, "window mean without zero (proved)"}},
                      {idle, {symbol::measured_box, "window mean that may be zero (proved)"}}});
}

SIVID_DECL svg draw_missing_rate(missing_rate_series const& s, time_plot_options const& o,
                                 range values) {
    channel_series plain{.tube = s.certified};
    for (rate_sample const& p : s.estimate) plain.reference.push_back({p.time, p.value});
    svg out{o.width, o.height,
            "missing in " + s.equation + " over time" + (o.title.empty() ? "" : ", " + o.title)};
    auto const a = detail::time_axes(
        o, detail::time_range(plain), s.time_unit,
        {"missing in " + s.equation, s.unit, is_empty(values) ? detail::rate_range(s) : values});
    a.open(out);
    detail::draw_rate_band(out, a, s.estimate);
    out.line(a.left(), a.py(0), a.right(), a.py(0), {.stroke = palette::ink, .width = 1.1});
    for (tube_piece const& t : s.certified) {
        if (is_empty(t.value) || !(t.from <= t.to)) continue;
        double const left = a.px(t.from), top = a.py(t.value.hi);
        double const wide = std::max(a.px(t.to) - left, 1.0);
        double const high = std::max(a.py(t.value.lo) - top, 1.5);
        std::string const tip = given_text(t.from) + " to " + given_text(t.to) +
                                unit_suffix(s.time_unit) + ": " + outward_text(t.value) +
                                unit_suffix(s.unit) + ", proved";
        bool const zero = t.value.lo <= 0 && t.value.hi >= 0;
        if (zero) {
            out.rect(left, top, wide, high, {.stroke = palette::measurement}, 0, tip);
        } else {
            out.rect(left, top, wide, high, {.fill = palette::inside, .opacity = 0.28}, 0, tip);
            out.rect(left, top, wide, high, {.stroke = palette::inside, .width = 1.6});
        }
    }
    detail::draw_reference(out, a, plain.reference, line_after_paint);
    a.close(out);
    if (s.estimate.empty() && s.certified.empty()) a.say(out, "nothing known", a.top() + 16);
    return out;
}

} // namespace sivid::report

#endif
