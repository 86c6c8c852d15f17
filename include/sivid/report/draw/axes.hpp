// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_AXES_HPP
#define SIVID_REPORT_DRAW_AXES_HPP

#include <sivid/number/text/nearest_text.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::report {

struct tick {
    double value = 0;
    std::string label{};
};

/// Ticks of a linear axis. Labels are to be multiplied by 10^exponent, which stands beside the
/// axis.
struct tick_set {
    std::vector<tick> ticks{};
    int exponent = 0;
};

// The symbols of all plots, drawn by the same functions in a plot and in its legend.

enum class symbol {
    measured,       ///< a bar with caps: a measured interval
    forced_outlier, ///< cross in a ring: proven to violate its bound
    suspect,        ///< open diamond: violated by the witness only
    tube,           ///< filled band: a proven enclosure
    reference,      ///< dashed line: not validated
    inside,
    undecided,
    pending,
    outside,
    witness,      ///< a star-like cross: a verified point
    measured_box, ///< outlined box
    prior,
    hull,
    heading,          ///< arrowhead: not validated
    window,           ///< dashed outline: what a zoom shows
    line_before,      ///< dashed line: the model as it is, not validated
    line_after,       ///< full line: the model with an effect, not validated
    certified_window, ///< outlined filled box: proved over a window
    bar_to_lower,     ///< solid: up to the proved lower bound
    bar_to_upper,     ///< hatched: between the proved bounds
    estimate          ///< open circle: not proved
};

/// The paint of lines that compare two models.
inline constexpr paint line_before_paint{.stroke = palette::truth, .width = 1.7, .dash = "6 3"};
inline constexpr paint line_after_paint{.stroke = palette::blue, .width = 1.7};

struct legend_entry {
    symbol mark;
    std::string label{};
};

/// Those entries that occur.
[[nodiscard]] inline std::vector<legend_entry>
legend_of(std::initializer_list<std::pair<bool, legend_entry>> all) {
    std::vector<legend_entry> out;
    for (auto const& [occurs, entry] : all)
        if (occurs) out.push_back(entry);
    return out;
}

/// A range that an axis can show, whatever comes in: finite, of positive width, and wide enough
/// for doubles to tell its pixels apart. Empty and NaN give [0, 1]; an infinite end is replaced by
/// the finite one; a single value gets room on both sides.
[[nodiscard]] inline range axis_range(range const& data) {
    constexpr double largest = 1e300;
    if (is_empty(data) || (!std::isfinite(data.lo) && !std::isfinite(data.hi))) return {0, 1};
    double lo = std::isfinite(data.lo) ? data.lo : data.hi;
    double hi = std::isfinite(data.hi) ? data.hi : data.lo;
    lo = std::clamp(lo, -largest, largest);
    hi = std::clamp(hi, -largest, largest);
    double const size = std::max(std::fabs(lo), std::fabs(hi));
    if (hi - lo <= 1e-11 * size || hi - lo < 1e-290) {
        double const room = size < 1e-280 ? 1.0 : 0.05 * size;
        return {lo - room, hi + room};
    }
    return {lo, hi};
}

/// Steps 1, 2, 5 times a power of ten, about `wanted` of them, at exact decimals.
/// @guarantee  every tick lies in axis_range(r) up to rounding; at most 3 wanted + 2 ticks
[[nodiscard]] inline tick_set nice_ticks(range const& r, int wanted) {
    range const shown = axis_range(r);
    double const rough = (shown.hi / 2 - shown.lo / 2) * 2 / std::max(wanted, 1);
    int power = static_cast<int>(std::floor(std::log10(rough)));
    double const unit = std::pow(10.0, power);
    double const share = rough / unit;
    int multiple = share <= 1.0001 ? 1 : share <= 2.0001 ? 2 : share <= 5.0001 ? 5 : 10;
    if (multiple == 10) {
        multiple = 1;
        ++power;
    }
    double const step = multiple * std::pow(10.0, power);
    double const slack = 1e-6;
    auto const first = static_cast<long long>(std::ceil(shown.lo / step - slack));
    auto const last = static_cast<long long>(std::floor(shown.hi / step + slack));

    tick_set out;
    double const size = std::max(std::fabs(shown.lo), std::fabs(shown.hi));
    int const lead = detail::leading_exponent(size);
    out.exponent = lead > 5 || lead < -3 ? lead : 0;
    for (long long k = first; k <= last && out.ticks.size() < 100; ++k) {
        scaled_decimal const exact{.negative = k < 0,
                                   .digits = std::to_string((k < 0 ? -k : k) * multiple),
                                   .exponent = power - out.exponent};
        out.ticks.push_back({static_cast<double>(k) * step, plain_text(exact)});
    }
    return out;
}

