// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_WITNESS_HPP
#define SIVID_PAVING_WITNESS_HPP

#include <sivid/paving/data_test.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/local_response.hpp>
#include <sivid/paving/problem.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Verifies a guess by one validated run per experiment, at the guessed point.
[[nodiscard]] inline std::optional<verified_witness>
verify_witness(data_test& test, identification_problem const& problem,
               std::vector<double> const& parameters,
               std::vector<std::vector<double>> const& starts) {
    verified_witness result{parameters, starts, {}};
    if (!contains(problem.prior, parameters)) return std::nullopt;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        if (!contains(problem.experiments[s].initial, starts[s])) return std::nullopt;
        auto const answer = test.run_point(s, starts[s], parameters);
        auto point = point_box(parameters);
        if (!assess(*answer, point).explained) return std::nullopt;
        auto& violated = result.violated.emplace_back();
        auto const values = output_ranges(*answer, point);
        for (std::size_t y = 0; y < values.size(); ++y) {
            violated.push_back(!subset(values[y], answer->bounds[y]));
        }
        violated.resize(answer->measurements, true);
    }
    return result;
}

} // namespace sivid

#endif
