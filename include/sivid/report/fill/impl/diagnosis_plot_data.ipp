// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_FILL_IMPL_DIAGNOSIS_PLOT_DATA_IPP
#define SIVID_REPORT_FILL_IMPL_DIAGNOSIS_PLOT_DATA_IPP

#include <sivid/report/fill/detail/diagnosis_plot_data.hpp>

namespace sivid::report {

namespace detail {

SIVID_DECL std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
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

SIVID_DECL std::vector<compared_scenario> compared_scenarios(identification_problem const& problem,
                                                             approximate_fit const& base,
                                                             approximate_fit const& after,
                                                             bool holdout) {
    auto const& about = problem.model.about;
    std::vector<double> const nothing;
    std::vector<compared_scenario> out;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& experiment = problem.experiments[e];
        auto const samples = sorted(experiment.measurements);
        auto const& before = e < base.residuals.size() ? base.residuals[e] : nothing;
        auto const& then = e < after.residuals.size() ? after.residuals[e] : nothing;
        auto const suspect =
            detail::suspects(then.empty() ? before : then, samples.size(), experiment.outliers);
        compared_scenario s{.name = experiment.name, .holdout = holdout};
        for (std::size_t c = 0; c < about.channels.size(); ++c) {
            comparison_series d{.name = about.channels[c].name,
                                .unit = about.channels[c].unit,
                                .time_unit = about.time_unit};
            for (std::size_t i = 0; i < samples.size(); ++i) {
                if (samples[i].channel != c) continue;
                double const t = samples[i].time;
                d.measured.push_back(
                    {.time = t,
                     .value = samples[i].bound,
                     .state = suspect[i] ? sample_state::suspect : sample_state::regular});
                auto const add = [&](std::vector<double> const& residuals, std::vector<point>& line,
                                     std::vector<point>& misfits) {
                    if (i >= residuals.size()) return;
                    line.push_back(
                        {t, mid(samples[i].bound) + rad(samples[i].bound) * residuals[i]});
                    if (!suspect[i]) misfits.push_back({t, std::fabs(residuals[i])});
                };
                add(before, d.before, d.misfit_before);
                add(then, d.after, d.misfit_after);
            }
            if (!d.measured.empty()) s.channels.push_back(std::move(d));
        }
        out.push_back(std::move(s));
    }
    return out;
}

} // namespace sivid::report

#endif