/// What stands beside an axis: its name with the common power of ten and the unit in brackets.
[[nodiscard]] inline std::string axis_text(std::string_view label, std::string_view unit,
                                           int exponent) {
    std::string inner = exponent != 0 ? "10" + detail::superscript(exponent) : "";
    inner += (inner.empty() || unit.empty() ? "" : " ") + unit_text(unit);
    return std::string{label} + (inner.empty() ? "" : " [" + inner + "]");
}

inline void draw_measured(svg& out, double x, double low, double high, std::string_view colour,
                          std::string_view tip = {}) {
    double const middle = (low + high) / 2;
    double const half = std::max(std::abs(low - high) / 2, 1.0);
    path_data d;
    d.move(x - 2.2, middle - half).line(x + 2.2, middle - half);
    d.move(x, middle - half).line(x, middle + half);
    d.move(x - 2.2, middle + half).line(x + 2.2, middle + half);
    out.path(d, {.stroke = colour, .width = 1.1}, tip);
}

inline void draw_forced_outlier(svg& out, double x, double y, std::string_view tip = {}) {
    path_data cross;
    cross.move(x - 3, y - 3).line(x + 3, y + 3).move(x - 3, y + 3).line(x + 3, y - 3);
    out.group(tip);
    out.circle(x, y, 5.6,
               {.fill = palette::paper, .stroke = palette::outlier, .width = 1.6, .opacity = 0.92});
    out.path(cross, {.stroke = palette::outlier, .width = 1.8});
    out.close();
}

inline void draw_suspect(svg& out, double x, double y, std::string_view tip = {}) {
    path_data d;
    d.move(x, y - 6).line(x + 6, y).line(x, y + 6).line(x - 6, y).close();
    out.path(d, {.fill = palette::paper, .stroke = palette::suspect, .width = 1.6, .opacity = 0.92},
             tip);
}

/// An arrowhead that points along `angle` [rad], counted against the clock.
inline void add_arrowhead(path_data& d, double x, double y, double angle) {
    double const c = std::cos(angle);
    double const n = -std::sin(angle);
    d.move(x + 9 * c, y + 9 * n).line(x - 6 * c - 4.5 * n, y - 6 * n + 4.5 * c);
    d.line(x - 3 * c, y - 3 * n).line(x - 6 * c + 4.5 * n, y - 6 * n - 4.5 * c).close();
}

/// Points at something beyond the frame.
inline void draw_beyond(svg& out, double x, double y, bool upward, std::string_view colour) {
    double const s = upward ? -1 : 1;
    path_data d;
    d.move(x - 4, y).line(x + 4, y).line(x, y + s * 6).close();
    out.path(d, {.fill = colour});
}

inline void draw_witness(svg& out, double x, double y, std::string_view tip = {}) {
    path_data cross;
    cross.move(x - 6, y).line(x + 6, y).move(x, y - 6).line(x, y + 6);
    out.group(tip);
    out.path(cross, {.stroke = palette::paper, .width = 4.5});
    out.path(cross, {.stroke = palette::black, .width = 1.8});
    out.circle(x, y, 2.6, {.fill = palette::paper, .stroke = palette::black, .width = 1.5});
    out.close();
}

/// A number that is not proved.
inline void draw_estimate(svg& out, double x, double y, std::string_view tip = {}) {
    out.circle(x, y, 4.2, {.fill = palette::paper, .stroke = palette::ink, .width = 1.6}, tip);
}

