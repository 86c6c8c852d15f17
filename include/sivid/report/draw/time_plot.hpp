// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_TIME_PLOT_HPP
#define SIVID_REPORT_DRAW_TIME_PLOT_HPP

#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// What is known about one measured interval.
enum class sample_state {
    regular,
    forced_outlier, ///< violated, by proof, by every parameter that explains the data
    suspect         ///< violated by the witness
};

/// One measured interval and, where it is known, the proven enclosure of the model's output then.
struct measured_sample {
    double time = 0;
    range value{};
    sample_state state = sample_state::regular;
    range enclosure{};
};

/// The proven enclosure of a channel over a time span.
struct tube_piece {
    double from = 0;
    double to = 0;
    range value{};
};

/// What is drawn of one quantity over time. What is called proved is; lines are not validated.
struct channel_series {
    std::string name{};
    std::string unit{};
    std::vector<measured_sample> measured{};
    std::vector<tube_piece> tube{}; ///< proved, in order of time
    std::vector<point> reference{}; ///< (t, value): one motion
    std::string time_unit = "s";
    std::vector<point> before{};        ///< the first of two motions that are compared, dashed
    std::vector<point> after{};         ///< the second, or an estimate: a full line
    std::vector<point> misfit_before{}; ///< (t, |y - m| / bound)
    std::vector<point> misfit_after{};
    std::vector<tube_piece> band{};    ///< uncertainty of an estimate, at its times
    std::vector<tube_piece> windows{}; ///< proved bounds of the mean over each window
    bool zero = false;                 ///< draw the line of 0
    bool margin = false;               ///< must not fall below it
};

/// What the parts of a drawing are, in its legend.
struct series_words {
    std::string tube = "proven enclosure of the model";
    std::string before = "model as it is, best fit (estimate)";
    std::string after = "estimate";
};

struct time_plot_options {
    double width = 360;
    double height = 230;
    std::string title{};
    range time{};        ///< empty: what the data need
    range values{};      ///< likewise
    bool legend = false; ///< draw the legend below (for a picture that stands alone)
};

/// The values worth showing: regular measurements and the better lines decide; the tube, outliers
/// and the worse line may stretch it by at most twice its width, so that one wild value does not
/// flatten the rest.
[[nodiscard]] inline range value_range(channel_series const& c) {
    range core;
    range rest;
    for (measured_sample const& m : c.measured) {
        if (is_finite(m.value)) {
            (m.state == sample_state::regular ? core : rest) =
                hull(m.state == sample_state::regular ? core : rest, m.value);
        }
    }
    for (auto const* line : {&c.reference, &c.after})
        for (point const& p : *line) core = hull(core, p.y);
    for (point const& p : c.before)
        (c.measured.empty() ? core : rest) = hull(c.measured.empty() ? core : rest, p.y);
    for (auto const* pieces : {&c.tube, &c.band, &c.windows})
        for (tube_piece const& t : *pieces) rest = hull(hull(rest, t.value.lo), t.value.hi);
    for (tube_piece const& t : c.windows) // the end next to 0
        core = hull(core, t.value.lo > 0 ? t.value.lo : t.value.hi < 0 ? t.value.hi : 0);
    if (c.zero && !c.margin) core = hull(core, 0.0);
    if (is_empty(core) || (c.zero && core.lo == core.hi && !is_empty(rest)))
        core = hull(core, rest);
    if (is_empty(core)) return {0, 1};
    range const most = with_margin(axis_range(core), c.windows.empty() && c.band.empty() ? 2 : 1);
    range shown = core;
    if (!is_empty(rest)) {
        shown = hull(hull(core, std::clamp(rest.lo, most.lo, most.hi)),
                     std::clamp(rest.hi, most.lo, most.hi));
    }
    shown = with_margin(axis_range(shown), 0.06);
    return c.margin ? with_margin(hull(shown, 0.0), 0.03) : shown;
}

/// The time that a plot of the series shows.
[[nodiscard]] inline range time_range(channel_series const& c) {
    range out;
    for (measured_sample const& m : c.measured) out = hull(out, m.time);
    for (auto const* pieces : {&c.tube, &c.windows})
        for (tube_piece const& t : *pieces) out = hull(hull(out, t.from), t.to);
    for (auto const* line : {&c.reference, &c.before, &c.after})
        for (point const& p : *line) out = hull(out, p.x);
    return with_margin(axis_range(out), 0.015);
}

