// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_JUDGEMENT_HPP
#define SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_JUDGEMENT_HPP

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/candidate/resolve_memory.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/hold_out/detail/holdout_results.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/paving/inflation/detail/holdout_inflation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// Share of samples whose bound meets the predicted outputs, and the mean width of these over that
/// of the bounds; neither where some are not predicted.
inline void measure_tube(identification_problem const& judged,
                         std::vector<std::vector<interval>> const& outputs,
                         holdout_judgement& result) {
    if (outputs.size() != judged.experiments.size()) return;
    std::size_t samples = 0, met = 0;
    double width_sum = 0;
    for (std::size_t s = 0; s < outputs.size(); ++s) {
        auto const data = sorted(judged.experiments[s].measurements);
        if (outputs[s].size() != data.size()) return;
        for (std::size_t y = 0; y < data.size(); ++y) {
            if (!is_bounded(outputs[s][y])) return;
            ++samples;
            met += disjoint(outputs[s][y], data[y].bound) ? 0 : 1;
            width_sum += width(outputs[s][y]) / width(data[y].bound);
        }
    }
    if (samples == 0) return;
    result.covered = static_cast<double>(met) / static_cast<double>(samples);
    result.width = width_sum / static_cast<double>(samples);
}

/// The root mean square error of each channel, in its unit.
/// @param residuals  by experiment and sample, as shares of the bounds' radii
inline std::vector<double> rmse_of(identification_problem const& judged,
                                   std::vector<std::vector<double>> const& residuals) {
    auto const& channels = judged.model.about.channels;
    std::vector<double> squares(channels.size(), 0.0);
    std::vector<double> count(channels.size(), 0.0);
    for (std::size_t s = 0; s < residuals.size(); ++s) {
        auto const data = sorted(judged.experiments[s].measurements);
        for (std::size_t k = 0; k < data.size(); ++k) {
            double const off = residuals[s][k] * rad(data[k].bound);
            squares[data[k].channel] += off * off;
            count[data[k].channel] += 1;
        }
    }
    std::vector<double> rmse;
    for (std::size_t y = 0; y < channels.size(); ++y)
        rmse.push_back(std::sqrt(squares[y] / count[y]));
    return rmse;
}

} // namespace diagnosis_detail

/// Judges a fitted candidate by hold-out experiments. Their own starts, nuisances, are fitted;
/// nothing else is.
/// @param bound   what was proved about the candidate's fit
/// @param explaining  contains every parameter that explains the fit data; empty: not known
/// @param over    over that box, where the candidate has one
/// @param judged  `holdout::judged_by` of the candidate
/// @param search  what the bounds may spend
/// @guarantee  `at_witness` and `over_fits` enclose what they say
[[nodiscard]] inline holdout_judgement
judge_by_holdout(screened const& fitted, verified_inflation const& bound,
                 explained_hull const& explaining, identification_problem const& judged,
                 std::optional<fitted_set> const& over, inflation_options const& search) {
    holdout_judgement result;
    auto const& p = bound.witness ? bound.witness->parameters : fitted.fit.parameters;
    if (p.size() != judged.prior.size()) return result;
    auto there = judged;
    for (std::size_t j = 0; j < p.size(); ++j) there.prior[j] = interval(p[j]);
    start_added_states(there);
    result.run = approximate_fitter(there, search.test.keep_going)({p});
    result.at_witness = verify_at(there, result.run, search.test).range;
    if (has_uncertain_starts(there)) { // another start may do better
        result.at_witness = interval_traits<interval>::bounds(0, result.at_witness.upper());
    }
    bool const delayed = judged.model.has_memory();
    bool const explains = bound.range.upper() <= 1;
    bool const sliced = over && explains;
    if (bound.witness && (!delayed || sliced)) {
        // All parameters that explain the data; where none does, those as good as the witness.
        inflation_bound fit{
            bound.range, bound.witness, explains ? explaining.parameters : bound.hull, 0, 0, 0};
        if (explains) {
            fit.value = interval_traits<interval>::bounds(bound.range.lower(), 1);
            fit.products = explaining.products;
        }
        if (sliced) { // the witness is no point of it
            fit.witness.reset();
            fit.hull = over->fit.prior;
            fit.products = over->products;
        }
        auto const& starts = result.run.starts;
        auto proved = sliced ? holdout_inflation(over->fit, fit, over->judged, search, starts)
                             : holdout_inflation(fitted.problem, fit, judged, search, starts);
        if (starts_follow_parameters(judged)) {
            // The search lets added states start anywhere in their ranges: only what it says from
            // below holds.
            for (auto* range : {&proved.over_fits, &proved.at_witness}) {
                *range = interval_traits<interval>::bounds(range->lower(), detail::infinity);
            }
        } else {
            diagnosis_detail::measure_tube(sliced ? over->judged : judged, proved.outputs, result);
        }
        result.over_fits = proved.over_fits;
        auto both = intersect(result.at_witness, proved.at_witness);
        // The witness is one of them; where inputs are sliced, under assumptions of its own.
        if (!sliced) both = intersect(both, proved.over_fits);
        if (!is_empty(both)) result.at_witness = both;
    }
    result.rmse = diagnosis_detail::rmse_of(there, result.run.residuals);
    return result;
}

} // namespace sivid

#endif
