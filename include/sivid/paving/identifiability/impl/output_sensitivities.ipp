// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_IMPL_OUTPUT_SENSITIVITIES_IPP
#define SIVID_PAVING_IDENTIFIABILITY_IMPL_OUTPUT_SENSITIVITIES_IPP

#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>

#include <sivid/enclosure/sensitivity/sensitive_flow.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

SIVID_DECL std::vector<unknown_quantity> unknowns_of(identification_problem const& problem,
                                                     bool starts) {
    std::vector<unknown_quantity> result;
    for (std::size_t j = 0; j < problem.prior.size(); ++j) {
        if (is_known(problem.prior[j])) continue;
        result.push_back({problem.choice.unknown[j], j, std::nullopt, problem.prior[j]});
    }
    for (std::size_t e = 0; starts && e < problem.experiments.size(); ++e) {
        auto const& from = problem.experiments[e];
        for (std::size_t i = 0; i < from.initial.size(); ++i) {
            if (is_known(from.initial[i])) continue;
            auto const& state = problem.model.about.states[i].name;
            result.push_back({state + "(" + from.name + ")", i, e, from.initial[i]});
        }
    }
    return result;
}

namespace paving_detail {

SIVID_DECL std::vector<double> weights_of(record const& samples) {
    double smallest = HUGE_VAL;
    for (auto const& m : samples) {
        if (rad(m.bound) > 0) smallest = std::fmin(smallest, rad(m.bound));
    }
    std::vector<double> result;
    for (auto const& m : samples) {
        double const error = rad(m.bound) > 0 ? rad(m.bound) : smallest;
        result.push_back(std::isfinite(error) ? 1 / error : 1.0);
    }
    return result;
}

} // namespace paving_detail
SIVID_DECL output_sensitivities sensitivity_runs::operator()(box const& parameters,
                                                             std::vector<box> const& starts) const {
    output_sensitivities result;
    std::vector<std::vector<interval>> rows;
    for (std::size_t e = 0; e < flows_.size(); ++e) {
        auto const& samples = samples_[e];
        if (samples.empty()) continue;
        auto const& from = problem_->experiments[e];
        std::vector<double> times;
        for (auto const& m : samples) {
            if (times.empty() || m.time != times.back()) times.push_back(m.time);
        }
        auto const found =
            sensitivities_at(*flows_[e], options_, starts[e], parameters, from.begin, times);
        auto const weights = paving_detail::weights_of(samples);
        std::size_t at = 0;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            while (at < found.size() && found[at].time < samples[k].time) ++at;
            if (at == found.size()) {
                result.missing += samples.size() - k;
                break;
            }
            auto& row = rows.emplace_back();
            for (auto const& q : unknowns_) {
                auto const c = q.experiment ? q.index : flows_[e]->states() + q.index;
                row.push_back(q.experiment.value_or(e) == e
                                  ? found[at].over_box(samples[k].channel, c)
                                  : interval(0.0));
            }
            result.weights.push_back(weights[k]);
        }
    }
    result.values = interval_matrix<interval>(rows.size(), unknowns_.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t c = 0; c < unknowns_.size(); ++c) result.values(i, c) = rows[i][c];
    }
    return result;
}

} // namespace sivid

#endif
