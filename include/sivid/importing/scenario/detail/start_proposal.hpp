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
    double time = 0; ///< increasing; before 0 for rates alone
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

/// Where x'(0) lies by the values of x at some nodes, one more than `degree`, that increase.
/// p is the polynomial through them, c_i the derivative at 0 of Lagrange's polynomial of node i:
///   x'(0) in sum c_i (x(t_i) - r t_i^(d+1))        r in [m]/(d+1)!, x^(d+1) in [m], by Taylor
///   x'(0) in p'(0) + r (prod (t - t_i))'(0)        where no two nodes lie on both sides of 0:
/// for x - p - r prod (t - t_i), r such that its derivative vanishes at 0, that derivative has
/// d + 1 zeros, so that its d-th one has one (Rolle). The kernel of this remainder has one sign
/// therefore, and a derivative that exists almost everywhere will do, as beside dry friction.
[[nodiscard]] inline interval rate_by_nodes(std::vector<start_reading const*> const& nodes,
                                            interval const& m) {
    std::size_t const n = nodes.size();
    auto const t = [&](std::size_t i) { return interval{nodes[i]->time}; };
    interval rate{0.0}, by_taylor{0.0}, slope{0.0};
    interval const r = n == 2 ? m / interval{2.0} : m / interval{6.0};
    for (std::size_t i = 0; i < n; ++i) {
        // prod_(j != i) (t - t_j) at t_i, and at 0 with its derivative
        interval there{1.0}, here{1.0}, rising{0.0}, power = t(i);
        for (std::size_t j = 0; j < n; ++j) {
            if (j == i) continue;
            there = there * (t(i) - t(j));
            rising = here - rising * t(j);
            here = here * -t(j);
            power = power * t(i);
        }
        auto const c = rising / there;
        rate = rate + c * nodes[i]->bound;
        by_taylor = by_taylor + c * power * r;
        slope = slope + here;
    }
    bool const one_side = nodes.front()->time >= 0 || nodes.back()->time <= 0;
    return one_side ? rate + r * slope : rate - by_taylor;
}

[[nodiscard]] inline start_proposal rate_at_start(mapped_start const& m,
                                                  std::vector<start_reading> const& readings,
                                                  std::size_t outliers) {
    if (readings.empty()) return {std::nullopt, false, "too few readings"};
    auto const nodes = m.degree + 1;
    // Nodes bound best at 2 sqrt(e/a), or 3.6 cbrt(e/a), from the start: those further off are
    // worse than wide.
    double const a = mag(m.range.enclosure), e = width(readings.front().bound) / 2;
    double const reach = m.within ? *nearest(*m.within)
                         : a > 0  ? 6 * (m.degree == 1 ? std::sqrt(e / a) : std::cbrt(e / a))
                                  : std::numeric_limits<double>::infinity();
    auto const least = 2 * nodes * (outliers + 1);
    std::vector<start_reading const*> near, chosen;
    for (auto const& r : readings)
        if (std::abs(r.time) <= reach || (!m.within && near.size() < least)) near.push_back(&r);
    std::size_t const most = std::max<std::size_t>(m.degree == 1 ? 64 : 40, least); // 10^4 triples
    auto const stride = 1 + (std::max<std::size_t>(near.size(), 1) - 1) / most;
    for (std::size_t i = 0; i < near.size(); i += stride) chosen.push_back(near[i]);
    std::vector<interval> all;
    auto const add = [&](std::vector<std::size_t> const& at) {
        std::vector<start_reading const*> some;
        for (auto const i : at) some.push_back(chosen[i]);
        all.push_back(rate_by_nodes(some, m.range.enclosure));
    };
    auto const count = chosen.size(), share = count / nodes;
    for (std::size_t i = 0; i < share && outliers > 0; ++i) // each once: an outlier spoils one
        add(m.degree == 1 ? std::vector{i, i + share} : std::vector{i, i + share, i + 2 * share});
    for (std::size_t j = 1; j < count && outliers == 0; ++j)
        for (std::size_t i = 0; i < j; ++i) {
            if (m.degree == 1) add({i, j});
            for (std::size_t k = j + 1; k < count && m.degree == 2; ++k) add({i, j, k});
        }
    return common_start(all, outliers);
}

} // namespace io_detail

/// The range of a state at t = 0 from readings of a channel.
///   value:  x(0) in y +/- e - [r] t                                while x' is in [r]
///   rate:   x'(0) from each two readings while x'' is in [a], or from each three while x''' is
///           in [a]: `rate_by_nodes`. Each polynomial that the readings allow is allowed by three
///           of them, so that no polynomial of all readings says more
/// and what all but `outliers` of these agree on.
/// @guarantee  contains the true start if the channel shows x itself, [r] or [a] holds from the
///             first to the last reading, and of all readings at most `outliers` lie outside
///             their bounds
/// @given  m.from is value or rate; the readings' times increase (trusted)
[[nodiscard]] inline start_proposal propose_start(mapped_start const& m,
                                                  std::vector<start_reading> const& readings,
                                                  std::size_t outliers) {
    return m.from == mapped_start::kind::rate ? io_detail::rate_at_start(m, readings, outliers)
                                              : io_detail::value_at_start(m, readings, outliers);
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_START_PROPOSAL_HPP
