// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_CHANNEL_SERIES_HPP
#define SIVID_REPORT_CHANNEL_SERIES_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/range.hpp>
#include <sivid/report/ticks.hpp>

#include <algorithm>
#include <string>
#include <string_view>
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

/// One channel of one scenario.
struct channel_series {
    std::string name{};
    std::string unit{};
    std::vector<measured_sample> measured{};
    std::vector<tube_piece> tube{}; ///< in order of time
    std::vector<point> reference{}; ///< (t, value), not validated
};

namespace detail {

/// The range worth showing: regular measurements and the reference decide, the tube and outliers
/// may stretch it by at most twice its width, so that one wild value does not flatten the rest.
SIVID_ENTRY range value_range(channel_series const& c);

SIVID_ENTRY range time_range(channel_series const& c);

SIVID_ENTRY std::string sample_tip(channel_series const& c, measured_sample const& m,
                                   std::string_view time_unit);

} // namespace detail

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_CHANNEL_SERIES)
namespace detail {

SIVID_ENTRY range value_range(channel_series const& c) {
    range core;
    range rest;
    for (measured_sample const& m : c.measured) {
        if (is_finite(m.value)) {
            (m.state == sample_state::regular ? core : rest) =
                hull(m.state == sample_state::regular ? core : rest, m.value);
        }
    }
    for (point const& p : c.reference) {
        core = hull(core, p.y);
    }
    for (tube_piece const& t : c.tube) {
        rest = hull(hull(rest, t.value.lo), t.value.hi);
    }
    if (is_empty(core)) {
        core = rest;
    }
    if (is_empty(core)) {
        return {0, 1};
    }
    range const most = with_margin(axis_range(core), 2);
    range shown = core;
    if (!is_empty(rest)) {
        shown = hull(hull(core, std::clamp(rest.lo, most.lo, most.hi)),
                     std::clamp(rest.hi, most.lo, most.hi));
    }
    return with_margin(axis_range(shown), 0.06);
}

SIVID_ENTRY range time_range(channel_series const& c) {
    range out;
    for (measured_sample const& m : c.measured) {
        out = hull(out, m.time);
    }
    for (tube_piece const& t : c.tube) {
        out = hull(hull(out, t.from), t.to);
    }
    for (point const& p : c.reference) {
        out = hull(out, p.x);
    }
    return with_margin(axis_range(out), 0.015);
}

SIVID_ENTRY std::string sample_tip(channel_series const& c, measured_sample const& m,
                                   std::string_view time_unit) {
    std::string tip = std::string{"t = "} + given_text(m.time) + ' ' + std::string{time_unit} +
                      ": measured " + outward_text(m.value) + ' ' + unit_text(c.unit);
    if (!is_empty(m.enclosure)) {
        tip += std::string{", model within "} + outward_text(m.enclosure);
    }
    return tip + (m.state == sample_state::forced_outlier ? ", outlier (proved)"
                  : m.state == sample_state::suspect      ? ", suspected outlier"
                                                          : "");
}

} // namespace detail
#endif

} // namespace sivid::report

#endif
