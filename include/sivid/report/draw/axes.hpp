// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_AXES_HPP
#define SIVID_REPORT_DRAW_AXES_HPP

#include <sivid/number/text/nearest_text.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/draw/ticks.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sivid::report {

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
