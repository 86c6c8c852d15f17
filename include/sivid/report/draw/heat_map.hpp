// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_HEAT_MAP_HPP
#define SIVID_REPORT_DRAW_HEAT_MAP_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/axes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

/// Values of channels over time windows, for example by how much each window misses its bounds.
struct heat_map {
    std::vector<std::string> rows{};           ///< channel names
    std::vector<double> times{};               ///< the windows' ends, one more than columns
    std::vector<std::vector<double>> values{}; ///< [row][column]; NaN: nothing known
    std::string quantity{};
    double threshold = 1; ///< above it a value is painted orange and crossed
    std::string time_unit = "s";
};

struct heat_map_options {
    double width = 740;
    std::string title{};
    double largest = 0; ///< the colours' end is not below it: lets maps share their colours
    bool key = true;    ///< draw the colour bar
};

/// The largest finite value of a map; 0 when there is none.
[[nodiscard]] SIVID_DECL double largest_value(heat_map const& m);

/// Channels against time in colour: blue up to the threshold, orange with a cross above it, hatched
/// where nothing is known; with a colour bar.
[[nodiscard]] SIVID_DECL svg draw_heat_map(heat_map const& m, heat_map_options const& o = {});

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/heat_map.ipp>
#endif

#endif
