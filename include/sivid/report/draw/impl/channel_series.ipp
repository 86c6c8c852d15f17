// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_CHANNEL_SERIES_IPP
#define SIVID_REPORT_DRAW_IMPL_CHANNEL_SERIES_IPP

#include <sivid/report/draw/channel_series.hpp>

namespace sivid::report {

namespace detail {

SIVID_DECL range value_range(channel_series const& c) {
    range core;
    range rest;
    for (measured_sample const& m : c.measured) {
        if (is_finite(m.value)) {
            (m.state == sample_state::regular ? core : rest) =
                hull(m.state == sample_state::regular ? core : rest, m.value);
        }
    }
    for (point const& p : c.reference) core = hull(core, p.y);
    for (tube_piece const& t : c.tube) rest = hull(hull(rest, t.value.lo), t.value.hi);
    if (is_empty(core)) core = rest;
    if (is_empty(core)) return {0, 1};
    range const most = with_margin(axis_range(core), 2);
    range shown = core;
    if (!is_empty(rest)) {
        shown = hull(hull(core, std::clamp(rest.lo, most.lo, most.hi)),
                     std::clamp(rest.hi, most.lo, most.hi));
    }
    return with_margin(axis_range(shown), 0.06);
}

SIVID_DECL range time_range(channel_series const& c) {
    range out;
    for (measured_sample const& m : c.measured) out = hull(out, m.time);
    for (tube_piece const& t : c.tube) out = hull(hull(out, t.from), t.to);
    for (point const& p : c.reference) out = hull(out, p.x);
    return with_margin(axis_range(out), 0.015);
}

SIVID_DECL std::string sample_tip(channel_series const& c, measured_sample const& m) {
    std::string tip = "t = " + given_text(m.time) + unit_suffix(c.time_unit) + ": measured " +
                      outward_text(m.value) + ' ' + unit_text(c.unit);
    if (!is_empty(m.enclosure)) tip += std::string{", model within "} + outward_text(m.enclosure);
    return tip + (m.state == sample_state::forced_outlier ? ", outlier (proved)"
                  : m.state == sample_state::suspect      ? ", suspected outlier"
                                                          : "");
}

} // namespace detail

} // namespace sivid::report

#endif
