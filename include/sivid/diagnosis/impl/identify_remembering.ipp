// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_IDENTIFY_REMEMBERING_IPP
#define SIVID_DIAGNOSIS_IMPL_IDENTIFY_REMEMBERING_IPP

#include <sivid/diagnosis/identify_remembering.hpp>

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL identification identify_remembering(identification_problem const& base,
                                               std::vector<effect> const& effects,
                                               effect_hull_options options) {
    work_limit const limit(options.seconds, options.keep_going);
    auto const problem = affected(base, effects);
    problem.require_data();
    identification result(problem.prior);
    result.assumptions.push_back(input_assumption(problem.experiments));
    for (auto& words : wrap_assumptions(effects)) result.assumptions.push_back(std::move(words));
    {
        work_limit const first(0.33 * options.seconds, options.keep_going);
        screening_options fitting;
        fitting.go_on = first;
        screening tried(base, effects, fitting);
        std::vector<std::size_t> all(effects.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        tried.try_one({});
        for (auto const e : all) tried.try_one({e});
        tried.try_one(all);
        if (auto const* s = tried.find(all)) {
            result.guess = s->fit;
            auto proved = verify_at(s->problem, s->fit, limited(options.test, first));
            if (proved.witness && proved.range.upper() <= 1) {
                result.witness = std::move(proved.witness);
                result.assumptions.insert(result.assumptions.end(), proved.assumptions.begin(),
                                          proved.assumptions.end());
            }
        }
    }
    options.seconds = limit.seconds();
    options.tried = [&result](contraction_journal const& more) { add(result.journal, more); };
    auto found = effect_hulls(base, effects, options);
    bool const none = found.parameters.size() == 0 || is_empty(found.parameters);
    if (none) {
        result.hull = empty_box(problem.prior.size());
    } else {
        result.hull = intersect(found.parameters, problem.prior);
        result.paving.add(result.hull, box_verdict::pending);
        result.combinations = std::move(found.products);
    }
    result.verdict = none             ? verdict::inconsistent
                     : result.witness ? verdict::consistent
                                      : verdict::undecided;
    bool const in_time = limit(); // asked first: what tells the two apart knows as much later
    bool const ended = options.keep_going && !options.keep_going();
    result.reason = none      ? stop_reason::decided
                    : ended   ? stop_reason::cancelled
                    : in_time ? stop_reason::accuracy_reached // of slices
                              : stop_reason::time_budget;
    result.seconds = limit.spent();
    return result;
}

} // namespace sivid

#endif