/// The paint of a region of a paving; undecided is hatched, pending dotted.
[[nodiscard]] inline std::string region_fill(svg& out, symbol region) {
    switch (region) {
    case symbol::inside:
        return std::string{palette::inside};
    case symbol::undecided:
        return out.hatch(palette::undecided, "#c98a00");
    case symbol::pending:
        return out.dots(palette::pending, "#8d4a73");
    default:
        return std::string{palette::outside};
    }
}

namespace draw_detail {

/// A symbol that is a rectangle.
inline void draw_box_symbol(svg& out, symbol what, double x, double y) {
    switch (what) {
    case symbol::tube:
        out.rect(x + 1, y + 2, 24, 10, {.fill = palette::tube, .opacity = 0.45});
        out.path(path_data{}
                     .move(x + 1, y + 2)
                     .line(x + 25, y + 2)
                     .move(x + 1, y + 12)
                     .line(x + 25, y + 12),
                 {.stroke = palette::tube_edge});
        break;
    case symbol::measured_box:
        out.rect(x + 6, y + 2, 14, 10, {.stroke = palette::measurement});
        break;
    case symbol::prior:
        out.rect(x + 1, y + 4, 24, 6, {.fill = palette::prior}, 3);
        break;
    case symbol::hull:
        out.rect(x + 1, y + 2, 24, 10, {.fill = palette::inside}, 2);
        break;
    case symbol::window:
        out.rect(x + 3, y + 1, 20, 12, {.stroke = palette::blue, .width = 1.3, .dash = "4 2"});
        break;
    case symbol::certified_window:
        out.rect(x + 3, y + 1, 20, 12, {.fill = palette::inside, .opacity = 0.28});
        out.rect(x + 3, y + 1, 20, 12, {.stroke = palette::inside, .width = 1.6});
        break;
    case symbol::bar_to_lower:
        out.rect(x + 1, y + 2, 24, 10, {.fill = palette::frame});
        break;
    case symbol::bar_to_upper:
        out.rect(x + 1, y + 2, 24, 10,
                 {.fill = out.hatch("#ffffff", palette::frame), .stroke = palette::frame});
        break;
    default: { // of a region
        std::string const fill = region_fill(out, what);
        out.rect(x + 4, y + 1, 18, 12, {.fill = fill, .stroke = palette::frame, .width = 0.8}, 2);
    }
    }
}

} // namespace draw_detail

/// One symbol in a cell of 26 x 14 whose upper left corner is (x, y).
inline void draw_symbol(svg& out, symbol what, double x, double y) {
    double const mx = x + 13;
    double const my = y + 7;
    auto const line = [&](paint const& how) { out.line(x + 1, my, x + 25, my, how); };
    path_data arrow;
    switch (what) {
    case symbol::measured:
        return draw_measured(out, mx, y + 12, y + 2, palette::measurement);
    case symbol::forced_outlier:
        return draw_forced_outlier(out, mx, my);
    case symbol::suspect:
        return draw_suspect(out, mx, my);
    case symbol::reference:
        return line({.stroke = palette::truth, .width = 1.6, .dash = "5 3"});
    case symbol::witness:
        return draw_witness(out, mx, my);
    case symbol::heading:
        add_arrowhead(arrow, mx - 1, my, 0);
        out.path(arrow, {.fill = palette::paper, .stroke = palette::truth, .width = 1.2});
        return;
    case symbol::line_before:
        return line(line_before_paint);
    case symbol::line_after:
        return line(line_after_paint);
    case symbol::estimate:
        return draw_estimate(out, mx, my);
    default:
        return draw_detail::draw_box_symbol(out, what, x, y);
    }
}

/// Draws a legend in rows no wider than `width`. @returns its height
inline double draw_legend(svg& out, std::vector<legend_entry> const& entries, double x, double y,
                          double width) {
    double column = 0;
    double row = 0;
    for (legend_entry const& e : entries) {
        double const wide = 32 + approximate_text_width(e.label, 11.5) + 16;
        if (column > 0 && column + wide > width) {
            column = 0;
            row += 20;
        }
        draw_symbol(out, e.mark, x + column, y + row);
        out.text(x + column + 32, y + row + 11, e.label, {.size = 11.5});
        column += wide;
    }
    return entries.empty() ? 0 : row + 20;
}

