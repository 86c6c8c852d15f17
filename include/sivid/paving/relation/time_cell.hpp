// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_TIME_CELL_HPP
#define SIVID_PAVING_RELATION_TIME_CELL_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
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

/// The given times, each gap cut into pieces no longer than about `step`. Halves, thirds and so on
/// of a gap are the same doubles whatever the number of pieces is.
[[nodiscard]] inline std::vector<double> refined_times(std::vector<double> times, double step) {
    std::sort(times.begin(), times.end());
    std::vector<double> result;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        double const gap = times[k + 1] - times[k];
        auto const pieces =
            static_cast<std::size_t>(std::clamp(std::ceil(gap / step - 1e-6), 1.0, 1e3));
        for (std::size_t p = 0; p < pieces; ++p) {
            double const t =
                times[k] + gap * (static_cast<double>(p) / static_cast<double>(pieces));
            if (result.empty() || result.back() < t) result.push_back(t);
        }
    }
    if (result.empty() || result.back() < times.back()) result.push_back(times.back());
    return result;
}

/// Windows (first, last) between so many times: of many lengths, each about half as much longer
/// than the one before, from one gap to all; those of a length overlap, and are some hundred at
/// most.
[[nodiscard]] inline std::vector<std::pair<std::size_t, std::size_t>>
spread_windows(std::size_t times) {
    std::vector<std::pair<std::size_t, std::size_t>> result;
    std::size_t last = 0;
    for (double gaps = 1; last + 1 < times; gaps *= 1.5) {
        auto const length = std::min(static_cast<std::size_t>(gaps), times - 1);
        if (length == last) continue;
        last = length;
        auto const stride = std::max(length / 8, times / 128 + 1);
        for (std::size_t a = 0; a + length < times; a += stride) result.emplace_back(a, a + length);
    }
    return result;
}

} // namespace sivid

#endif
