// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_FORCED_OUTLIER_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_FORCED_OUTLIER_CHECK_HPP

#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>
#include <sivid/verifier/proof/detail/certificate.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// Readings of one instant and channel. A result says how many of them are forced outliers, not
/// which.
struct forced_readings {
    std::size_t all = 0, forced = 0;
    std::vector<std::size_t> missed; ///< those that the witness does not certainly meet
};

/// @param hits  what the witness certainly meets; may be empty
inline forced_readings readings_of(stored_identification const& stored,
                                   stored_identification::outlier const& f, record const& samples,
                                   model_description const& about, std::vector<bool> const& hits) {
    forced_readings result;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (samples[k].time != f.time || about.channels[samples[k].channel].name != f.channel)
            continue;
        ++result.all;
        if (k >= hits.size() || !hits[k]) result.missed.push_back(k);
    }
    for (auto const& g : stored.forced) {
        bool const same = g.scenario == f.scenario && g.time == f.time && g.channel == f.channel;
        result.forced += same ? 1 : 0;
    }
    return result;
}

template <class I>
bool all_violated(plain_outputs<I> const& known, record const& samples,
                  std::vector<std::size_t> const& which) {
    using traits = interval_traits<I>;
    return std::all_of(which.begin(), which.end(), [&](std::size_t k) {
        if (k >= known.outputs.size() || !known.outputs[k].defined) return false;
        auto const& b = samples[k].bound;
        return traits::disjoint(known.outputs[k].value, traits::bounds(b.lower(), b.upper()));
    });
}

/// Whether every parameter of every row violates these measurements of an experiment: proved over
/// parts of the rows' hull, as long as `keep_going` says.
template <class I, class KeepGoing>
bool violated_everywhere(identification_problem const& problem, stored_identification const& stored,
                         experiment const& own, plain_run<I>& run,
                         std::vector<std::size_t> const& which, KeepGoing const& keep_going) {
    if (which.empty() || stored.rows.empty()) return true;
    std::vector<box> waiting{intersect(hull_of(stored.rows), problem.prior)};
    while (!waiting.empty()) {
        auto const region = std::move(waiting.back());
        waiting.pop_back();
        bool const needed =
            std::any_of(stored.rows.begin(), stored.rows.end(),
                        [&](auto const& row) { return !is_empty(intersect(row.set, region)); });
        if (!needed || all_violated(run(own.initial, region), run.samples(), which)) continue;
        auto const side = widest_side(region, problem.prior, 1e-12);
        if (!side || !keep_going()) return false;
        auto [low, high] = bisect(region, *side, mid(region[*side]));
        waiting.push_back(std::move(low));
        waiting.push_back(std::move(high));
    }
    return true;
}

} // namespace io_detail

/// Every parameter of every row violates the measurements that are said to be forced outliers.
///   Of several readings of one channel at one instant so many must be violated, each by all
///   parameters, as are stated there.
/// @param hits  by experiment and sample: what a verified witness certainly meets; may be empty
/// @cost  runs over parts of the rows' hull until each shows the violations, or the time is up
template <class I>
[[nodiscard]] check_finding check_forced(identification_problem const& problem,
                                         stored_identification const& stored,
                                         std::vector<std::vector<bool>> const& hits,
                                         enclosure_options const& how, double seconds) {
    using outcome = check_finding::outcome;
    std::string const what = "proved outliers";
    work_limit const in_time(seconds);
    bool any = false;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& own = problem.experiments[e];
        plain_run<I> run(problem.model, problem.choice, own, how);
        std::vector<std::size_t> which;                  // shown together
        std::vector<io_detail::forced_readings> unclear; // one by one
        for (auto const& f : stored.forced) {
            if (f.scenario != own.name) continue;
            any = true;
            auto const r = io_detail::readings_of(stored, f, run.samples(), problem.model.about,
                                                  e < hits.size() ? hits[e] : std::vector<bool>{});
            if (r.all < r.forced) {
                return {what, outcome::refuted, "no such measurement in " + own.name};
            }
            if (r.missed.size() < r.forced) {
                return {what, outcome::refuted, "the witness meets one in " + own.name};
            }
            if (r.missed.size() > r.forced) {
                unclear.push_back(r);
            } else {
                which.insert(which.end(), r.missed.begin(), r.missed.end());
            }
        }
        auto const violated = [&](std::vector<std::size_t> const& these) {
            return io_detail::violated_everywhere(problem, stored, own, run, these, in_time);
        };
        bool proved = violated(which);
        for (std::size_t k = 0; k < unclear.size() && proved; ++k) {
            std::size_t found = 0;
            for (auto const place : unclear[k].missed) found += violated({place}) ? 1 : 0;
            proved = found >= unclear[k].forced;
        }
        if (!proved) return {what, outcome::undecided, "no proof within the budget"};
    }
    bool const strangers =
        std::any_of(stored.forced.begin(), stored.forced.end(), [&](auto const& f) {
            return std::none_of(problem.experiments.begin(), problem.experiments.end(),
                                [&](auto const& e) { return e.name == f.scenario; });
        });
    if (strangers) return {what, outcome::refuted, "one in no scenario of the data set"};
    if (!any) return {what, outcome::nothing, ""};
    return {what, outcome::verified, "every box violates those stated"};
}

} // namespace sivid

#endif // SIVID_VERIFIER_CLAIM_DETAIL_FORCED_OUTLIER_CHECK_HPP