/// The legend of time plots, with the symbols that the series use.
[[nodiscard]] inline std::vector<legend_entry>
time_plot_legend(std::vector<channel_series> const& all, series_words const& words = {}) {
    bool regular = false, forced = false, suspect = false, box = false, idle = false;
    for (channel_series const& c : all) {
        for (measured_sample const& m : c.measured) {
            (m.state == sample_state::regular          ? regular
             : m.state == sample_state::forced_outlier ? forced
                                                       : suspect) = true;
        }
        for (tube_piece const& t : c.windows)
            (t.value.lo <= 0 && t.value.hi >= 0 ? idle : box) = true;
    }
    auto const any = [&all](auto channel_series::*part) {
        return std::any_of(all.begin(), all.end(),
                           [&](auto const& c) { return !(c.*part).empty(); });
    };
    bool const measured = regular || suspect, after = any(&channel_series::after);
    return legend_of(
        {{regular, {symbol::measured, "measured interval"}},
         {any(&channel_series::tube), {symbol::tube, words.tube}},
         {forced, {symbol::forced_outlier, "outlier (proved)"}},
         {suspect, {symbol::suspect, "suspected outlier"}},
         {any(&channel_series::reference), {symbol::reference, "reference, not validated"}},
         {after && !measured, {symbol::line_after, words.after}}, // what counts, first
         {any(&channel_series::before), {symbol::line_before, words.before}},
         {after && measured, {symbol::line_after, words.after}},
         {any(&channel_series::band), {symbol::prior, "its uncertainty (estimate)"}},
         {box, {symbol::certified_window, "window mean without zero (proved)"}},
         {idle, {symbol::measured_box, "window mean that may be zero (proved)"}}});
}

