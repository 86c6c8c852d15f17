// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_CHARTS_HPP
#define SIVID_REPORT_DRAW_CHARTS_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::report {

/// One bar: a non-negative quantity known within an interval. The bar is full up to the lower
/// bound and hatched up to the upper one; an infinite upper bound runs to the frame.
struct bar {
    std::string label{};
    range value{};
};

struct bar_chart_options {
    std::string title{};
    std::string quantity{}; ///< the axis label
    std::string unit{};
    std::optional<double> threshold{}; ///< a dashed line, e.g. inflation 1
    std::string threshold_label{};
};

/// One row: what is left of the gap after the candidate is joined.
struct candidate_bar {
    std::string label{};
    cause_verdict state = cause_verdict::undecided;
    range proved{};    ///< of the inflation; empty or [0, infinity): nothing proved
    double fitted = 0; ///< of the best fit found, not proved; unless positive and finite: no fit
    bool answer = false;
};

/// Values of channels over time windows, for example by how much each window misses its bounds.
struct heat_map {
    std::vector<std::string> rows{};           ///< channel names
    std::vector<double> times{};               ///< the windows' ends, one more than columns
    std::vector<std::vector<double>> values{}; ///< [row][column]; NaN: nothing known
    std::string quantity{};
    double threshold = 1; ///< above it a value is painted orange and crossed
    std::string time_unit = "s";
};

struct heat_map_options {
    std::string title{};
    double largest = 0; ///< the colours' end is not below it: lets maps share their colours
    bool key = true;    ///< draw the colour bar
};

/// One parameter: what was known before, and what is left.
struct interval_row {
    std::string name{};
    std::string unit{};
    range prior{};
    range hull{};
    std::optional<double> witness{};
};

/// How a verdict is shown.
struct verdict_look {
    std::string_view sign, words;
    std::string_view colour;
    std::string_view ink; ///< of the sign: dark enough for a letter
};

[[nodiscard]] inline verdict_look look_of(cause_verdict s) {
    if (s == cause_verdict::explains)
        return {"\xE2\x9C\x93", "explains (proved)", palette::inside, palette::inside};
    if (s == cause_verdict::excluded)
        return {"\xE2\x9C\x95", "excluded (proved)", palette::outlier, palette::outlier_ink};
    return {"?", "open", palette::frame, palette::muted_ink};
}

/// The largest finite value of a map; 0 when there is none.
[[nodiscard]] inline double largest_value(heat_map const& m) {
    double largest = 0;
    for (auto const& row : m.values) {
        for (double const v : row) largest = std::isfinite(v) ? std::max(largest, v) : largest;
    }
    return largest;
}

