// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_COMPLETION_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_COMPLETION_HPP

/// @file
/// What a result says beside what a search has found.

#include <sivid/model/problem.hpp>
#include <sivid/paving/divisors.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/run/run_reach.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

[[nodiscard]] inline search_effort effort_of(inversion const& found, inversion_options const& how) {
    search_effort result{found.work, std::min(how.seconds, 1e300), found.tested, how.boxes, {}};
    result.sufficient_ratio = how.sufficient_ratio;
    result.hull_gain = how.hull_gain;
    if (how.memory < std::numeric_limits<std::size_t>::max()) result.most_bytes = how.memory;
    return result;
}

/// Measurements that fail for every parameter that is left.
inline std::vector<forced_outlier>
find_forced(feasibility_test& test, identification_problem const& problem, box const& hull) {
    std::vector<forced_outlier> forced;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        if (problem.experiments[s].outliers == 0) continue;
        auto const answer = test.run(s, problem.experiments[s].initial, hull);
        auto const values = output_ranges(*answer, hull);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (disjoint(values[i], answer->bounds[i])) forced.push_back({s, i});
        }
    }
    return forced;
}

/// Where runs end, what makes them wide, and what the equations divide by.
/// @param map   to the sides that were searched
/// @param left  of them
inline void show_why_little(identification& result, inquiry const& asked,
                            identification_problem const& problem,
                            std::optional<reduction> const& map, box const& left) {
    run_options run = asked.options();
    run.keep_going = asked.limit();
    result.reach = reach_of_runs(asked.searched(), left, run);
    result.divisors = divisors_of(problem, {.keep_going = asked.limit()});
    std::erase_if(result.divisors, [](divisor const& d) { return d.zeros == zeros::none; });
    if (!map) return;
    auto const names = map->side_names();
    for (auto& r : result.reach)
        for (auto& c : r.causes)
            if (!c.start) c.name = names[c.index];
}

} // namespace sivid::paving_detail

#endif
