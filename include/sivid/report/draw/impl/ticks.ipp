// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_TICKS_IPP
#define SIVID_REPORT_DRAW_IMPL_TICKS_IPP

#include <sivid/report/draw/ticks.hpp>

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
    std::string inner;
    if (exponent != 0) {
        inner = "10";
        inner += detail::superscript(exponent);
    }
    if (!unit.empty()) {
        inner += inner.empty() ? "" : " ";
        inner += unit_text(unit);
    }
    std::string out{label};
    if (!inner.empty()) {
        out += " [";
        out += inner;
        out += ']';
    }
    return out;
}

} // namespace sivid::report

#endif
