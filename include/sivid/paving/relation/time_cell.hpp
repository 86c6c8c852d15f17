// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_TIME_CELL_HPP
#define SIVID_PAVING_RELATION_TIME_CELL_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/interval_traits.hpp>

#include <vector>

namespace sivid {

/// A quantity over one cell of time: a straight line that passes `centre` in the middle of the cell
/// and rises by `drift` along it, plus something in `spread`, plus something whose modulus is at
/// most `departure` on the average.
struct cell_line {
    double centre = 0, drift = 0;
    interval spread{0.0};
    double departure = 0;

    /// From what is open beside the line from `start` to `end`.
    [[nodiscard]] static cell_line of(double start, double end, interval const& beside,
                                      double departure = 0) {
        using traits = interval_traits<interval>;
        double const centre = start + (end - start) / 2;
        auto const sum = traits::add(traits::point(start), traits::point(end));
        auto const middle = traits::mul(traits::point(0.5), sum);
        auto const drift = traits::sub(traits::point(end), traits::point(start));
        return {centre, mag(drift), traits::add(beside, traits::sub(middle, traits::point(centre))),
                departure};
    }
    /// Without a drift.
    [[nodiscard]] static cell_line still(interval const& range) {
        double const centre = mid(range);
        return {centre, 0.0, interval_traits<interval>::sub(range, interval(centre)), 0.0};
    }
};

/// What is known over one cell of time.
struct time_cell {
    double from = 0, to = 0;
    leaf_ranges at;               ///< all leaves in the cell; unknown constants over their prior
    std::vector<cell_line> lines; ///< of states, then inputs, then time
};

} // namespace sivid

#endif