namespace detail {

inline std::string sample_tip(channel_series const& c, measured_sample const& m) {
    std::string tip = "t = " + given_text(m.time) + unit_suffix(c.time_unit) + ": measured " +
                      outward_text(m.value) + ' ' + unit_text(c.unit);
    if (!is_empty(m.enclosure)) tip += ", model within " + outward_text(m.enclosure);
    return tip + (m.state == sample_state::forced_outlier ? ", outlier (proved)"
                  : m.state == sample_state::suspect      ? ", suspected outlier"
                                                          : "");
}

/// A frame over time.
inline axes time_axes(channel_series const& c, time_plot_options const& o, axis y) {
    return {{"time", c.time_unit, is_empty(o.time) ? time_range(c) : o.time},
            std::move(y),
            {.width = o.width, .height = o.height, .title = o.title}};
}

inline constexpr std::size_t most_samples = 400; // more are thinned evenly, but for outliers

/// So many samples for each that is drawn.
inline std::size_t stride_of(channel_series const& c) {
    return c.measured.size() / most_samples + 1;
}

/// Draws the tube: one outline for each run without a gap; pieces thinner than half a unit of the
/// drawing are joined by their hull, so the picture never shows less than the tube.
inline void draw_tube(svg& out, axes const& a, std::vector<tube_piece> const& tube) {
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

inline void draw_line(svg& out, axes const& a, std::vector<point> const& line, paint const& how) {
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

/// Draws the symbol of a marked sample, or an arrow at the frame when it lies outside.
inline void draw_outlier(svg& out, axes const& a, measured_sample const& m, double middle,
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

inline void draw_band(svg& out, axes const& a, std::vector<tube_piece> const& all) {
    path_data band;
    std::vector<tube_piece const*> run;
    auto const flush = [&] {
        if (run.size() > 1) {
            band.move(a.px(run.front()->from), a.py(run.front()->value.hi));
            for (tube_piece const* p : run) band.line(a.px(p->from), a.py(p->value.hi));
            for (auto p = run.rbegin(); p != run.rend(); ++p) {
                band.line(a.px((*p)->from), a.py((*p)->value.lo));
            }
            band.close();
        }
        run.clear();
    };
    for (tube_piece const& p : all) {
        if (is_empty(p.value) || !std::isfinite(p.from)) {
            flush();
        } else {
            run.push_back(&p);
        }
    }
    flush();
    out.path(band, {.fill = palette::prior, .opacity = 0.75});
}

inline void draw_windows(svg& out, axes const& a, channel_series const& c) {
    for (tube_piece const& t : c.windows) {
        if (is_empty(t.value) || !(t.from <= t.to)) continue;
        double const left = a.px(t.from), top = a.py(t.value.hi);
        double const wide = std::max(a.px(t.to) - left, 1.0);
        double const high = std::max(a.py(t.value.lo) - top, 1.5);
        std::string const tip = given_text(t.from) + " to " + given_text(t.to) +
                                unit_suffix(c.time_unit) + ": " + outward_text(t.value) +
                                unit_suffix(c.unit) + ", proved";
        if (t.value.lo <= 0 && t.value.hi >= 0) {
            out.rect(left, top, wide, high, {.stroke = palette::measurement}, 0, tip);
        } else {
            out.rect(left, top, wide, high, {.fill = palette::inside, .opacity = 0.28}, 0, tip);
            out.rect(left, top, wide, high, {.stroke = palette::inside, .width = 1.6});
        }
    }
}

/// Bars of the regular samples, one in a stride. @returns the others
inline std::vector<measured_sample const*> draw_regular(svg& out, axes const& a,
                                                        channel_series const& c, std::size_t stride,
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

/// Says that regular samples are left out.
inline void say_stride(svg& out, axes const& a, std::size_t stride) {
    if (stride == 1) return;
    out.text(a.right(), a.top() - 11, "1 in " + std::to_string(stride) + " drawn",
             {.size = 10, .align = anchor::end, .fill = palette::muted_ink});
}

} // namespace detail

/// Measured intervals over time as bars, the proven tube as a band, outliers marked, and lines that
/// are not validated: the report's Figure 4.1.
/// @cost  O(samples + pieces); the text grows with neither beyond a few hundred marks
[[nodiscard]] inline svg draw_time_plot(channel_series const& c, time_plot_options const& o = {}) {
    auto const entries = o.legend ? time_plot_legend({c}) : std::vector<legend_entry>{};
    svg measure{0, 0, ""};
    double const below = draw_legend(measure, entries, 0, 0, o.width - 60);
    bool const compared = !c.before.empty() || !c.after.empty();
    bool const named = o.title.empty() || o.title == c.name;
    svg out{o.width, o.height + below,
            c.name + (compared && !c.measured.empty() ? ", before and after" : " over time") +
                (named ? "" : ", " + o.title)};
    auto const a =
        detail::time_axes(c, o, {c.name, c.unit, is_empty(o.values) ? value_range(c) : o.values});
    a.open(out);
    if (c.margin) {
        out.rect(a.left(), a.py(0), a.right() - a.left(), std::max(0.0, a.bottom() - a.py(0)),
                 {.fill = palette::outlier, .opacity = 0.10}, 0, "violated below this line");
    }
    detail::draw_band(out, a, c.band);
    detail::draw_tube(out, a, c.tube);
    if (c.zero)
        out.line(a.left(), a.py(0), a.right(), a.py(0),
                 {.stroke = palette::ink, .width = c.margin ? 1.3 : 1.1});
    detail::draw_windows(out, a, c);
    detail::draw_line(out, a, c.reference, {.stroke = palette::truth, .width = 1.2, .dash = "5 3"});
    // Lines that are compared are drawn above the bars.
    auto const stride = detail::stride_of(c);
    auto const marked =
        detail::draw_regular(out, a, c, stride, compared ? palette::frame : palette::measurement);
    detail::draw_line(out, a, c.before, line_before_paint);
    detail::draw_line(out, a, c.after, line_after_paint);
    for (std::size_t i = 0; i < marked.size(); ++i) {
        measured_sample const& m = *marked[i];
        if (!compared)
            draw_measured(out, a.px(m.time), a.py(m.value.lo), a.py(m.value.hi), palette::outlier);
        if (i < 4 * detail::most_samples) {
            detail::draw_outlier(out, a, m, approximate_middle(m.value), detail::sample_tip(c, m));
        }
    }
    a.close(out);
    bool const nothing = c.measured.empty() && c.tube.empty() && c.reference.empty() && !compared &&
                         c.windows.empty();
    if (nothing) {
        a.say(out, "no data", c.zero ? std::optional{a.top() + 16} : std::nullopt);
    } else {
        detail::say_stride(out, a, stride);
    }
    draw_legend(out, entries, a.left(), o.height + 4, o.width - 60);
    return out;
}

/// True when a sample can be compared with the model: both intervals finite, the bound above zero.
[[nodiscard]] inline bool has_residual(measured_sample const& m) {
    return is_finite(m.value) && is_finite(m.enclosure) && approximate_width(m.value) > 0;
}

/// The model's enclosure in units of the measurement's own bound, for drawing:
///   \f$ (\text{enclosure} - \text{mid}) / \text{rad} \f$; inside [-1, 1] the sample is met.
[[nodiscard]] inline range approximate_residual(measured_sample const& m) {
    double const middle = approximate_middle(m.value);
    double const half = approximate_width(m.value) / 2;
    return {(m.enclosure.lo - middle) / half, (m.enclosure.hi - middle) / half};
}

/// Where the model's enclosure lies within each measured interval: 0 is its middle, +-1 its ends.
/// What a time plot hides in a line as thin as a pixel is seen here.
[[nodiscard]] inline svg draw_residual_plot(channel_series const& c,
                                            time_plot_options const& o = {}) {
    svg out{o.width, o.height, (o.title.empty() ? c.name : o.title) + " against its bounds"};
    range shown{-1.3, 1.3};
    for (measured_sample const& m : c.measured) {
        if (has_residual(m)) {
            range const r = with_margin(approximate_residual(m), 0.05);
            shown = hull(hull(shown, std::clamp(r.lo, -4.0, 4.0)), std::clamp(r.hi, -4.0, 4.0));
        }
    }
    auto const a = detail::time_axes(c, o, {"model / bound", "", shown});
    a.open(out);
    out.rect(a.left(), a.py(1), a.right() - a.left(), a.py(-1) - a.py(1), {.fill = "#eef2f6"});
    out.path(path_data{}
                 .move(a.left(), a.py(1))
                 .line(a.right(), a.py(1))
                 .move(a.left(), a.py(-1))
                 .line(a.right(), a.py(-1)),
             {.stroke = palette::ink, .width = 1.1});
    auto const stride = detail::stride_of(c);
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
