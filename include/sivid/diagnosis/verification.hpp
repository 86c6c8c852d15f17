// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_VERIFICATION_HPP
#define SIVID_DIAGNOSIS_VERIFICATION_HPP

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/resolve_delays.hpp>
#include <sivid/paving/fit.hpp>
#include <sivid/paving/inflation.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What was proved about one problem, perhaps one whose model has delays.
struct verified_inflation {
    inflation_range range = unknown_inflation();
    std::optional<verified_witness> witness; ///< attains range.upper()
    std::vector<std::string> assumptions;
    box hull; ///< contains every parameter of inflation <= range.upper(); empty if not known
};

namespace diagnosis_detail {

inline bool has_delays(recorded_model const& m) {
    return !m.input_delays.empty() || !m.channel_delays.empty();
}

inline double clamped_into(double x, interval const& side) {
    return std::clamp(x, side.lower(), side.upper());
}

} // namespace diagnosis_detail

/// Encloses the inflation at one point: parameters and delays are those of the guess, so are the
/// starts but for those that follow from the parameters.
/// @param options  `options.witness` says how the runs are made
/// @guarantee  upper <= 1: the parameters explain the data, under `assumptions`
/// @cost  one validated run per experiment
[[nodiscard]] inline verified_inflation verify_at(identification_problem const& problem,
                                                  approximate_fit const& guess,
                                                  data_test_options const& options = {}) {
    verified_inflation result;
    if (guess.parameters.size() != problem.prior.size()) return result;
    auto at = problem;
    std::vector<double> p = guess.parameters;
    for (std::size_t j = 0; j < p.size(); ++j) {
        // Strictly within, so that the point lies in the decimal prior.
        auto const& side = problem.prior[j];
        if (side.lower() < side.upper()) {
            double const lo = std::nextafter(side.lower(), side.upper());
            double const hi = std::nextafter(side.upper(), side.lower());
            p[j] = lo <= hi ? std::clamp(p[j], lo, hi) : mid(side);
            at.prior[j] = interval(p[j]);
        }
    }
    start_added_states(at);
    auto starts = guess.starts;
    for (std::size_t s = 0; s < at.experiments.size(); ++s) {
        for (auto const& a : at.model.added_states) {
            auto const& side = at.experiments[s].initial[a.state];
            starts[s][a.state] = diagnosis_detail::clamped_into(starts[s][a.state], side);
        }
    }
    auto const delayed = diagnosis_detail::has_delays(at.model);
    auto resolved = resolve_delays(at, p);
    approximate_fit point;
    for (auto const j : resolved.kept) point.parameters.push_back(p[j]);
    point.starts = starts;
    if (resolved.problem.prior.size() == 0) {
        // An identification needs an unknown: any constant that is fixed stands in for it.
        auto const& [name, value] = *resolved.problem.choice.fixed.begin();
        point.parameters.push_back(mid(value));
        resolved.problem.prior = box{value};
        resolved.problem.choice.unknown.push_back(name);
    }
    auto const everything = box_explorer::without_limit(resolved.problem);
    data_test runs(everything, options);
    verified_witness witness{point.parameters, point.starts, {}};
    for (std::size_t s = 0; s < starts.size(); ++s) {
        auto const& initial = resolved.problem.experiments[s].initial;
        for (std::size_t i = 0; i < initial.size(); ++i) {
            witness.starts[s][i] = diagnosis_detail::clamped_into(witness.starts[s][i], initial[i]);
        }
    }
    result.range = inflation_at(runs, resolved.problem, witness);
    witness.parameters = p;
    result.witness = std::move(witness);
    if (delayed) result.assumptions.push_back("delayed times are rounded to the nearest double");
    return result;
}

} // namespace sivid

#endif
