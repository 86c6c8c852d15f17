// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_INTERVAL_CHART_IPP
#define SIVID_REPORT_DRAW_IMPL_INTERVAL_CHART_IPP

#include <sivid/report/draw/detail/interval_chart.hpp>

namespace sivid::report {

SIVID_DECL svg draw_interval_chart(std::vector<interval_row> const& rows,
                                   interval_chart_options const& o) {
    double const top = o.title.empty() ? 6 : 30;
    double const pitch = 52;
    svg out{o.width, top + pitch * static_cast<double>(std::max<std::size_t>(rows.size(), 1)) + 4,
            o.title.empty() ? "parameters" : o.title};
    if (!o.title.empty()) out.text(0, 16, o.title, {.size = 13, .bold = true});
    double name_width = 40;
    for (interval_row const& r : rows) {
        name_width = std::max(name_width, approximate_text_width(shorten(r.name, 24), 13) + 14);
    }
    double const left = std::min(name_width, o.width * 0.4);
    double const right = o.width - 14;
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
                 std::string{"prior "} + given_text(r.prior));
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
            draw_witness(out, px(*r.witness), y + 20,
                         std::string{"witness "} + exact_text(*r.witness) + unit);
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
