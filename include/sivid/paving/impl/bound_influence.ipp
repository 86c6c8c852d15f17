// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_BOUND_INFLUENCE_IPP
#define SIVID_PAVING_IMPL_BOUND_INFLUENCE_IPP

#include <sivid/paving/bound_influence.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/work_limit.hpp>

#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL std::vector<bound_influence> influence_of_bounds(identification_problem const& problem,
                                                            std::vector<double> const& scales,
                                                            identify_options options) {
    problem.require_valid();
    std::set<std::size_t> measured;
    for (auto const& e : problem.experiments)
        for (auto const& m : e.measurements)
            if (!e.constraint) measured.insert(m.channel);
    std::vector<bound_influence> result(1);
    for (double const scale : scales) {
        if (!(scale > 0) || !std::isfinite(scale))
            throw std::invalid_argument("influence of bounds: a scale is not above 0");
        result.push_back({{}, scale});
        for (auto const c : measured)
            if (measured.size() > 1) result.push_back({c, scale});
    }
    work_limit const limit(options.search.seconds, options.search.keep_going);
    options.only_hulls = true;
    options.search.keep_going = limit;
    options.search.boxes /= result.size();
    for (std::size_t k = 0; k < result.size(); ++k) {
        auto& line = result[k];
        auto posed = problem;
        for (auto& e : posed.experiments)
            for (auto& m : e.measurements)
                if (k > 0 && !e.constraint && (!line.channel || m.channel == *line.channel))
                    m.bound = grown(m.bound, line.scale);
        options.search.seconds = limit.seconds() / static_cast<double>(result.size() - k);
        auto found = identify(posed, options);
        line.found = found.verdict;
        line.ended = is_complete(found.reason);
        line.hull = std::move(found.hull);
    }
    return result;
}

} // namespace sivid

#endif
