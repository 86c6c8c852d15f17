// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_OUTPUT_SENSITIVITIES_HPP
#define SIVID_PAVING_IDENTIFIABILITY_OUTPUT_SENSITIVITIES_HPP

#include <sivid/enclosure/sensitivity/sensitivity_tube.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability/detail/unknown_quantity.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A point, or the enclosure of a decimal: nothing that data could determine.
[[nodiscard]] inline bool is_known(interval const& side) {
    return width(side) <= 1e-12 * mag(side);
}

/// The parameters and, with `starts`, the starts that are not known exactly.
[[nodiscard]] inline std::vector<unknown_quantity>
unknowns_of(identification_problem const& problem, bool starts) {
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

/// The derivatives of the measured outputs by some unknowns.
struct output_sensitivities {
    interval_matrix<interval> values; ///< a row per measured output, a column per unknown
    std::vector<double> weights;      ///< per row: 1 / half-width of the measurement's bound
    std::size_t missing = 0; ///< outputs that the enclosure did not reach; they have no row
};

namespace paving_detail {

/// What a change of one output is compared with: the half-widths of the bounds.
inline std::vector<double> weights_of(record const& samples) {
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

/// The flows of a problem's experiments, with the inputs as recorded.
class sensitivity_runs {
public:
    sensitivity_runs(identification_problem const& problem, std::vector<unknown_quantity> unknowns,
                     enclosure_options const& options)
        : problem_(&problem), unknowns_(std::move(unknowns)), options_(options) {
        for (auto const& e : problem.experiments) {
            flows_.push_back(
                std::make_shared<flow const>(problem.model, problem.choice, nominal(e.inputs)));
            samples_.push_back(bounded(sorted(e.measurements)));
        }
    }

    [[nodiscard]] std::vector<unknown_quantity> const& unknowns() const { return unknowns_; }
    [[nodiscard]] flow const& equations(std::size_t experiment) const {
        return *flows_[experiment];
    }

    /// Encloses \f$ \partial y_i(t_i) / \partial (p, x_0)_c \f$ of all measured outputs, in the
    /// order of experiments and times, for all parameters and starts in the boxes. Measurements
    /// without a bound have no row.
    /// @param starts  one box per experiment
    /// @guarantee  holds for the recorded inputs
    /// @cost  one integration per experiment, and a step's derivative per time of measurement
    [[nodiscard]] output_sensitivities operator()(box const& parameters,
                                                  std::vector<box> const& starts) const {
        output_sensitivities result;
        std::vector<std::vector<interval>> rows;
        for (std::size_t e = 0; e < flows_.size(); ++e) {
            auto const& samples = samples_[e];
            if (samples.empty()) continue;
            auto const& from = problem_->experiments[e];
            auto const tube = integrate_with_sensitivities<interval>(
                flows_[e], starts[e], parameters, from.begin, samples.back().time, options_);
            auto const weights = paving_detail::weights_of(samples);
            std::optional<interval_matrix<interval>> derivatives;
            for (std::size_t k = 0; k < samples.size(); ++k) {
                double const t = samples[k].time;
                if (t > tube.states().end_time()) {
                    result.missing += samples.size() - k;
                    break;
                }
                if (k == 0 || t != samples[k - 1].time) derivatives = tube.observe_at(t);
                rows.push_back(row_of(*derivatives, samples[k].channel, e));
                result.weights.push_back(weights[k]);
            }
        }
        result.values = interval_matrix<interval>(rows.size(), unknowns_.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (std::size_t c = 0; c < unknowns_.size(); ++c) result.values(i, c) = rows[i][c];
        }
        return result;
    }

private:
    static record bounded(record const& samples) {
        record kept;
        for (auto const& m : samples) {
            if (std::isfinite(mag(m.bound))) kept.push_back(m);
        }
        return kept;
    }
    [[nodiscard]] std::vector<interval> row_of(interval_matrix<interval> const& derivatives,
                                               std::size_t channel, std::size_t e) const {
        auto const n = problem_->model.about.states.size();
        std::vector<interval> row(unknowns_.size(), interval(0.0));
        for (std::size_t c = 0; c < row.size(); ++c) {
            auto const& q = unknowns_[c];
            if (!q.experiment) row[c] = derivatives(channel, n + q.index);
            if (q.experiment == e) row[c] = derivatives(channel, q.index);
        }
        return row;
    }

    identification_problem const* problem_;
    std::vector<unknown_quantity> unknowns_;
    enclosure_options options_;
    std::vector<std::shared_ptr<flow const>> flows_;
    std::vector<record> samples_;
};

} // namespace sivid

#endif
