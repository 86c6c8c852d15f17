// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_RECORD_HPP
#define SIVID_MEASUREMENT_RECORD_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// What an instrument proves: the true value of `channel` at `time` lies in `bound`, unless the
/// sample is an outlier.
struct measurement {
    double time = 0;         ///< in the model's unit of time
    std::size_t channel = 0; ///< index into the model's channels
    interval bound;          ///< in the channel's unit
};

/// Scalar measurements of one scenario in the order of their times.
using record = std::vector<measurement>;

/// Orders by time, then channel.
[[nodiscard]] inline record sorted(record samples) {
    auto const before = [](measurement const& a, measurement const& b) {
        return a.time < b.time || (a.time == b.time && a.channel < b.channel);
    };
    // Records mostly come so, and to see it takes one pass.
    if (!std::is_sorted(samples.begin(), samples.end(), before))
        std::stable_sort(samples.begin(), samples.end(), before);
    return samples;
}

} // namespace sivid

#endif
