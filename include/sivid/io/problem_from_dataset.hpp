// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_PROBLEM_FROM_DATASET_HPP
#define SIVID_IO_PROBLEM_FROM_DATASET_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/io/dataset/outlier_rule.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

/// The scenarios of one role as experiments.
inline std::vector<experiment> experiments_of(dataset const& data, model_description const& about,
                                              scenario_role role,
                                              std::optional<outlier_rule> const& outliers) {
    std::vector<experiment> result;
    for (auto const& s : data.scenarios) {
        if (s.role != role) continue;
        if (s.inputs.size() != about.inputs.size() || s.initial.size() != about.states.size()) {
            throw std::invalid_argument(std::string{"problem_from_dataset: scenario '"} + s.name +
                                        "' has other inputs or states than the model");
        }
        experiment e;
        e.name = s.name;
        for (std::size_t i = 0; i < s.inputs.size(); ++i) {
            auto const& input = s.inputs[i];
            auto const& u = input.signal;
            e.inputs.emplace_back(std::in_place_type<sampled_signal>, u.times(), u.values(),
                                  u.kind(), input.error);
            if (input.bridged.empty()) continue;
            bridged_input b{about.inputs[i].name, input.missing, 0, u.kind() == interpolation::hold,
                            about.time_unit};
            for (auto const& [from, to] : input.bridged) b.longest = std::max(b.longest, to - from);
            e.bridged.push_back(std::move(b));
        }
        e.initial = box(s.initial.size());
        for (std::size_t i = 0; i < s.initial.size(); ++i) e.initial[i] = s.initial[i].range;
        e.measurements = s.measurements;
        e.outliers = outliers ? outliers->of(s.measurements.size()) : data.outlier_budget(s);
        result.push_back(std::move(e));
    }
    return result;
}

} // namespace io_detail

/// The identification problem that a data set states: its priors, its fixed constants, and one
/// experiment for each scenario of the role fit. Hold-out scenarios do not enter.
///   Bounds, priors and fixed constants are the enclosures of the stated decimals; every scenario
///   begins at t = 0 and may violate `outlier_budget` of its measurements.
/// @param outliers  for every scenario instead of the data set's own fraction: a budget, or a rule
/// @given  `data` was read with the names of this model (checked: name and sizes)
/// @throws std::invalid_argument otherwise
[[nodiscard]] SIVID_DECL identification_problem
problem_from_dataset(dataset const& data, recorded_model model,
                     std::optional<outlier_rule> const& outliers = std::nullopt);

/// The scenarios of the role holdout: they choose nothing.
/// @given  as for `problem_from_dataset`
[[nodiscard]] SIVID_DECL holdout holdout_from_dataset(dataset const& data,
                                                      model_description const& about);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/problem_from_dataset.ipp>
#endif

#endif // SIVID_IO_PROBLEM_FROM_DATASET_HPP
