// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_MANOEUVRE_IPP
#define SIVID_DIAGNOSIS_IMPL_MANOEUVRE_IPP

#include <sivid/diagnosis/manoeuvre.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/detail/manoeuvre_settings.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/screening.hpp>

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
    /// @param period      of the measurements [s]
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
        for (double t = period_; t <= m.duration + 1e-9; t += period_) {
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
        auto const fit =
            fitter(problem, go_on_).at(c.fit.parameters, {mid(problem.experiments[0].initial)});
        return fit.residuals.empty() ? std::vector<double>{} : fit.residuals.front();
    }

    std::vector<screened const*> candidates_;
    std::vector<double> errors_;
    double period_;
    std::function<bool()> go_on_;
};

/// Compass search from the best of a few spread points: the settings are few and a run is cheap.
inline std::pair<std::vector<double>, double> best_settings(separation const& parts,
                                                            manoeuvre const& m) {
    auto const n = m.settings.size();
    std::vector<double> best;
    double value = -1;
    auto const consider = [&](std::vector<double> const& s) {
        double const v = parts(m, s);
        if (!(v > value)) return false;
        best = s;
        value = v;
        return true;
    };
    std::size_t const tries = n == 0 ? 1 : 12;
    for (std::size_t k = 0; k < tries; ++k) {
        std::vector<double> s;
        for (std::size_t i = 0; i < n; ++i) {
            double const share = std::fmod(
                0.5 + static_cast<double>(k) * std::sqrt(static_cast<double>(2 + 3 * i)), 1.0);
            s.push_back(m.settings[i].lower + share * (m.settings[i].upper - m.settings[i].lower));
        }
        (void)consider(s);
    }
    for (double step = 0.25; !best.empty() && n > 0 && step > 0.05; step /= 2) {
        for (std::size_t i = 0; i < n; ++i) {
            auto const& limits = m.settings[i];
            for (double const way : {-1.0, 1.0}) {
                auto s = best;
                s[i] = std::clamp(s[i] + way * step * (limits.upper - limits.lower), limits.lower,
                                  limits.upper);
                (void)consider(s);
            }
        }
    }
    return {best, value};
}

} // namespace diagnosis_detail

SIVID_DECL std::optional<next_experiment>
propose_experiment(std::vector<screened const*> candidates, std::vector<manoeuvre> const& menu,
                   std::vector<double> errors, double period, std::function<bool()> const& go_on) {
    if (candidates.size() < 2) return std::nullopt;
    diagnosis_detail::separation const parts(std::move(candidates), std::move(errors), period,
                                             go_on);
    std::optional<next_experiment> best;
    for (auto const& m : menu) {
        auto const [settings, value] = diagnosis_detail::best_settings(parts, m);
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
