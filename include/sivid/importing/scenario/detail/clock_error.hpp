// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_CLOCK_ERROR_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_CLOCK_ERROR_HPP

#include <sivid/importing/scenario/detail/quantity_import.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What errors of the clock add to the bounds of readings: a reading that was taken within c of its
/// time t is off by at most c S, with S the largest slope from t - c to t + c. S is stated, or
/// bounded by readings i <= k <= j and the largest second derivative a: somewhere between the true
/// times of i and j the slope is at most (|y_j - y_i| + e_i + e_j) / (t_j - t_i - 2 c), and from
/// there to the reading it changes by at most a (max(t_j - t_k, t_k - t_i) + 2 c).
/// @guarantee  bounds hold for the stated times, if each reading was taken within c of its own, no
///             reading of i and j is beyond its bound, and the slope (or a) is as stated
/// @given  times increase (trusted)
/// @returns "", or why there is no bound
[[nodiscard]] inline std::string add_clock_errors(imported_quantity& q) {
    auto const& m = *q.mapping;
    auto const off = m.clock + q.clock;
    if (off.is_zero()) return {};
    if (m.slope.is_zero())
        return text_of("the times of its file are known within ", q.clock.text(),
                       " s: how fast what it shows changes, \"rate\" or \"acceleration\", is not "
                       "stated");
    auto& all = q.samples;
    interval const c = *enclose(off), stated = *enclose(m.slope);
    std::vector<interval> times, ends;
    for (std::size_t k = 0; m.curved && k < all.size(); ++k) {
        auto const& s = all[k];
        auto const e = q.stated(s) + s.reading.rounding;
        times.push_back(*enclose(s.time));
        auto const bound = enclose(s.reading.value - e, s.reading.value + e);
        if (!bound) return "readings are beyond the range of double";
        ends.push_back(*bound);
    }
    constexpr std::size_t farthest = 32; // what further readings say is swamped by a
    for (std::size_t k = 0; k < all.size(); ++k) {
        double slope = m.curved ? std::numeric_limits<double>::infinity() : stated.upper();
        for (std::size_t n = 1; m.curved && n <= farthest; ++n) {
            auto const i = k - std::min(k, n), j = std::min(k + n, all.size() - 1);
            auto const apart = times[j] - times[i] - interval{2.0} * c;
            if (!(apart.lower() > 0)) continue;
            auto const way = std::max((times[j] - times[k]).upper(), (times[k] - times[i]).upper());
            auto const here = interval{mag(ends[j] - ends[i])} / apart +
                              stated * (interval{way} + interval{2.0} * c);
            slope = std::min(slope, here.upper());
        }
        if (!std::isfinite(slope))
            return text_of("its times are off by ", off.text(),
                           " s at most, and two readings are needed that are further apart");
        all[k].late = rounded_up(exact_decimal::of((c * interval{slope}).upper()), 3);
    }
    return {};
}

/// The same for an input whose times may be off by c: at each time it is within its error of its
/// own course at most c earlier or later, which differs from that course by at most c times the
/// steepest slope around, or by what a held one has stepped.
/// @returns "", or why there is no bound
[[nodiscard]] inline std::string add_clock_errors_of_input(imported_quantity& q,
                                                           interpolation between) {
    if (q.clock.is_zero()) return {};
    auto& all = q.samples;
    if (q.mapping->error.from == bound_source::kind::none)
        return text_of("the times of its file are known within ", q.clock.text(),
                       " s, so it is not exact: it has no \"error\"");
    interval const c = *enclose(q.clock);
    std::vector<interval> times, values;
    for (auto const& s : all) {
        times.push_back(*enclose(s.time));
        auto const value = enclose(s.reading.value);
        if (!value) return "readings are beyond the range of double";
        values.push_back(*value);
    }
    bool const held = between == interpolation::hold;
    std::vector<double> late(all.size(), 0);
    std::size_t first = 0; // of the pieces that reach into [begin, end]
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        double const begin = (times[i] - c).lower(), end = (times[i + 1] + c).upper();
        while (times[first + 1].upper() < begin) ++first;
        double most = 0;
        for (auto k = first; k + 1 < all.size() && times[k].lower() <= end; ++k) {
            if (held)
                most = std::max({most, mag(values[k] - values[i]), mag(values[k + 1] - values[i])});
            else
                most = std::max(most, mag((values[k + 1] - values[k]) / (times[k + 1] - times[k])));
        }
        double const more = held ? most : (c * interval{most}).upper();
        late[i] = std::max(late[i], more);
        late[i + 1] = more;
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!std::isfinite(late[k])) return "readings are beyond the range of double";
        if (late[k] > 0) all[k].late = rounded_up(exact_decimal::of(late[k]), 3);
    }
    return {};
}

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_CLOCK_ERROR_HPP