namespace detail {

/// Where rows end.
inline double rows_end(double top, double pitch, std::size_t rows) {
    return top + pitch * static_cast<double>(std::max<std::size_t>(rows, 1));
}

/// Lines at the ticks of a horizontal scale, with their labels below.
template <class Place>
void draw_grid(svg& out, std::vector<tick> const& ticks, Place const& px, double top,
               double bottom) {
    path_data grid;
    for (tick const& t : ticks) {
        grid.move(px(t.value), top).line(px(t.value), bottom);
        out.text(px(t.value), bottom + 15, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.path(grid, {.stroke = palette::grid});
}

/// A scale from left to right, over which rows lie: linear from 0 where all bars are of one size,
/// else logarithmic.
struct inflation_axis {
    double left, right;
    bool logarithmic = false;
    double low = 0, high = 1;

    inflation_axis(std::vector<candidate_bar> const& bars, double from, double to)
        : left{from}, right{to} {
        double least = 1, most = 1;
        auto const see = [&](double v) {
            if (!std::isfinite(v) || !(v > 0)) return;
            least = std::min(least, v);
            most = std::max(most, v);
        };
        for (candidate_bar const& b : bars) {
            if (says_something(b.proved)) {
                see(b.proved.lo);
                see(b.proved.hi);
            }
            see(b.fitted);
        }
        logarithmic = most > 8;
        low = logarithmic ? std::clamp(least * 0.8, 0.1, 0.7) : 0;
        high = std::min(most * (logarithmic ? 1.3 : 1.06), 1e5);
    }
    [[nodiscard]] double px(double v) const {
        double const s = !(v > low)    ? 0
                         : logarithmic ? std::log(v / low) / std::log(high / low)
                                       : v / high;
        return left + (right - left) * std::clamp(s, 0.0, 1.0);
    }
    [[nodiscard]] std::vector<tick> ticks() const {
        if (!logarithmic) return nice_ticks({0, high}, 8).ticks;
        std::vector<tick> out;
        bool const few = high / low > 2000;
        for (int power = -1; power <= 5; ++power) {
            for (int const digit : {1, 2, 5}) {
                double const v = digit * std::pow(10.0, power);
                if (v > low && v <= high && (digit == 1 || !few)) out.push_back({v, given_text(v)});
            }
        }
        return out;
    }
};

/// What is known of a candidate, in words beside its bar.
inline std::string candidate_note(candidate_bar const& b) {
    std::string text{look_of(b.state).words};
    if (says_something(b.proved)) text += ", " + inflation_text(b.proved);
    if (b.state == cause_verdict::undecided && is_fitted(b.fitted)) {
        text += ", " + estimate_text(b.fitted) + (says_something(b.proved) ? "" : " (estimate)");
    }
    return text;
}

/// Up to the proved lower bound, and on to the upper one.
inline void draw_proved(svg& out, inflation_axis const& axis, candidate_bar const& b, double y) {
    auto const colour = look_of(b.state).colour;
    std::string const tip = b.label + ": " + candidate_note(b);
    double const low = axis.px(b.proved.lo);
    out.rect(axis.left, y + 7, low - axis.left, 13, {.fill = colour}, 0, tip);
    if (std::isfinite(b.proved.hi)) {
        out.rect(low, y + 7, axis.px(b.proved.hi) - low, 13,
                 {.fill = out.hatch("#ffffff", colour), .stroke = colour}, 0, tip);
    } else {
        // Open to the right: no upper bound.
        out.path(path_data{}.move(low, y + 7).line(low + 9, y + 13.5).line(low, y + 20).close(),
                 {.fill = out.hatch("#ffffff", colour), .stroke = colour}, tip);
    }
}

inline void draw_fitted(svg& out, inflation_axis const& axis, candidate_bar const& b, double y) {
    double const x = axis.px(b.fitted);
    if (!says_something(b.proved)) {
        out.line(axis.left, y + 13.5, x, y + 13.5,
                 {.stroke = palette::frame, .width = 1.2, .dash = "2 3"});
    }
    draw_estimate(out, x, y + 13.5, b.label + ": " + estimate_text(b.fitted) + ", best fit");
    if (b.fitted > axis.high) {
        out.text(axis.right - 8, y + 18, "\xE2\x96\xB8", {.size = 11, .align = anchor::end});
    }
}

inline void draw_candidate(svg& out, inflation_axis const& axis, candidate_bar const& b, double y) {
    auto const look = look_of(b.state);
    out.text(8, y + 18, look.sign,
             {.size = 13, .align = anchor::middle, .fill = look.ink, .bold = true});
    out.text(axis.left - 10, y + 18, shorten(b.label, 44),
             {.size = 12.5, .align = anchor::end, .bold = b.answer});
    if (says_something(b.proved)) draw_proved(out, axis, b, y);
    if (is_fitted(b.fitted)) draw_fitted(out, axis, b, y);
    out.text(axis.right + 12, y + 18, candidate_note(b), {.size = 11.5});
}

inline double median_spacing(std::vector<point> const& all) {
    std::vector<double> gaps;
    for (std::size_t k = 1; k < all.size(); ++k) {
        double const gap = all[k].x - all[k - 1].x;
        if (std::isfinite(gap) && gap > 0) gaps.push_back(gap);
    }
    if (gaps.empty()) return 0;
    auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    return *middle;
}

/// Colours of a heat map. Below the threshold linear; above it logarithmic, since a gap may be a
/// hundred times its bound.
struct heat_scale {
    double full;    ///< the threshold
    double largest; ///< value of all maps that share the scale
    /// Beyond a thousand times the threshold all is one colour, so that one wild value leaves the
    /// others told apart.
    double excess;

    heat_scale(heat_map const& m, heat_map_options const& o)
        : full(m.threshold > 0 ? m.threshold : 1), largest(largest_value(m)) {
        largest = std::isfinite(o.largest) ? std::max(largest, o.largest) : largest;
        excess = std::clamp(largest, 2 * full, 1000 * full);
    }
    [[nodiscard]] std::string colour(double v) const {
        return v <= full
                   ? blue_ramp.at(v / full * 0.8)
                   : orange_ramp.at(std::log(std::min(v, excess) / full) / std::log(excess / full));
    }
};

/// Where the cells of a heat map lie.
struct heat_frame {
    double left, right, top, pitch, bottom;
    range span; ///< of the times

    [[nodiscard]] double px(double t) const {
        return left + (right - left) * std::clamp((t - span.lo) / (span.hi - span.lo), 0.0, 1.0);
    }
    [[nodiscard]] double row(std::size_t r) const { return top + pitch * static_cast<double>(r); }
};

/// The cells with their rows' names; those beyond the threshold are crossed.
inline void draw_cells(svg& out, heat_map const& m, heat_frame const& at, heat_scale const& scale) {
    path_data crosses;
    for (std::size_t r = 0; r < m.rows.size(); ++r) {
        double const y = at.row(r);
        out.text(at.left - 8, y + 17, shorten(m.rows[r], 24), {.size = 12, .align = anchor::end});
        for (std::size_t c = 0;
             r < m.values.size() && c < m.values[r].size() && c + 1 < m.times.size(); ++c) {
            double const v = m.values[r][c];
            double const x = at.px(m.times[c]), w = at.px(m.times[c + 1]) - x;
            if (std::isnan(v) || std::isnan(x) || std::isnan(w)) continue;
            std::string const fill = scale.colour(v);
            out.rect(x, y, w + 0.3, at.pitch, {.fill = fill}, 0,
                     m.times.size() < 120 ? m.rows[r] + ": " + rounded_text(v, rounding::nearest)
                                          : std::string{});
            if (v > scale.full && w > 5) {
                double const mx = x + w / 2, my = y + at.pitch / 2;
                crosses.move(mx - 2.5, my - 2.5)
                    .line(mx + 2.5, my + 2.5)
                    .move(mx - 2.5, my + 2.5)
                    .line(mx + 2.5, my - 2.5);
            }
        }
    }
    out.path(crosses, {.stroke = palette::paper, .width = 3, .opacity = 0.75});
    out.path(crosses, {.stroke = palette::ink, .width = 1.2});
}

/// Lines between the rows, the frame, and the axis of time below.
inline void draw_rules(svg& out, heat_map const& m, heat_frame const& at) {
    auto const [left, right, top, pitch, bottom, span] = at;
    path_data rules;
    for (std::size_t r = 0; r + 1 < m.rows.size(); ++r)
        rules.move(left, at.row(r + 1)).line(right, at.row(r + 1));
    out.path(rules, {.stroke = palette::paper, .width = 2});
    out.path(path_data{}.rect(left, top, right - left, bottom - top), {.stroke = palette::frame});
    for (tick const& t :
         nice_ticks(span, std::clamp(static_cast<int>((right - left) / 70), 2, 12)).ticks) {
        out.line(at.px(t.value), bottom, at.px(t.value), bottom + 4, {.stroke = palette::frame});
        out.text(at.px(t.value), bottom + 16, t.label,
                 {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
    }
    out.text((left + right) / 2, bottom + 33, "time [" + unit_text(m.time_unit) + "]",
             {.size = 11.5, .align = anchor::middle});
}

/// The colour bar: left half up to the threshold, right half beyond.
inline void draw_colour_bar(svg& out, heat_map const& m, heat_frame const& at,
                            heat_scale const& scale) {
    double const left = at.left, bar_y = at.bottom + 50;
    double const bar_width = std::min(260.0, at.right - left), half = bar_width / 2;
    for (int i = 0; i < 24; ++i) {
        double const s = i / 24.0;
        std::string const low = blue_ramp.at(s * 0.8), high = orange_ramp.at(s);
        out.rect(left + s * half, bar_y, half / 24 + 0.3, 10, {.fill = low});
        out.rect(left + half + s * half, bar_y, half / 24 + 0.3, 10, {.fill = high});
    }
    auto const mark = [&](double x, double v, anchor align) {
        out.text(x, bar_y + 23,
                 (scale.largest > v && v == scale.excess ? "≥ " : "") +
                     rounded_text(v, rounding::nearest, {.significant = 2, .shift = 0}),
                 {.size = 10.5, .align = align, .fill = palette::muted_ink});
    };
    mark(left, 0, anchor::start);
    mark(left + half, scale.full, anchor::middle);
    mark(left + bar_width, scale.excess, anchor::end);
    out.text(left + bar_width + 12, bar_y + 9, m.quantity, {.size = 11.5});
}

} // namespace detail

/// Horizontal bars of bounded quantities, with their numbers, and a threshold line.
[[nodiscard]] inline svg draw_bar_chart(std::vector<bar> const& bars,
                                        bar_chart_options const& o = {}) {
    double const width = 900, top = 44, pitch = 28;
    double const bottom = detail::rows_end(top, pitch, bars.size());
    svg out{width, bottom + 42, o.title};
    double label_width = 30, note_width = 20;
    range shown{0, 0};
    for (bar const& b : bars) {
        label_width = std::max(label_width, approximate_text_width(shorten(b.label, 36), 12));
        note_width = std::max(note_width, approximate_text_width(outward_text(b.value), 11) + 22);
        shown = hull(hull(shown, b.value.lo), b.value.hi);
    }
    if (o.threshold) shown = hull(shown, *o.threshold);
    shown = axis_range({shown.lo, shown.hi + 0.04 * (shown.hi - shown.lo)});
    double const left = std::min(label_width + 12, width * 0.4);
    double const right = std::max(width - note_width, left + 60);
    auto const px = [&](double v) {
        double const s = (v / 2 - shown.lo / 2) / (shown.hi / 2 - shown.lo / 2);
        return left + (right - left) * (std::isnan(s) ? 0.0 : std::clamp(s, 0.0, 1.0));
    };
    out.text(0, 16, o.title, {.size = 13, .bold = true});
    tick_set const ticks =
        nice_ticks(shown, std::clamp(static_cast<int>((right - left) / 70), 2, 10));
    detail::draw_grid(out, ticks.ticks, px, top, bottom);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        bar const& b = bars[i];
        double const y = top + pitch * static_cast<double>(i);
        out.text(left - 8, y + 18, shorten(b.label, 36), {.size = 12, .align = anchor::end});
        if (is_empty(b.value)) {
            out.text(left + 6, y + 18, "no bound", {.size = 11, .fill = palette::muted_ink});
            continue;
        }
        double const zero = px(0), low = px(b.value.lo), high = px(b.value.hi);
        out.rect(std::min(zero, low), y + 6, std::abs(low - zero), 16, {.fill = palette::blue});
        out.rect(
            low, y + 6, high - low, 16,
            {.fill = out.hatch("#ffffff", palette::blue), .stroke = palette::blue, .width = 1});
    }
    out.line(left, top, left, bottom, {.stroke = palette::frame});
    if (o.threshold) {
        double const x = px(*o.threshold);
        out.line(x, top - 4, x, bottom, {.stroke = palette::black, .width = 1.3, .dash = "4 3"});
        out.text(x, top - 7, o.threshold_label,
                 {.size = 11, .align = x > (left + right) / 2 ? anchor::end : anchor::start});
    }
    // Last and on a light ground, so that the threshold does not strike them through.
    for (std::size_t i = 0; i < bars.size(); ++i) {
        if (is_empty(bars[i].value)) continue;
        double const x = std::max(px(bars[i].value.hi), px(0)) + 7;
        double const y = top + pitch * static_cast<double>(i);
        auto const label = outward_text(bars[i].value);
        out.rect(x - 3, y + 7, approximate_text_width(label, 11) + 4, 14,
                 {.fill = palette::paper, .opacity = 0.85});
        out.text(x, y + 18, label, {.size = 11});
    }
    out.text((left + right) / 2, bottom + 33, axis_text(o.quantity, o.unit, ticks.exponent),
             {.size = 11.5, .align = anchor::middle});
    return out;
}

[[nodiscard]] inline std::vector<legend_entry>
candidate_legend(std::vector<candidate_bar> const& bars) {
    bool proved = false, fitted = false;
    for (candidate_bar const& b : bars) {
        proved = proved || says_something(b.proved);
        fitted = fitted || is_fitted(b.fitted);
    }
    return legend_of({{proved, {symbol::bar_to_lower, "up to the proved lower bound"}},
                      {proved, {symbol::bar_to_upper, "between the proved bounds"}},
                      {fitted, {symbol::estimate, "best fit found (estimate)"}}});
}

/// For each candidate the inflation that is left: proved bounds as a bar, solid to the lower and
/// hatched to the upper one, the best fit as an open circle; the threshold at 1; sign and words for
/// what is proved.
[[nodiscard]] inline svg draw_candidate_chart(std::vector<candidate_bar> const& bars) {
    double const width = 1000, top = 24, pitch = 27;
    double const bottom = detail::rows_end(top, pitch, bars.size());
    svg out{width, bottom + 42, "inflation of the candidates"};
    double label_width = 60, note_width = 90;
    for (candidate_bar const& b : bars) {
        double const bold = b.answer ? 1.12 : 1;
        label_width =
            std::max(label_width, bold * approximate_text_width(shorten(b.label, 44), 12.5));
        note_width = std::max(note_width, approximate_text_width(detail::candidate_note(b), 11.5));
    }
    double const left = std::min(label_width + 34, width * 0.42);
    double const right = std::max(width - note_width - 18, left + 80);
    detail::inflation_axis const axis(bars, left, right);
    auto const row = [&](std::size_t i) { return top + pitch * static_cast<double>(i); };
    for (std::size_t i = 0; i < bars.size(); ++i) {
        if (bars[i].answer) out.rect(0, row(i) + 1, width, pitch - 2, {.fill = "#eef6fb"}, 3);
    }
    auto const px = [&](double v) { return axis.px(v); };
    detail::draw_grid(out, axis.ticks(), px, top, bottom);
    for (std::size_t i = 0; i < bars.size(); ++i)
        detail::draw_candidate(out, axis, bars[i], row(i));
    out.line(left, top, left, bottom, {.stroke = palette::frame});
    out.line(px(1), top - 5, px(1), bottom,
             {.stroke = palette::black, .width = 1.3, .dash = "4 3"});
    out.text(px(1), top - 9, "1: all data explained",
             {.size = 11, .align = px(1) > (left + right) / 2 ? anchor::end : anchor::start});
    out.text((left + right) / 2, bottom + 33,
             std::string{"factor by which all bounds must still grow"} +
                 (axis.logarithmic ? " (logarithmic)" : ""),
             {.size = 11.5, .align = anchor::middle});
    return out;
}

/// How far the channels miss their bounds, over time: each cell holds the largest misfit of the
/// samples in it; a sample of a slow channel reaches half way to its neighbours.
[[nodiscard]] inline heat_map misfit_map(std::vector<channel_series> const& channels, bool after,
                                         std::size_t most_columns = 60) {
    heat_map out{.quantity = "|residual| / bound"};
    if (!channels.empty()) out.time_unit = channels.front().time_unit;
    range span;
    std::size_t columns = 1;
    for (channel_series const& c : channels) {
        auto const& all = after ? c.misfit_after : c.misfit_before;
        columns = std::max(columns, std::min(all.size(), most_columns));
        for (point const& p : all) span = hull(span, p.x);
    }
    if (is_empty(span)) return out;
    span = axis_range(span);
    double const step = (span.hi - span.lo) / static_cast<double>(columns);
    for (std::size_t k = 0; k <= columns; ++k) {
        out.times.push_back(span.lo + step * static_cast<double>(k));
    }
    for (channel_series const& c : channels) {
        auto const& all = after ? c.misfit_after : c.misfit_before;
        std::vector<double> row(columns, std::nan(""));
        double const reach = detail::median_spacing(all) / 2;
        auto const cell = [&](double t) {
            double const place = std::floor((t - span.lo) / step);
            return static_cast<std::size_t>(
                std::clamp(place, 0.0, static_cast<double>(columns - 1)));
        };
        for (point const& p : all) {
            if (!std::isfinite(p.x) || std::isnan(p.y)) continue;
            for (std::size_t k = cell(p.x - reach); k <= cell(p.x + reach); ++k) {
                double const middle = span.lo + step * (static_cast<double>(k) + 0.5);
                if (k == cell(p.x) || std::fabs(middle - p.x) <= reach) {
                    row[k] = std::fmax(row[k], std::fabs(p.y));
                }
            }
        }
        out.rows.push_back(c.name);
        out.values.push_back(std::move(row));
    }
    return out;
}

/// Channels against time in colour: blue up to the threshold, orange with a cross above it, hatched
/// where nothing is known; with a colour bar.
[[nodiscard]] inline svg draw_heat_map(heat_map const& m, heat_map_options const& o = {}) {
    double const width = 540, top = 34, pitch = 26;
    double const bottom = detail::rows_end(top, pitch, m.rows.size());
    svg out{width, bottom + (o.key ? 84 : 42), o.title};
    double label_width = 30;
    for (std::string const& name : m.rows) {
        label_width = std::max(label_width, approximate_text_width(shorten(name, 24), 12));
    }
    double const left = std::min(label_width + 12, width * 0.4), right = width - 14;
    range span;
    for (double const t : m.times) span = hull(span, t);
    detail::heat_frame const at{left, right, top, pitch, bottom, axis_range(span)};
    detail::heat_scale const scale(m, o);
    out.text(0, 16, o.title, {.size = 13, .bold = true});
    std::string const unknown = out.hatch("#ffffff", palette::grid);
    out.rect(left, top, right - left, bottom - top, {.fill = unknown});
    detail::draw_cells(out, m, at, scale);
    detail::draw_rules(out, m, at);
    if (o.key) detail::draw_colour_bar(out, m, at, scale);
    return out;
}

/// For each parameter its prior as a grey bar and its hull as a coloured bar on it, each row on its
/// own scale, with the numbers of both.
[[nodiscard]] inline svg draw_interval_chart(std::vector<interval_row> const& rows) {
    double const width = 1000, top = 6, pitch = 52;
    svg out{width, detail::rows_end(top, pitch, rows.size()) + 4, "parameters"};
    double name_width = 40;
    for (interval_row const& r : rows) {
        name_width = std::max(name_width, approximate_text_width(shorten(r.name, 24), 13) + 14);
    }
    double const left = std::min(name_width, width * 0.4);
    double const right = width - 14;
    std::string places;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        interval_row const& r = rows[i];
        double const y = top + pitch * static_cast<double>(i);
        range const scale = axis_range(is_empty(r.prior) ? r.hull : r.prior);
        auto const px = [&](double v) {
            double const s = (v - scale.lo) / (scale.hi - scale.lo);
            return left + (right - left) * (std::isnan(s) ? 0.0 : std::clamp(s, 0.0, 1.0));
        };
        places += coordinate(left) + ' ' + coordinate(right) + ' ' + sivid::nearest_text(scale.lo) +
                  ' ' + sivid::nearest_text(scale.hi) + ' ' + coordinate(y + 10) + " 20 " + r.name +
                  '\n';
        out.text(0, y + 24, shorten(r.name, 24), {.size = 13, .bold = true});
        out.rect(left, y + 14, right - left, 12, {.fill = palette::prior}, 3,
                 "prior " + given_text(r.prior));
        std::string const unit = unit_suffix(r.unit);
        if (is_empty(r.hull)) {
            out.text((left + right) / 2, y + 24, "empty: nothing in the prior is left",
                     {.size = 11, .align = anchor::middle});
        } else {
            double const from = px(r.hull.lo), to = px(r.hull.hi);
            double const wide = std::max(to - from, 2.5);
            std::string const label = outward_text_within(r.hull, r.prior) + unit;
            out.rect(std::min(from, right - wide), y + 10, wide, 20, {.fill = palette::inside}, 2,
                     "hull " + label);
            double const half = approximate_text_width(label, 11.5) / 2;
            out.text(std::clamp((from + to) / 2, left + half, std::max(left + half, right - half)),
                     y + 5, label, {.size = 11.5, .align = anchor::middle});
        }
        if (r.witness && std::isfinite(*r.witness)) {
            draw_witness(out, px(*r.witness), y + 20, "witness " + exact_text(*r.witness) + unit);
        }
        if (is_finite(r.prior)) {
            out.text(left, y + 43, given_text(r.prior.lo),
                     {.size = 10.5, .fill = palette::muted_ink});
            out.text(right, y + 43, given_text(r.prior.hi) + unit,
                     {.size = 10.5, .align = anchor::end, .fill = palette::muted_ink});
        }
    }
    return out.data("rows", places);
}

} // namespace sivid::report

#endif
