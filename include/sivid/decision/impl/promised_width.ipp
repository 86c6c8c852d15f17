// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_PROMISED_WIDTH_IPP
#define SIVID_DECISION_IMPL_PROMISED_WIDTH_IPP

#include <sivid/decision/promised_width.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/design/detail/pair_search.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL planned_measurements planned_measurements::every(double period, double end,
                                                            std::vector<double> errors) {
    planned_measurements plan{{}, std::move(errors)};
    if (!(period > 0) || !(end / period <= 1e6))
        throw std::invalid_argument("planned measurements: at most a million instants, the period "
                                    "must be above 0");
    for (double k = 1; k * period < end * (1 - 1e-9); ++k) plan.times.push_back(k * period);
    plan.times.push_back(end);
    return plan;
}

SIVID_DECL void planned_measurements::require_valid(prediction_problem const& p) const {
    auto const fail = [](std::string const& what) {
        throw std::invalid_argument("planned measurements: " + what);
    };
    if (errors.size() != p.model.about.channels.size())
        fail("one error bound per channel is needed" +
             needed_given(p.model.about.channels.size(), errors.size()));
    for (double const e : errors) {
        if (!(e >= 0) || !std::isfinite(e))
            fail("error bounds must be finite, and 0 or more, not " + nearest_text(e));
    }
    if (std::none_of(errors.begin(), errors.end(), [](double e) { return e > 0; }))
        fail("no channel is measured");
    for (double const t : times) {
        if (!(t >= 0 && t <= p.end))
            fail("times must lie within the experiment, from 0 to " + nearest_text(p.end) +
                 ", and one is " + nearest_text(t));
    }
    if (times.empty()) fail("there is no time to measure at");
}

SIVID_DECL double promised_width::factor() const {
    using traits = interval_traits<interval>;
    if (!(after < most)) return 1;
    bool undefined = false;
    auto const share = traits::div(traits::point(after), traits::point(before), undefined);
    return undefined || !(before > 0) ? 1 : std::min(1.0, upper(share));
}

SIVID_DECL promise promise_widths(prediction_problem const& problem,
                                  planned_measurements const& plan,
                                  std::vector<node_id> const& goals,
                                  promise_options const& options) {
    problem.require_valid();
    plan.require_valid(problem);
    for (auto const g : goals) {
        if (g >= problem.model.g.size() || (problem.model.g.depends(g) & ~on_constant) != 0)
            throw std::invalid_argument("a goal is no function of the model's constants");
    }
    stopwatch const clock;
    auto result = decision_detail::pair_search(problem, plan, goals, options)();
    result.seconds = clock.spent();
    return result;
}

SIVID_DECL promise tell_apart(prediction_problem const& first, prediction_problem const& second,
                              planned_measurements const& plan, promise_options const& options) {
    for (auto const* p : {&first, &second}) {
        p->require_valid();
        plan.require_valid(*p);
    }
    auto const same = [](auto const& a, auto const& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](auto const& x, auto const& y) { return x.name == y.name; });
    };
    if (first.end != second.end || !same(first.model.about.channels, second.model.about.channels) ||
        !same(first.model.about.inputs, second.model.about.inputs))
        throw std::invalid_argument("tell_apart: both models need the same inputs (no effect that "
                                    "acts in some experiments only), channels and duration");
    stopwatch const clock;
    auto result = decision_detail::pair_search(first, second, plan, options)();
    result.seconds = clock.spent();
    return result;
}

} // namespace sivid

#endif
