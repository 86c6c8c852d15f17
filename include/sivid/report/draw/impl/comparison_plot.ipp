// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_COMPARISON_PLOT_IPP
#define SIVID_REPORT_DRAW_IMPL_COMPARISON_PLOT_IPP

#include <sivid/report/draw/comparison_plot.hpp>

namespace sivid::report {

namespace detail {

SIVID_DECL channel_series plain_series(comparison_series const& c) {
    channel_series out{c.name, c.unit, c.measured, c.tube, c.after, c.time_unit};
    for (point const& p : c.before)
        if (is_finite(p)) out.tube.push_back({p.x, p.x, {p.y, p.y}});
    return out;
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

} // namespace detail

SIVID_DECL std::vector<legend_entry> comparison_legend(std::vector<comparison_series> const& all,
                                                       std::string const& second) {
    bool measured = false, suspect = false, before = false, after = false, tube = false;
    for (comparison_series const& c : all) {
        before = before || !c.before.empty();
        after = after || !c.after.empty();
        tube = tube || !c.tube.empty();
        for (measured_sample const& m : c.measured) {
            (m.state == sample_state::regular ? measured : suspect) = true;
        }
    }
    return legend_of({{measured, {symbol::measured, "measured interval"}},
                      {suspect, {symbol::suspect, "suspected outlier"}},
                      {before, {symbol::line_before, "model as it is, best fit (estimate)"}},
                      {after, {symbol::line_after, "model " + second + ", best fit (estimate)"}},
                      {tube, {symbol::tube, "predicted tube " + second}}});
}

SIVID_DECL svg draw_comparison_plot(comparison_series const& c, time_plot_options const& o) {
    auto const plain = detail::plain_series(c);
    svg out{o.width, o.height, (o.title.empty() ? c.name : o.title) + ", before and after"};
    auto const a = detail::time_axes(o, detail::time_range(plain), c.time_unit,
                                     {c.name, c.unit, detail::value_range(plain)});
    a.open(out);
    detail::draw_tube(out, a, c.tube);
    std::size_t const stride = c.measured.size() / std::max<std::size_t>(o.most_samples, 1) + 1;
    auto const marked = detail::draw_regular(out, a, plain, stride, palette::frame);
    // Lines above the bars: it is they that are compared.
    detail::draw_reference(out, a, c.before, line_before_paint);
    detail::draw_reference(out, a, c.after, line_after_paint);
    for (std::size_t i = 0; i < std::min(marked.size(), 4 * o.most_samples); ++i) {
        detail::draw_outlier(out, a, *marked[i], approximate_middle(marked[i]->value),
                             detail::sample_tip(plain, *marked[i]));
    }
    a.close(out);
    if (c.measured.empty() && c.before.empty() && c.after.empty() && c.tube.empty()) {
        a.say(out, "no data");
    }
    return out;
}

SIVID_DECL heat_map misfit_map(std::vector<comparison_series> const& channels, bool after,
                               std::size_t most_columns) {
    heat_map out{.quantity = "|residual| / bound"};
    if (!channels.empty()) out.time_unit = channels.front().time_unit;
    range span;
    std::size_t columns = 1;
    for (comparison_series const& c : channels) {
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
    for (comparison_series const& c : channels) {
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

} // namespace sivid::report

#endif
