// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SAMPLING_HPP
#define SIVID_MODEL_SAMPLING_HPP

#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace sivid {

/// How densely and for how long something is measured. A model may count time in any unit: what
/// has to be a length of time without being asked for is told by these two.
struct sampling {
    double gap = 0;    ///< from one measurement to the next, the median
    double record = 0; ///< from the begin to the last measurement

    /// So many gaps, but no less than a share of the record, and no more than all of it.
    [[nodiscard]] double span(double gaps, double share) const {
        return std::min(record, std::max(gaps * gap, share * record));
    }
};

/// The median of the gaps between the measurements of each channel, and the longest record.
[[nodiscard]] inline sampling sampling_of(std::vector<experiment> const& experiments) {
    sampling result;
    std::vector<double> gaps;
    for (auto const& e : experiments) {
        result.record = std::max(result.record, e.end() - e.begin);
        std::map<std::size_t, std::vector<double>> channels;
        for (auto const& m : e.measurements) channels[m.channel].push_back(m.time);
        for (auto& [channel, times] : channels) {
            std::sort(times.begin(), times.end());
            for (std::size_t k = 1; k < times.size(); ++k)
                if (times[k] > times[k - 1]) gaps.push_back(times[k] - times[k - 1]);
        }
    }
    if (gaps.empty()) return result;
    auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    result.gap = *middle;
    return result;
}

} // namespace sivid

#endif