/// A symbol alone, for a legend set in HTML.
[[nodiscard]] inline svg symbol_picture(symbol what, std::string_view label) {
    svg out{26, 14, label};
    draw_symbol(out, what, 0, 0);
    return out;
}

/// What an axis shows.
struct axis {
    std::string label{};
    std::string unit{};
    range bounds{};
};

struct axes_options {
    double width = 360;
    double height = 240;
    std::string title{};
    bool equal_aspect = false; ///< one unit of x is as long as one of y; the ranges grow to fit
    bool grid = true;
};

/// A frame with two linear axes: maps data to the drawing and draws ticks, labels and title.
class axes {
public:
    axes(axis x, axis y, axes_options options)
        : x_{std::move(x)}, y_{std::move(y)}, options_{std::move(options)} {
        x_.bounds = axis_range(x_.bounds);
        y_.bounds = axis_range(y_.bounds);
        top_ = options_.title.empty() ? 12 : 30;
        bottom_ = options_.height - 40;
        right_ = options_.width - 14;
        arrange();
        if (options_.equal_aspect) {
            make_aspect_equal();
            arrange();
            // New labels may have moved the frame; this time it stays.
            make_aspect_equal();
            choose_ticks();
        }
    }

    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double right() const { return right_; }
    [[nodiscard]] double top() const { return top_; }
    [[nodiscard]] double bottom() const { return bottom_; }
    [[nodiscard]] range const& x_bounds() const { return x_.bounds; }
    [[nodiscard]] range const& y_bounds() const { return y_.bounds; }

    /// Place of a value in the drawing. Values far outside, infinite ones too, end near the frame.
    [[nodiscard]] double px(double x) const {
        return left_ + (right_ - left_) * share(x, x_.bounds);
    }
    [[nodiscard]] double py(double y) const {
        return bottom_ - (bottom_ - top_) * share(y, y_.bounds);
    }

    /// Ground, grid and title. Of what is drawn until `close` only what lies in the frame shows.
    void open(svg& out) const {
        out.rect(left_, top_, right_ - left_, bottom_ - top_, {.fill = palette::paper});
        if (!options_.title.empty()) {
            out.text(left_, top_ - 11,
                     shorten(options_.title, static_cast<std::size_t>((right_ - left_) / 6.5)),
                     {.size = 13, .bold = true});
        }
        if (options_.grid) {
            path_data lines;
            for (tick const& t : x_ticks_.ticks) {
                lines.move(px(t.value), top_).line(px(t.value), bottom_);
            }
            for (tick const& t : y_ticks_.ticks) {
                lines.move(left_, py(t.value)).line(right_, py(t.value));
            }
            out.path(lines, {.stroke = palette::grid});
        }
        out.clip(left_, top_, right_ - left_, bottom_ - top_);
    }

    /// Frame, ticks and labels, after the data. Tells the page's script where values are.
    void close(svg& out) const {
        out.close();
        place(out, "x", x_, left_, right_);
        place(out, "y", y_, bottom_, top_);
        path_data marks;
        marks.rect(left_, top_, right_ - left_, bottom_ - top_);
        for (tick const& t : x_ticks_.ticks) {
            marks.move(px(t.value), bottom_).line(px(t.value), bottom_ + 4);
        }
        for (tick const& t : y_ticks_.ticks) {
            marks.move(left_ - 4, py(t.value)).line(left_, py(t.value));
        }
        out.path(marks, {.stroke = palette::frame});
        for (tick const& t : x_ticks_.ticks) {
            out.text(px(t.value), bottom_ + 16, t.label,
                     {.size = 11, .align = anchor::middle, .fill = palette::muted_ink});
        }
        for (tick const& t : y_ticks_.ticks) {
            out.text(left_ - 7, py(t.value) + 3.8, t.label,
                     {.size = 11, .align = anchor::end, .fill = palette::muted_ink});
        }
        std::string const x_label = full_label(x_, x_ticks_);
        std::string const y_label = full_label(y_, y_ticks_);
        out.text((left_ + right_) / 2, bottom_ + 33, x_label,
                 {.size = fitting_size(x_label, options_.width - 20), .align = anchor::middle});
        out.text(label_x_, (top_ + bottom_) / 2, y_label,
                 {.size = fitting_size(y_label, bottom_ - top_ + 20),
                  .align = anchor::middle,
                  .rotate = -90});
    }

