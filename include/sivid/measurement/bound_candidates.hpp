// SPDX-License-Identifier: MIT
#ifndef SIVID_MEASUREMENT_BOUND_CANDIDATES_HPP
#define SIVID_MEASUREMENT_BOUND_CANDIDATES_HPP

#include <sivid/measurement/error_bound.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What one experiment recorded of one quantity.
struct recorded_series {
    std::string name;
    std::vector<double> times, values;
    std::vector<double> command; ///< whatever was done to the machine; repeated ones are equal
};

/// An error bound that records suggest, and what it rests on.
struct bound_candidate {
    std::string from;
    double bound = 0;  ///< 0: none
    double beyond = 0; ///< at most this share of further readings is worse; 0: nothing is said
    std::vector<std::string> rests_on{}; ///< or why there is none
};

namespace detail {

/// By the stretch of the least range: 20 readings, of long records a twentieth.
inline void suggest_at_rest(recorded_series const& r, bound_candidate& c) {
    auto const count = std::max<std::size_t>(20, r.values.size() / 20);
    std::multiset<double> within;
    for (std::size_t i = 0; i < r.values.size(); ++i) {
        within.insert(r.values[i]);
        if (within.size() > count) within.erase(within.find(r.values[i - count]));
        double const half = (*within.rbegin() - *within.begin()) / 2;
        if (within.size() < count || !(half > 0) || (c.bound > 0 && half >= c.bound)) continue;
        c.bound = half;
        c.rests_on = {"nothing moves in " + r.name + " from " +
                      sivid::nearest_text(r.times[i + 1 - count], 4) + " to " +
                      sivid::nearest_text(r.times[i], 4) + ", the quietest " +
                      std::to_string(count) + " readings: chosen so, these are rather too quiet"};
    }
}

/// By records of the same command at the same times.
inline void suggest_by_repetition(recorded_series const& r,
                                  std::vector<recorded_series> const& records, bound_candidate& c) {
    auto low = r.values, high = r.values;
    std::size_t alike = 0;
    for (auto const& o : records) {
        if (o.times != r.times || o.command != r.command) continue;
        ++alike;
        for (std::size_t k = 0; k < low.size(); ++k) {
            low[k] = std::min(low[k], o.values[k]);
            high[k] = std::max(high[k], o.values[k]);
        }
    }
    for (std::size_t k = 0; k < low.size(); ++k) {
        if (!((high[k] - low[k]) / 2 > c.bound)) continue;
        c.bound = (high[k] - low[k]) / 2;
        c.rests_on = {std::to_string(alike) + " experiments like " + r.name +
                      " differ in errors alone"};
    }
}

} // namespace detail

/// Candidates for the error bound of one instrument, from its step, from where it rests, from
/// repeated experiments and from neighbours (`propose_error_bound`). None is a proof; the first
/// three are the least that a bound can be, if what they rest on is so.
/// @throws std::invalid_argument  as `propose_error_bound`
/// @cost  n log n, and the square of the number of records
[[nodiscard]] inline std::vector<bound_candidate>
error_bound_candidates(std::vector<recorded_series> const& records) {
    bound_candidate step{"step"}, rest{"rest"}, runs{"repeated"}, near{"neighbours"};
    std::vector<std::string> refusals;
    for (auto const& r : records) {
        auto const p = propose_error_bound(r.times, r.values);
        // A command of few levels has a step that is none of the instrument's.
        if (p.quantum > 2 * step.bound && distinct_count(r.values, 10) == 10) {
            step.bound = p.quantum / 2;
            step.rests_on = {"readings are rounded to steps of " + nearest_text(p.quantum, 3) +
                             " (twice that where they are cut off), and nothing else is wrong"};
        }
        detail::suggest_at_rest(r, rest);
        detail::suggest_by_repetition(r, records, runs);
        if (!p.refusal.empty()) {
            refusals.push_back(r.name + ": " + p.refusal);
        } else if (p.bound > near.bound) {
            near = {near.from, p.bound, 1 / static_cast<double>(p.support + 1), p.assumptions};
            near.rests_on.push_back("the share of worse readings: as the " +
                                    std::to_string(p.support) + " residuals of " + r.name +
                                    ", which are alike");
        }
    }
    if (!(near.bound > 0)) near.rests_on = std::move(refusals);
    std::vector<bound_candidate> all;
    for (auto* c : {&step, &rest, &runs, &near})
        if (c->bound > 0 || !c->rests_on.empty()) all.push_back(std::move(*c));
    return all;
}

} // namespace sivid

#endif
