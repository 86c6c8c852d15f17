// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_MANOEUVRE_IPP
#define SIVID_DIAGNOSIS_IMPL_MANOEUVRE_IPP

#include <sivid/diagnosis/manoeuvre.hpp>

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/best_settings.hpp>
#include <sivid/model/manoeuvre.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// How far candidates part on a manoeuvre: the largest difference of a channel in units of its
/// error bound, least over all pairs. Negative where a simulation fails.
class separation {
public:
    /// @param candidates  at their best fits
    /// @param errors      bound of each channel; 0: not measured
    /// @param period      of the measurements [time]
    separation(std::vector<screened const*> candidates, std::vector<double> errors, double period,
               std::function<bool()> go_on)
        : candidates_(std::move(candidates)),
          errors_(std::move(errors)),
          period_(period),
          go_on_(std::move(go_on)) {}

    [[nodiscard]] double operator()(manoeuvre const& m, std::vector<double> const& settings) const {
        if (go_on_ && !go_on_()) return -1;
        std::vector<std::vector<double>> outputs;
        for (auto const* c : candidates_) {
            auto run = outputs_of(*c, m, settings);
            if (run.empty()) return -1;
            outputs.push_back(std::move(run));
        }
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < outputs.size(); ++a) {
            for (std::size_t b = a + 1; b < outputs.size(); ++b) {
                double most = 0;
                for (std::size_t i = 0; i < outputs[a].size(); ++i) {
                    most = std::max(most, std::abs(outputs[a][i] - outputs[b][i]));
                }
                least = std::min(least, most);
            }
        }
        return std::isfinite(least) ? least : -1;
    }

private:
    /// Outputs over the error bounds: the residuals against measurements of zero.
    [[nodiscard]] std::vector<double> outputs_of(screened const& c, manoeuvre const& m,
                                                 std::vector<double> const& settings) const {
        auto problem = c.problem;
        experiment e;
        e.name = m.name;
        e.inputs = m.inputs(settings);
        e.initial = point_box(m.start);
        for (double t = period_; t <= m.duration + 1e-9 * period_; t += period_) {
            for (std::size_t y = 0; y < errors_.size(); ++y) {
                if (!(errors_[y] > 0)) continue;
                auto const bound = interval_traits<interval>::bounds(-errors_[y], errors_[y]);
                e.measurements.push_back({std::min(t, m.duration), y, bound});
            }
        }
        problem.experiments = {std::move(e)};
        for (std::size_t j = 0; j < problem.prior.size(); ++j) {
            problem.prior[j] = interval(c.fit.parameters[j]);
        }
        start_added_states(problem);
        auto const fit = approximate_fitter(problem, go_on_)
                             .at(c.fit.parameters, {mid(problem.experiments[0].initial)});
        return fit.residuals.empty() ? std::vector<double>{} : fit.residuals.front();
    }

    std::vector<screened const*> candidates_;
    std::vector<double> errors_;
    double period_;
    std::function<bool()> go_on_;
};

} // namespace diagnosis_detail

SIVID_DECL std::optional<next_experiment>
propose_experiment(std::vector<screened const*> candidates, std::vector<manoeuvre> const& menu,
                   identification_problem const& measured, std::function<bool()> const& go_on) {
    if (candidates.size() < 2) return std::nullopt;
    std::vector<double> errors(measured.model.about.channels.size(), 0.0);
    double period = 0;
    for (auto const& e : measured.experiments) {
        for (auto const& m : e.measurements) errors[m.channel] = rad(m.bound);
        if (!e.measurements.empty()) period = e.measurements.front().time - e.begin;
    }
    diagnosis_detail::separation const parts(std::move(candidates), std::move(errors),
                                             period > 0 ? period : 0.1, go_on);
    std::optional<next_experiment> best;
    for (auto const& m : menu) {
        auto const [settings, value] =
            best_settings(m.settings, [&](std::vector<double> const& s) { return parts(m, s); });
        if (!(value > 0) || (best && value <= best->separation)) continue;
        best = next_experiment{m.name, {}, value, m.settings.empty()};
        for (std::size_t i = 0; i < m.settings.size(); ++i) {
            best->settings.push_back(
                {m.settings[i].name, m.settings[i].unit, settings[i], std::nullopt});
        }
    }
    return best;
}

} // namespace sivid

#endif
