// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_KINK_RANGES_HPP
#define SIVID_PAVING_JUDGE_DETAIL_KINK_RANGES_HPP

/// @file
/// How large the arguments of kinks may be, and how finely an experiment is measured: by both,
/// kinks are rounded off by little (`smoothed`), whatever the units.

#include <sivid/measurement/record.hpp>
#include <sivid/model/change/added_start.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <variant>

namespace sivid {

/// What the model's leaves may be in an experiment, states within their own ranges.
[[nodiscard]] inline leaf_ranges ranges_in(identification_problem const& problem,
                                           experiment const& e) {
    using traits = interval_traits<interval>;
    auto const& about = problem.model.about;
    leaf_ranges at{traits::bounds(e.begin, e.end()), box(about.states.size()),
                   box(constant_ranges(problem.model, problem.choice, problem.prior)),
                   box(e.inputs.size())};
    for (std::size_t i = 0; i < about.states.size(); ++i)
        at.states[i] = traits::bounds(-about.states[i].limit, about.states[i].limit);
    for (std::size_t i = 0; i < e.inputs.size(); ++i) {
        if (auto const* u = std::get_if<sampled_signal>(&e.inputs[i])) {
            for (double const x : u->values())
                at.inputs[i] = traits::hull(at.inputs[i], traits::point(x));
        } else {
            auto const& formula = std::get<analytic_signal>(e.inputs[i]);
            graph_range range(formula.g, {formula.value});
            range.evaluate({interval(e.begin), {}, {}, {}});
            at.inputs[i] = range.undefined(formula.value)
                               ? traits::bounds(-detail::infinity, detail::infinity)
                               : range.value(formula.value);
        }
    }
    return at;
}

/// The narrowest of the bounds, each as a share of its channel's largest reading; 1 for none.
[[nodiscard]] inline double finest_share(record const& samples) {
    std::map<std::size_t, double> largest;
    for (auto const& m : samples) {
        if (std::isfinite(mag(m.bound)))
            largest[m.channel] = std::max(largest[m.channel], mag(m.bound));
    }
    double finest = 1;
    for (auto const& m : samples) {
        if (double const most = largest[m.channel]; most > 0)
            finest = std::min(finest, width(m.bound) / most);
    }
    return finest;
}

} // namespace sivid

#endif
