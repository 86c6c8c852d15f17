// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_WITNESS_HPP
#define SIVID_PAVING_JUDGE_WITNESS_HPP

#include <sivid/model/change/added_start.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Verifies a guess by one validated run per experiment, at the guessed point and with the recorded
/// inputs; states that follow the parameters start where these say.
[[nodiscard]] inline std::optional<verified_witness>
verify_witness(feasibility_test& test, identification_problem const& problem,
               std::vector<double> const& parameters,
               std::vector<std::vector<double>> const& starts) {
    auto point = point_within(problem.prior, parameters);
    verified_witness result{mid(point), {}, {}};
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto const start = start_that_follows(
            problem, s, point, point_within(problem.experiments[s].initial, starts[s]));
        if (!start) return std::nullopt;
        result.starts.push_back(mid(*start));
        auto const answer = test.run_finely(s, *start, point);
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

/// Encloses the inflation at one point by validated runs: for each experiment the (q+1)-th largest
/// misfit, and the largest of these. Infinite where a run fails. The runs are those of the recorded
/// inputs: where inputs have error bounds, others may do better, and nothing is known from below.
/// @param test    of the same problem without limits of outliers
/// @param starts  one point, or next to a point, per experiment
/// @param what    receives the violated measurements
[[nodiscard]] inline interval inflation_at(feasibility_test& test,
                                           identification_problem const& problem,
                                           box const& parameters, std::vector<box> const& starts,
                                           verified_witness& what) {
    double least = 0;
    double most = 0;
    what = {mid(parameters), {}, {}};
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        what.starts.push_back(mid(starts[s]));
        auto const answer = test.run_finely(s, starts[s], parameters);
        auto const values = output_ranges(*answer, parameters);
        std::vector<double> low(answer->measurements, 0.0);
        std::vector<double> high(answer->measurements, detail::infinity);
        auto& violated = what.violated.emplace_back(answer->measurements, true);
        for (std::size_t y = 0; y < values.size(); ++y) {
            auto const ratio = misfit(values[y], answer->bounds[y]);
            low[y] = ratio.lower();
            high[y] = ratio.upper();
            violated[y] = !subset(values[y], answer->bounds[y]);
        }
        auto const q = problem.experiments[s].outliers;
        if (!any_uncertain(problem.experiments[s].inputs)) {
            least = std::max(least, largest_after(std::move(low), q));
        }
        most = std::max(most, largest_after(std::move(high), q));
    }
    return interval_traits<interval>::bounds(least, most);
}

} // namespace sivid

#endif
