// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_GAP_PROOF_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_GAP_PROOF_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_effort.hpp>
#include <sivid/diagnosis/gap/verified_inflation.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/inflation/observer_refutation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// The `most` experiments that a fit misses by most, in their order; a problem that has no more is
/// returned as it is. Where many short experiments are at hand, few of them carry a refutation.
/// @guarantee  the inflation of the result is at most that of the problem: a maximum over fewer
///             experiments, for every parameter
[[nodiscard]] inline identification_problem
hardest_experiments(identification_problem problem, approximate_fit const& fit, std::size_t most) {
    auto const n = problem.experiments.size();
    if (n <= most || fit.residuals.size() != n) return problem;
    std::vector<double> missed(n, 0.0);
    for (std::size_t e = 0; e < n; ++e) {
        auto sizes = fit.residuals[e];
        for (double& r : sizes) r = std::abs(r);
        auto const q = problem.experiments[e].outliers;
        if (sizes.size() <= q) continue;
        auto const at = sizes.begin() + static_cast<std::ptrdiff_t>(q);
        std::nth_element(sizes.begin(), at, sizes.end(), std::greater<>{});
        missed[e] = *at;
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return missed[a] > missed[b]; });
    order.resize(most);
    std::sort(order.begin(), order.end());
    std::vector<experiment> kept;
    for (auto const e : order) kept.push_back(std::move(problem.experiments[e]));
    problem.experiments = std::move(kept);
    return problem;
}

[[nodiscard]] inline gap_verdict gap_of(inflation_range const& inflation) {
    return inflation.upper() <= 1  ? gap_verdict::none
           : inflation.lower() > 1 ? gap_verdict::certified
                                   : gap_verdict::undecided;
}

/// A validated run at the fit: nothing is known from below.
[[nodiscard]] inline verified_inflation verify_fit(screened const& s,
                                                   feasibility_test_options const& test = {}) {
    auto result = verify_at(s.problem, s.fit, test);
    result.range = interval_traits<interval>::bounds(0, result.range.upper());
    return result;
}

/// Adds what a search proves to what is known.
inline void tighten(verified_inflation& known, screened const& s, inflation_options const& search) {
    auto proved = bound_inflation(s.problem, &s.fit, search);
    double upper = proved.value.upper();
    if (upper <= known.range.upper()) known.witness = std::move(proved.witness);
    upper = std::min(upper, known.range.upper());
    if (known.hull.size() == 0 && upper <= proved.value.upper()) known.hull = proved.hull;
    double const lower = std::max(proved.value.lower(), known.range.lower());
    known.range = interval_traits<interval>::bounds(std::min(lower, upper), upper);
}

/// A lower bound of the inflation from the experiments that are missed by most; 0 when there are no
/// more than these.
/// @param spent  receives the boxes
[[nodiscard]] inline double refuted_by_few(screened const& s, std::size_t hardest,
                                           inflation_options search, std::size_t& spent) {
    spent = 0;
    if (s.problem.experiments.size() <= 2 * hardest || s.fit.inflation <= 1) return 0;
    search.relative_width = 0.1;
    auto const few = hardest_experiments(s.problem, s.fit, hardest);
    auto const found = bound_inflation(few, nullptr, search);
    spent = diagnosis_effort::boxes_of(few, found);
    return found.value.lower();
}

/// Raises the lower bound by interval observers: for wide starts and long records, where no box of
/// the search over sets of trajectories is carried to the end.
inline void refute_by_observers(verified_inflation& known, screened const& s,
                                diagnosis_effort& effort, step_effort const& most) {
    auto const upper = known.range.upper();
    auto const proved = inflation_refuted_by_observers(s.problem, upper, effort.observers(most));
    known.range = interval_traits<interval>::bounds(
        std::max(known.range.lower(), std::min(proved.lower, upper)), upper);
}

/// Bounds the inflation of a model that has no delays.
/// @param known  as `verify_fit` left it
inline void prove_gap(verified_inflation& known, screened const& s, diagnosis_effort& effort,
                      gap_options const& options) {
    auto const is_open = [&known] { return gap_of(known.range) == gap_verdict::undecided; };
    bool const wide = has_wide_starts(s.problem);
    if (wide && is_open()) {
        refute_by_observers(known, s, effort,
                            {2 * options.observers.boxes, 2 * options.observers.share});
        if (!is_open()) return;
    }
    bool const explained = known.range.upper() <= 1;
    auto search = effort.search(s.problem, explained ? options.no_gap : options.bound);
    search.relative_width = options.relative_width;
    if (!explained) {
        auto enough = options.bound;
        enough.boxes = std::max(enough.boxes, options.further_boxes);
        search.further_boxes = effort.search(s.problem, enough).boxes;
        auto brief = search;
        brief.seconds *= 0.6;
        brief.further_boxes = 0;
        std::size_t spent = 0;
        double const fewer = refuted_by_few(s, options.hardest, brief, spent);
        auto const upper = known.range.upper();
        known.range = interval_traits<interval>::bounds(std::min(fewer, upper), upper);
        search.seconds = std::min(search.seconds, effort.left());
    }
    tighten(known, s, search);
    if (!wide && is_open() && effort.go_on("bounding the states")) {
        refute_by_observers(known, s, effort, options.observers);
    }
}

} // namespace sivid

#endif
