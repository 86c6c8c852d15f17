// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_CANDIDATE_CHART_IPP
#define SIVID_REPORT_DRAW_IMPL_CANDIDATE_CHART_IPP

#include <sivid/report/draw/candidate_chart.hpp>

namespace sivid::report {

SIVID_DECL std::string_view state_sign(cause_verdict s) {
    return s == cause_verdict::explains   ? "\xE2\x9C\x93"
           : s == cause_verdict::excluded ? "\xE2\x9C\x95"
                                          : "?";
}

SIVID_DECL std::string_view state_words(cause_verdict s) {
    return s == cause_verdict::explains   ? "explains (proved)"
           : s == cause_verdict::excluded ? "excluded (proved)"
                                          : "open";
}

SIVID_DECL bool is_fitted(double inflation) { return std::isfinite(inflation) && inflation > 0; }

SIVID_DECL bool says_something(range const& inflation) {
    return !is_empty(inflation) && (inflation.lo > 0 || std::isfinite(inflation.hi));
}

SIVID_DECL std::string span_text(range const& r, int digits) {
    if (is_empty(r)) return "?";
    number_format const f{.significant = digits, .shift = 0};
    if (!std::isfinite(r.hi)) {
        return std::isfinite(r.lo) ? "at least " + rounded_text(r.lo, rounding::down, f)
                                   : "not bounded";
    }
    if (!std::isfinite(r.lo)) return "at most " + rounded_text(r.hi, rounding::up, f);
    std::string const low = rounded_text(r.lo, rounding::down, f);
    std::string const high = rounded_text(r.hi, rounding::up, f);
    return low == high ? low : low + " to " + high;
}

SIVID_DECL std::string inflation_text(range const& r) {
    if (!(r.lo > 0) && std::isfinite(r.hi)) return span_text({-INFINITY, r.hi});
    int digits = 3;
    for (double left = 0.01; r.lo > 1 && r.lo < 1 + 1.001 * left && digits < 12; left /= 10)
        ++digits;
    return span_text(r, digits);
}

SIVID_DECL std::string estimate_text(double x) {
    return std::isfinite(x) ? "\xE2\x89\x88\xE2\x80\xAF" + rounded_text(x, rounding::nearest) : "?";
}

namespace detail {

inline std::string_view state_colour(cause_verdict s) {
    return s == cause_verdict::explains   ? palette::inside
           : s == cause_verdict::excluded ? palette::outlier
                                          : palette::frame;
}

// Of a sign in the same meaning: dark enough for a letter.
inline std::string_view state_ink(cause_verdict s) {
    return s == cause_verdict::explains   ? palette::inside
           : s == cause_verdict::excluded ? palette::outlier_ink
                                          : palette::muted_ink;
}

} // namespace detail

SIVID_DECL std::vector<legend_entry> candidate_legend(std::vector<candidate_bar> const& bars) {
    bool proved = false, fitted = false;
    for (candidate_bar const& b : bars) {
        proved = proved || says_something(b.proved);
        fitted = fitted || is_fitted(b.fitted);
    }
    return legend_of({{proved, {symbol::bar_to_lower, "up to the proved lower bound"}},
                      {proved, {symbol::bar_to_upper, "between the proved bounds"}},
                      {fitted, {symbol::estimate, "best fit found (estimate)"}}});
}

SIVID_DECL svg draw_candidate_chart(std::vector<candidate_bar> const& bars,
                                    candidate_chart_options const& o) {
    double const top = o.title.empty() ? 24 : 48;
    double const pitch = 27;
    double const bottom = top + pitch * static_cast<double>(std::max<std::size_t>(bars.size(), 1));
    svg out{o.width, bottom + 42, o.title.empty() ? "inflation of the candidates" : o.title};
    auto const note = [](candidate_bar const& b) {
        std::string text{state_words(b.state)};
        if (says_something(b.proved)) text += ", " + inflation_text(b.proved);
        if (b.state == cause_verdict::undecided && is_fitted(b.fitted)) {
            text +=
                ", " + estimate_text(b.fitted) + (says_something(b.proved) ? "" : " (estimate)");
        }
        return text;
    };
    double label_width = 60, note_width = 90;
    for (candidate_bar const& b : bars) {
        double const bold = b.answer ? 1.12 : 1;
        label_width =
            std::max(label_width, bold * approximate_text_width(shorten(b.label, 44), 12.5));
        note_width = std::max(note_width, approximate_text_width(note(b), 11.5));
    }
    double const left = std::min(label_width + 34, o.width * 0.42);
    double const right = std::max(o.width - note_width - 18, left + 80);
    detail::inflation_scale const scale(bars);
    auto const px = [&](double v) { return left + (right - left) * scale.share(v); };
    if (!o.title.empty()) out.text(0, 16, o.title, {.size = 13, .bold = true});
    for (std::size_t i = 0; i < bars.size(); ++i) {
        if (bars[i].answer) {
            out.rect(0, top + pitch * static_cast<double>(i) + 1, o.width, pitch - 2,
                     {.fill = "#eef6fb"}, 3);
        }
    }
    path_data grid;
    for (tick const& t : scale.ticks()) {
        grid.move(px(t.value), top).line(px(t.value), bottom);
        out.text(px(t.value), bottom + 15, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.path(grid, {.stroke = palette::grid});
    for (std::size_t i = 0; i < bars.size(); ++i) {
        candidate_bar const& b = bars[i];
        double const y = top + pitch * static_cast<double>(i);
        auto const colour = detail::state_colour(b.state);
        std::string const tip = b.label + ": " + note(b);
        out.text(8, y + 18, state_sign(b.state),
                 {.size = 13,
                  .align = anchor::middle,
                  .fill = detail::state_ink(b.state),
                  .bold = true});
        out.text(left - 10, y + 18, shorten(b.label, 44),
                 {.size = 12.5, .align = anchor::end, .bold = b.answer});
        if (says_something(b.proved)) {
            double const low = px(b.proved.lo);
            out.rect(left, y + 7, low - left, 13, {.fill = colour}, 0, tip);
            if (std::isfinite(b.proved.hi)) {
                out.rect(low, y + 7, px(b.proved.hi) - low, 13,
                         {.fill = out.hatch("#ffffff", colour), .stroke = colour}, 0, tip);
            } else {
                // Open to the right: no upper bound.
                out.path(
                    path_data{}.move(low, y + 7).line(low + 9, y + 13.5).line(low, y + 20).close(),
                    {.fill = out.hatch("#ffffff", colour), .stroke = colour}, tip);
            }
        }
        if (is_fitted(b.fitted)) {
            if (!says_something(b.proved)) {
                out.line(left, y + 13.5, px(b.fitted), y + 13.5,
                         {.stroke = palette::frame, .width = 1.2, .dash = "2 3"});
            }
            draw_estimate(out, px(b.fitted), y + 13.5,
                          b.label + ": " + estimate_text(b.fitted) + ", best fit");
            if (b.fitted > scale.high()) {
                out.text(right - 8, y + 18, "\xE2\x96\xB8", {.size = 11, .align = anchor::end});
            }
        }
        out.text(right + 12, y + 18, note(b), {.size = 11.5});
    }
    out.line(left, top, left, bottom, {.stroke = palette::frame});
    out.line(px(1), top - 5, px(1), bottom,
             {.stroke = palette::black, .width = 1.3, .dash = "4 3"});
    out.text(px(1), top - 9, "1: all data explained",
             {.size = 11, .align = px(1) > (left + right) / 2 ? anchor::end : anchor::start});
    out.text((left + right) / 2, bottom + 33,
             std::string{"factor by which all bounds must still grow"} +
                 (scale.logarithmic() ? " (logarithmic)" : ""),
             {.size = 11.5, .align = anchor::middle});
    return out;
}

} // namespace sivid::report

#endif
