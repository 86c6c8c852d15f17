// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_FORCED_OUTLIER_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_FORCED_OUTLIER_CHECK_HPP

#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/claim/detail/identification_consistency.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

inline std::optional<std::size_t> index_of_sample(record const& samples,
                                                  stored_identification::outlier const& f,
                                                  model_description const& about) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (samples[k].time == f.time && about.channels[samples[k].channel].name == f.channel) {
            return k;
        }
    }
    return std::nullopt;
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

/// The side that is widest against the prior's, if it can be cut.
inline std::optional<std::size_t> widest_side(box const& x, box const& prior) {
    std::optional<std::size_t> best;
    double most = 1e-12;
    for (std::size_t j = 0; j < x.size(); ++j) {
        double const whole = width(prior[j]);
        if (is_one_number(prior[j]) || !(width(x[j]) / whole > most)) continue;
        most = width(x[j]) / whole;
        best = j;
    }
    return best;
}

} // namespace io_detail

/// Every parameter of every row violates the measurements that are said to be forced outliers.
/// @param hits  by experiment and sample: what a verified witness certainly meets; may be empty
/// @cost  runs over parts of the rows' hull until each shows the violations, or the time is up
template <class I>
[[nodiscard]] check_finding check_forced(identification_problem const& problem,
                                         stored_identification const& stored,
                                         std::vector<std::vector<bool>> const& hits,
                                         enclosure_options const& how, double seconds) {
    using outcome = check_finding::outcome;
    std::string const what = "proved outliers";
    auto const begin = std::chrono::steady_clock::now();
    bool any = false;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& own = problem.experiments[e];
        plain_run<I> run(problem.model, problem.choice, own, how);
        std::vector<std::size_t> which;
        for (auto const& f : stored.forced) {
            if (f.scenario != own.name) continue;
            auto const k = io_detail::index_of_sample(run.samples(), f, problem.model.about);
            if (!k) return {what, outcome::refuted, "no such measurement in " + own.name};
            if (e < hits.size() && *k < hits[e].size() && hits[e][*k]) {
                return {what, outcome::refuted, "the witness meets one in " + own.name};
            }
            which.push_back(*k);
        }
        if (which.empty()) continue;
        any = true;
        std::vector<box> waiting;
        if (!stored.rows.empty()) {
            auto all = stored.rows[0].set;
            for (auto const& row : stored.rows) all = hull(all, row.set);
            waiting.push_back(intersect(all, problem.prior));
        }
        while (!waiting.empty()) {
            auto const region = std::move(waiting.back());
            waiting.pop_back();
            bool const needed =
                std::any_of(stored.rows.begin(), stored.rows.end(),
                            [&](auto const& row) { return !is_empty(intersect(row.set, region)); });
            if (!needed ||
                io_detail::all_violated(run(own.initial, region), run.samples(), which)) {
                continue;
            }
            auto const side = io_detail::widest_side(region, problem.prior);
            std::chrono::duration<double> const spent = std::chrono::steady_clock::now() - begin;
            if (!side || spent.count() > seconds) {
                return {what, outcome::undecided, "no proof within the budget"};
            }
            auto [low, high] = bisect(region, *side, mid(region[*side]));
            waiting.push_back(std::move(low));
            waiting.push_back(std::move(high));
        }
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
