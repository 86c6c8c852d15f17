// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_TICKS_HPP
#define SIVID_REPORT_DRAW_TICKS_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/text/range.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
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

/// A range that an axis can show, whatever comes in: finite, of positive width, and wide enough
/// for doubles to tell its pixels apart. Empty and NaN give [0, 1]; an infinite end is replaced by
/// the finite one; a single value gets room on both sides.
[[nodiscard]] SIVID_DECL range axis_range(range const& data);

/// Steps 1, 2, 5 times a power of ten, about `wanted` of them, at exact decimals.
/// @guarantee  every tick lies in axis_range(r) up to rounding; at most 3 wanted + 2 ticks
[[nodiscard]] SIVID_DECL tick_set nice_ticks(range const& r, int wanted);

/// What stands beside an axis: its name with the common power of ten and the unit in brackets.
[[nodiscard]] SIVID_DECL std::string axis_text(std::string_view label, std::string_view unit,
                                               int exponent);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/ticks.ipp>
#endif

#endif
