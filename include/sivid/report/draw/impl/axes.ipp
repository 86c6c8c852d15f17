// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_AXES_IPP
#define SIVID_REPORT_DRAW_IMPL_AXES_IPP

#include <sivid/report/draw/axes.hpp>

#include <cstdlib>

namespace sivid::report {

SIVID_DECL range axis_range(range const& data) {
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

SIVID_DECL tick_set nice_ticks(range const& r, int wanted) {
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

SIVID_DECL std::string axis_text(std::string_view label, std::string_view unit, int exponent) {
    std::string inner = exponent != 0 ? "10" + detail::superscript(exponent) : "";
    inner += (inner.empty() || unit.empty() ? "" : " ") + unit_text(unit);
    return std::string{label} + (inner.empty() ? "" : " [" + inner + "]");
}

SIVID_DECL void draw_measured(svg& out, double x, double low, double high, std::string_view colour,
                              std::string_view tip) {
    double const middle = (low + high) / 2;
    double const half = std::max(std::abs(low - high) / 2, 1.0);
    path_data d;
    d.move(x - 2.2, middle - half).line(x + 2.2, middle - half);
    d.move(x, middle - half).line(x, middle + half);
    d.move(x - 2.2, middle + half).line(x + 2.2, middle + half);
    out.path(d, {.stroke = colour, .width = 1.1}, tip);
}

SIVID_DECL void draw_forced_outlier(svg& out, double x, double y, std::string_view tip) {
    path_data cross;
    cross.move(x - 3, y - 3).line(x + 3, y + 3).move(x - 3, y + 3).line(x + 3, y - 3);
    out.group(tip);
    out.circle(x, y, 5.6,
               {.fill = palette::paper, .stroke = palette::outlier, .width = 1.6, .opacity = 0.92});
    out.path(cross, {.stroke = palette::outlier, .width = 1.8});
    out.close();
}

SIVID_DECL void draw_suspect(svg& out, double x, double y, std::string_view tip) {
    path_data d;
    d.move(x, y - 6).line(x + 6, y).line(x, y + 6).line(x - 6, y).close();
    out.path(d, {.fill = palette::paper, .stroke = palette::suspect, .width = 1.6, .opacity = 0.92},
             tip);
}

SIVID_DECL void add_arrowhead(path_data& d, double x, double y, double angle) {
    double const c = std::cos(angle);
    double const n = -std::sin(angle);
    d.move(x + 9 * c, y + 9 * n).line(x - 6 * c - 4.5 * n, y - 6 * n + 4.5 * c);
    d.line(x - 3 * c, y - 3 * n).line(x - 6 * c + 4.5 * n, y - 6 * n - 4.5 * c).close();
}

SIVID_DECL void draw_beyond(svg& out, double x, double y, bool upward, std::string_view colour) {
    double const s = upward ? -1 : 1;
    path_data d;
    d.move(x - 4, y).line(x + 4, y).line(x, y + s * 6).close();
    out.path(d, {.fill = colour});
}

SIVID_DECL void draw_witness(svg& out, double x, double y, std::string_view tip) {
    path_data cross;
    cross.move(x - 6, y).line(x + 6, y).move(x, y - 6).line(x, y + 6);
    out.group(tip);
    out.path(cross, {.stroke = palette::paper, .width = 4.5});
    out.path(cross, {.stroke = palette::black, .width = 1.8});
    out.circle(x, y, 2.6, {.fill = palette::paper, .stroke = palette::black, .width = 1.5});
    out.close();
}

SIVID_DECL void draw_estimate(svg& out, double x, double y, std::string_view tip) {
    out.circle(x, y, 4.2, {.fill = palette::paper, .stroke = palette::ink, .width = 1.6}, tip);
}

namespace draw_detail {

/// A symbol that is a rectangle.
inline void draw_box_symbol(svg& out, symbol what, double x, double y) {
    switch (what) {
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
inline void draw_tube_symbol(svg& out, double x, double y) {
    out.rect(x + 1, y + 2, 24, 10, {.fill = palette::tube, .opacity = 0.45});
    out.path(
        path_data{}.move(x + 1, y + 2).line(x + 25, y + 2).move(x + 1, y + 12).line(x + 25, y + 12),
        {.stroke = palette::tube_edge});
}
inline void draw_line_symbol(svg& out, double x, double y, paint const& how) {
    out.line(x + 1, y + 7, x + 25, y + 7, how);
}
inline void draw_heading_symbol(svg& out, double x, double y) {
    path_data arrow;
    add_arrowhead(arrow, x, y, 0);
    out.path(arrow, {.fill = palette::paper, .stroke = palette::truth, .width = 1.2});
}

} // namespace draw_detail

SIVID_DECL void draw_symbol(svg& out, symbol what, double x, double y) {
    double const mx = x + 13;
    double const my = y + 7;
    switch (what) {
    case symbol::measured:
        return draw_measured(out, mx, y + 12, y + 2, palette::measurement);
    case symbol::forced_outlier:
        return draw_forced_outlier(out, mx, my);
    case symbol::suspect:
        return draw_suspect(out, mx, my);
    case symbol::tube:
        return draw_detail::draw_tube_symbol(out, x, y);
    case symbol::reference:
        return draw_detail::draw_line_symbol(
            out, x, y, {.stroke = palette::truth, .width = 1.6, .dash = "5 3"});
    case symbol::witness:
        return draw_witness(out, mx, my);
    case symbol::heading:
        return draw_detail::draw_heading_symbol(out, mx - 1, my);
    case symbol::line_before:
        return draw_detail::draw_line_symbol(out, x, y, line_before_paint);
    case symbol::line_after:
        return draw_detail::draw_line_symbol(out, x, y, line_after_paint);
    case symbol::estimate:
        return draw_estimate(out, mx, my);
    default:
        return draw_detail::draw_box_symbol(out, what, x, y);
    }
}

SIVID_DECL std::string region_fill(svg& out, symbol region) {
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

SIVID_DECL double draw_legend(svg& out, std::vector<legend_entry> const& entries, double x,
                              double y, double width) {
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

SIVID_DECL svg symbol_picture(symbol what, std::string_view label) {
    svg out{26, 14, label};
    draw_symbol(out, what, 0, 0);
    return out;
}

} // namespace sivid::report

#endif
