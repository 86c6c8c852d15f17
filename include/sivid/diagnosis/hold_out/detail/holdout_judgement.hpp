// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_JUDGEMENT_HPP
#define SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_JUDGEMENT_HPP

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/hold_out/detail/holdout_results.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/paving/inflation/detail/holdout_inflation.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/data_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// Share of samples whose bound meets the outputs of the box of parameters, and the mean width of
/// these outputs over that of the bounds.
inline void add_tube(identification_problem const& judged, box const& parameters,
                     data_test_options const& test, holdout_judgement& result) {
    auto const everything = box_explorer::without_limit(judged);
    data_test runs(everything, test);
    std::size_t samples = 0;
    std::size_t met = 0;
    double width_sum = 0;
    for (std::size_t s = 0; s < judged.experiments.size(); ++s) {
        auto const answer = runs.run(s, judged.experiments[s].initial, parameters);
        if (answer->outputs() < answer->measurements) return;
        auto const values = output_ranges(*answer, parameters);
        for (std::size_t y = 0; y < values.size(); ++y) {
            if (!is_bounded(values[y])) return;
            ++samples;
            met += disjoint(values[y], answer->bounds[y]) ? 0 : 1;
            width_sum += width(values[y]) / width(answer->bounds[y]);
        }
    }
    if (samples == 0) return;
    result.covered = static_cast<double>(met) / static_cast<double>(samples);
    result.width = width_sum / static_cast<double>(samples);
}

} // namespace diagnosis_detail

/// Judges a fitted candidate by hold-out experiments. Their own starts, nuisances, are fitted;
/// nothing else is.
/// @param bound   what was proved about the candidate's fit
/// @param judged  `holdout::judged_by` of the candidate
/// @param search  what the bounds may spend
/// @guarantee  `at_witness` and `over_fits` enclose what they say
[[nodiscard]] inline holdout_judgement judge_by_holdout(screened const& fitted,
                                                        verified_inflation const& bound,
                                                        identification_problem const& judged,
                                                        inflation_options const& search) {
    holdout_judgement result;
    auto const& p = bound.witness ? bound.witness->parameters : fitted.fit.parameters;
    if (p.size() != judged.prior.size()) return result;
    auto there = judged;
    for (std::size_t j = 0; j < p.size(); ++j) there.prior[j] = interval(p[j]);
    start_added_states(there);
    result.run = fitter(there, search.test.run.enclosure.keep_going)({p});
    bool const known_starts =
        std::all_of(there.experiments.begin(), there.experiments.end(), [](experiment const& e) {
            return std::all_of(e.initial.begin(), e.initial.end(),
                               [](interval const& x) { return width(x) < 1e-9; });
        });
    result.at_witness = verify_at(there, result.run, search.test).range;
    if (!known_starts) { // another start may do better
        result.at_witness = interval_traits<interval>::bounds(0, result.at_witness.upper());
    }
    bool const delayed = judged.model.has_memory();
    if (!delayed && bound.witness) {
        inflation_bound fit{bound.range, bound.witness, bound.hull, 0, 0, 0};
        auto proved = holdout_inflation(fitted.problem, fit, judged, search);
        if (starts_follow_parameters(judged)) {
            // The search lets added states start anywhere in their ranges: only what it says from
            // below holds.
            for (auto* range : {&proved.over_fits, &proved.at_witness}) {
                *range = interval_traits<interval>::bounds(range->lower(), detail::infinity);
            }
        }
        result.over_fits = proved.over_fits;
        auto const both = intersect(result.at_witness, proved.at_witness);
        if (!is_empty(both)) result.at_witness = both;
    }

    auto const& channels = judged.model.about.channels;
    std::vector<double> squares(channels.size(), 0.0);
    std::vector<double> count(channels.size(), 0.0);
    for (std::size_t s = 0; s < result.run.residuals.size(); ++s) {
        auto const data = sorted(there.experiments[s].measurements);
        for (std::size_t k = 0; k < data.size(); ++k) {
            double const off = result.run.residuals[s][k] * rad(data[k].bound);
            squares[data[k].channel] += off * off;
            count[data[k].channel] += 1;
        }
    }
    for (std::size_t y = 0; y < channels.size(); ++y) {
        result.rmse.push_back(std::sqrt(squares[y] / count[y]));
    }
    if (!delayed && bound.hull.size() == p.size()) {
        diagnosis_detail::add_tube(judged, bound.hull, search.test, result);
    }
    return result;
}

} // namespace sivid

#endif
