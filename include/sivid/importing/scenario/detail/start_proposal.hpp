// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_START_PROPOSAL_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_START_PROPOSAL_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/paving/response/relaxed_intersection.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A reading beside a start at t = 0: the true value lies in value +/- error.
struct start_reading {
    double time = 0; ///< 0 or later, increasing
    exact_decimal value, error;
    interval bound; ///< encloses value +/- error
};

/// Where a state starts, as readings say it.
struct start_proposal {
    std::optional<stated_range> range;
    bool contradicted = false; ///< nothing agrees with readings and bounds: one of them is wrong
    std::string refusal;       ///< why there is no range
};

namespace io_detail {

/// What all but `outliers` of the intervals have in common, as decimals.
[[nodiscard]] inline start_proposal common_start(std::vector<interval> const& all,
                                                 std::size_t outliers) {
    start_proposal result;
    if (all.size() <= outliers) {
        result.refusal = outliers == 0 ? "too few readings" : "all readings nearby may be outliers";
        return result;
    }
    auto const common = relaxed_intersection(all, outliers);
    double const a = common.lower(), b = common.upper();
    if (is_empty(common)) {
        result.contradicted = true;
        result.refusal = "no value agrees with the readings";
    } else if (!(std::abs(a) < farthest_range / 2 && std::abs(b) < farthest_range / 2)) {
        result.refusal = "the readings bound it beyond 1e100 only";
    } else {
        constexpr std::size_t digits = 9;
        auto const lower = exact_decimal::of(a).divided_by(1, digits).first;
        auto const upper = exact_decimal::of(b).divided_by(1, digits).second;
        result.range = stated_range{lower, upper, *enclose(lower, upper)};
    }
    return result;
}

[[nodiscard]] inline start_proposal value_at_start(mapped_start const& m,
                                                   std::vector<start_reading> const& readings,
                                                   std::size_t outliers) {
    if (!m.bounded) {
        start_proposal result;
        if (readings.empty() || readings.front().time > 0) {
            result.refusal = "no reading just at the start";
        } else if (outliers > 0) {
            result.refusal = "the one reading at the start may be an outlier";
        } else {
            auto const& r = readings.front();
            auto const lower = r.value - r.error, upper = r.value + r.error;
            result.range = stated_range{lower, upper, r.bound};
            if (!(mag(r.bound) < farthest_range)) {
                result.range.reset();
                result.refusal = "the reading is beyond 1e100";
            }
        }
        return result;
    }
    std::vector<interval> all;
    auto const count = std::min(readings.size(), std::max<std::size_t>(64, 4 * (outliers + 1)));
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(readings[i].bound - m.range.enclosure * interval{readings[i].time});
    return common_start(all, outliers);
}

[[nodiscard]] inline start_proposal rate_at_start(mapped_start const& m,
                                                  std::vector<start_reading> const& readings,
                                                  std::size_t outliers) {
    if (readings.empty()) return {std::nullopt, false, "too few readings"};
    // A pair bounds best at 2 sqrt(e/a) from the start; those further off are worse than wide.
    double const a = mag(m.range.enclosure), e = width(readings.front().bound) / 2;
    double const reach = a > 0 ? 6 * std::sqrt(e / a) : std::numeric_limits<double>::infinity();
    auto const near = static_cast<std::size_t>(
        std::partition_point(readings.begin(), readings.end(),
                             [&](auto const& r) { return r.time <= reach; }) -
        readings.begin());
    auto const least = 4 * (outliers + 1);
    auto const used = std::min(std::max(near, least), readings.size());
    auto const stride = 1 + (used - 1) / std::max<std::size_t>(64, least);
    std::vector<start_reading const*> chosen;
    for (std::size_t i = 0; i < used; i += stride) chosen.push_back(&readings[i]);
    std::vector<interval> all;
    auto const pair = [&](std::size_t i, std::size_t j) {
        auto const &from = *chosen[i], &to = *chosen[j];
        interval const s{from.time}, t{to.time};
        all.push_back((to.bound - from.bound) / (t - s) -
                      m.range.enclosure * ((s + t) / interval{2.0}));
    };
    if (outliers == 0) {
        for (std::size_t j = 1; j < chosen.size(); ++j)
            for (std::size_t i = 0; i < j; ++i) pair(i, j);
    } else { // a reading in one pair only: an outlier spoils one
        auto const half = chosen.size() / 2;
        for (std::size_t i = 0; i < half; ++i) pair(i, i + half);
    }
    return common_start(all, outliers);
}

} // namespace io_detail

/// The range of a state at t = 0 from readings of a channel.
///   value:  x(0) in y +/- e - [r] t             while x' is in [r]
///   rate:   x'(0) in (x(t) - x(s)) / (t - s) - [a] (s + t) / 2   while x'' is in [a]
/// for each reading or pair, and what all but `outliers` of them agree on.
/// @guarantee  contains the true start if the channel shows x itself, [r] or [a] holds from 0 to
/// the
///             last reading, and of all readings at most `outliers` lie outside their bounds
/// @given  m.from is value or rate; the readings' times increase from 0 or later (trusted)
[[nodiscard]] inline start_proposal propose_start(mapped_start const& m,
                                                  std::vector<start_reading> const& readings,
                                                  std::size_t outliers) {
    return m.from == mapped_start::kind::rate ? io_detail::rate_at_start(m, readings, outliers)
                                              : io_detail::value_at_start(m, readings, outliers);
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_START_PROPOSAL_HPP