    /// A few quiet words across the frame, in the middle or at y: where there is nothing to draw.
    void say(svg& out, std::string_view words, std::optional<double> y = {}) const {
        out.text((left_ + right_) / 2, y.value_or((top_ + bottom_) / 2), words,
                 {.size = 12, .align = anchor::middle, .fill = palette::muted_ink});
    }

private:
    static void place(svg& out, std::string const& name, axis const& a, double from, double to) {
        out.data(name, coordinate(from) + ' ' + coordinate(to) + ' ' +
                           sivid::nearest_text(a.bounds.lo) + ' ' +
                           sivid::nearest_text(a.bounds.hi));
        out.data(name + "-name", a.label).data(name + "-unit", unit_text(a.unit));
    }
    static double share(double value, range const& r) {
        double const s = (value / 2 - r.lo / 2) / (r.hi / 2 - r.lo / 2);
        return std::isnan(s) ? 0.0 : std::clamp(s, -2.0, 3.0);
    }
    // Long names are set smaller rather than cut.
    static double fitting_size(std::string const& text, double room) {
        double const size = 11.5;
        return std::clamp(size * room / std::max(approximate_text_width(text, size), 1.0), 5.0,
                          size);
    }
    static std::string full_label(axis const& a, tick_set const& ticks) {
        return axis_text(shorten(a.label, 40), a.unit, ticks.exponent);
    }
    static double widest(tick_set const& set) {
        double widest = 0;
        for (tick const& t : set.ticks) {
            widest = std::max(widest, approximate_text_width(t.label, 11));
        }
        return widest;
    }
    // Ticks depend on the room, the room on the labels: y first, then x with what is left.
    void arrange() {
        choose_ticks();
        left_ = std::clamp(widest(y_ticks_) + 30, 44.0, options_.width / 2);
        choose_ticks();
    }
    void choose_ticks() {
        int const rows = std::clamp(static_cast<int>((bottom_ - top_) / 34), 2, 8);
        // A single tick tells no scale.
        for (int wanted = rows; wanted < rows + 3; ++wanted) {
            y_ticks_ = nice_ticks(y_.bounds, wanted);
            if (y_ticks_.ticks.size() > 1) break;
        }
        label_x_ = std::max(left_ - widest(y_ticks_) - 15, 10.0);
        for (int columns = std::clamp(static_cast<int>((right_ - left_) / 45), 2, 12); columns >= 1;
             --columns) {
            x_ticks_ = nice_ticks(x_.bounds, columns);
            double const room =
                (right_ - left_) / std::max<double>(1, static_cast<double>(x_ticks_.ticks.size()));
            if (widest(x_ticks_) + 8 <= room) break;
        }
    }
    void make_aspect_equal() {
        double const wide = right_ - left_;
        double const high = bottom_ - top_;
        double const x_size = approximate_width(x_.bounds);
        double const y_size = approximate_width(y_.bounds);
        double const per_unit = std::min(wide / x_size, high / y_size);
        if (!std::isfinite(per_unit) || per_unit <= 0) return;
        x_.bounds = with_margin(x_.bounds, std::max(0.0, (wide / per_unit / x_size - 1) / 2));
        y_.bounds = with_margin(y_.bounds, std::max(0.0, (high / per_unit / y_size - 1) / 2));
    }

    axis x_;
    axis y_;
    axes_options options_;
    tick_set x_ticks_;
    tick_set y_ticks_;
    double left_ = 44;
    double right_ = 0;
    double top_ = 0;
    double bottom_ = 0;
    double label_x_ = 0;
};

} // namespace sivid::report

#endif
