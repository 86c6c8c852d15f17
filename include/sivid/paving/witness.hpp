// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_WITNESS_HPP
#define SIVID_PAVING_WITNESS_HPP

#include <sivid/paving/data_test.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/local_response.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// Verifies a guess by one validated run per experiment, at the guessed point and with the recorded
/// inputs.
[[nodiscard]] inline std::optional<verified_witness>
verify_witness(data_test& test, identification_problem const& problem,
               std::vector<double> const& parameters,
               std::vector<std::vector<double>> const& starts) {
    auto point = point_within(problem.prior, parameters);
    verified_witness result{mid(point), {}, {}};
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto const start = point_within(problem.experiments[s].initial, starts[s]);
        result.starts.push_back(mid(start));
        auto const answer = test.run_finely(s, start, point);
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
