// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_CHANNEL_SERIES_HPP
#define SIVID_REPORT_DRAW_CHANNEL_SERIES_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/ticks.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/text/range.hpp>

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
    std::string time_unit = "s";
};

namespace detail {

/// The range worth showing: regular measurements and the reference decide, the tube and outliers
/// may stretch it by at most twice its width, so that one wild value does not flatten the rest.
SIVID_DECL range value_range(channel_series const& c);

SIVID_DECL range time_range(channel_series const& c);

SIVID_DECL std::string sample_tip(channel_series const& c, measured_sample const& m);

} // namespace detail

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/channel_series.ipp>
#endif

#endif
