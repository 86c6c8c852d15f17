// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_PLOT_DATA_HPP
#define SIVID_REPORT_DIAGNOSIS_PLOT_DATA_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/report/channel_series.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// One channel of one scenario. Any list may be shorter or empty: what is missing is not drawn.
struct channel_data {
    std::string name{};
    std::string unit{};
    std::vector<double> times{};  ///< of the measurements
    std::vector<double> values{}; ///< measured
    std::vector<double> bounds{}; ///< |true - measured| is at most this
    std::vector<double> base{};   ///< outputs of the model's best fit at `times`
    std::vector<double> after{};  ///< outputs of the fit with the effect at `times`
    std::vector<bool> outliers{}; ///< suspected
    std::vector<double> base_line{}, after_line{}; ///< at the scenario's `line_times`
    std::vector<tube_piece> tube{};                ///< predicted with the effect
};

struct scenario_data {
    std::string name{};
    bool holdout = false;
    std::vector<double> line_times{}; ///< finer than the samples; empty: lines join the samples
    std::vector<channel_data> channels{};
};

/// The missing rate of one equation in one scenario.
struct missing_rate_data {
    std::string equation{};
    std::string scenario{};
    std::string unit{};
    std::vector<double> times{};
    std::vector<double> values{};      ///< estimate
    std::vector<double> uncertainty{}; ///< half width of its band, estimate
    struct window {
        double from = 0, to = 0;
        interval missing{}; ///< proved bounds of the mean
    };
    std::vector<window> windows{};
};

/// What the page draws beside the diagnosis.
struct diagnosis_plot_data {
    std::vector<scenario_data> scenarios{};
    std::vector<missing_rate_data> missing_rates{};
    std::vector<missing_rate_data> remaining_rates{}; ///< with the closest candidate
};

namespace detail {

/// Marks the q largest misfits beyond their bounds; none without an outlier budget.
SIVID_ENTRY std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
                                       std::size_t q);

} // namespace detail

/// The measurements of every experiment with the outputs of two fits to them, at the samples. A fit
/// without residuals is not drawn. Suspected outliers are the largest misfits of the second fit (of
/// the first when there is no second), as many as the budget allows.
/// @pre  both fits are of problems with these measurements, with whatever effects
[[nodiscard]] SIVID_ENTRY std::vector<scenario_data>
compared_scenarios(identification_problem const& problem, approximate_fit const& base,
                   approximate_fit const& after = {}, bool holdout = false);

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_COMPARED_SCENARIOS)
namespace detail {

SIVID_ENTRY std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
                                       std::size_t q) {
    std::vector<std::size_t> beyond;
    for (std::size_t i = 0; i < std::min(n, residuals.size()); ++i) {
        if (std::fabs(residuals[i]) > 1) beyond.push_back(i);
    }
    std::stable_sort(beyond.begin(), beyond.end(), [&](std::size_t a, std::size_t b) {
        return std::fabs(residuals[a]) > std::fabs(residuals[b]);
    });
    beyond.resize(std::min(beyond.size(), q));
    std::vector<bool> out(n, false);
    for (std::size_t const i : beyond) out[i] = true;
    return out;
}

} // namespace detail

SIVID_ENTRY std::vector<scenario_data> compared_scenarios(identification_problem const& problem,
                                                          approximate_fit const& base,
                                                          approximate_fit const& after,
                                                          bool holdout) {
    auto const& about = problem.model.about;
    std::vector<double> const nothing;
    std::vector<scenario_data> out;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& experiment = problem.experiments[e];
        auto const samples = sorted(experiment.measurements);
        auto const& before = e < base.residuals.size() ? base.residuals[e] : nothing;
        auto const& then = e < after.residuals.size() ? after.residuals[e] : nothing;
        auto const suspect =
            detail::suspects(then.empty() ? before : then, samples.size(), experiment.outliers);
        scenario_data s{.name = experiment.name, .holdout = holdout};
        for (std::size_t c = 0; c < about.channels.size(); ++c) {
            channel_data d{.name = about.channels[c].name, .unit = about.channels[c].unit};
            for (std::size_t i = 0; i < samples.size(); ++i) {
                if (samples[i].channel != c) continue;
                double const y = mid(samples[i].bound), half = rad(samples[i].bound);
                d.times.push_back(samples[i].time);
                d.values.push_back(y);
                d.bounds.push_back(half);
                d.outliers.push_back(suspect[i]);
                if (i < before.size()) d.base.push_back(y + half * before[i]);
                if (i < then.size()) d.after.push_back(y + half * then[i]);
            }
            if (!d.times.empty()) s.channels.push_back(std::move(d));
        }
        out.push_back(std::move(s));
    }
    return out;
}
#endif

} // namespace sivid::report

#endif
