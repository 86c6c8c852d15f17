// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_EXPERIMENT_DESIGN_IPP
#define SIVID_DECISION_IMPL_EXPERIMENT_DESIGN_IPP

#include <sivid/decision/experiment_design.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/design/detail/design_guide.hpp>
#include <sivid/model/best_settings.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL double tried_manoeuvre::factor() const {
    if (!promised) return 1;
    if (promised->goals.empty()) return promised->told_apart ? 0 : 1;
    double product = 1;
    for (auto const& g : promised->goals)
        product = upper(interval_traits<interval>::mul(interval(product), interval(g.factor())));
    return product;
}

namespace decision_detail {

/// Whether a manoeuvre is proved to keep the limits of all models, as far as it is known.
/// @returns integrations
inline std::size_t check_limits(tried_manoeuvre& t, std::vector<design_guide::model> const& models,
                                prediction_options const& checking) {
    std::size_t integrations = 0;
    for (auto const& m : models) {
        if (m.limits == nullptr) continue;
        if (t.limits && *t.limits != requirement_answer::proved) continue;
        // A refutation would be of no use: what is not proved is not allowed.
        auto const kept = verify(m.problem->under(t.inputs), *m.limits, {}, checking);
        t.limits = kept.answer;
        integrations += kept.integrations;
    }
    return integrations;
}

/// Chooses the settings of each manoeuvre by a guide, and proves the best.
/// @param prove  fills in what is proved of a manoeuvre, in so many seconds
inline experiment_design
design_search(std::vector<manoeuvre> const& menu, std::vector<design_guide::model> const& models,
              planned_measurements const& plan, std::vector<node_id> const& goals,
              design_options const& options,
              std::function<void(tried_manoeuvre&, promise_options const&)> const& prove) {
    for (auto const& m : models) {
        m.problem->require_valid();
        plan.require_valid(*m.problem);
    }
    work_limit limit(options.seconds, options.keep_going);
    experiment_design result;

    work_limit looking(options.seconds, limit);
    design_guide guide(models, plan, goals, options.run, [&looking] { return looking(); });
    double const until = 0.8 * options.seconds;
    for (std::size_t k = 0; k < menu.size(); ++k) {
        auto const& m = menu[k];
        looking = work_limit((until - limit.spent()) / static_cast<double>(menu.size() - k), limit);
        auto const chosen = best_settings(
            m.settings, [&](std::vector<double> const& s) { return guide(m.inputs(s)); });
        if (!(chosen.value > -1e5)) continue; // cannot be run, or passes the limits
        tried_manoeuvre t{m.name, m.settings, chosen.settings, m.inputs(chosen.settings)};
        t.estimate = std::min(1.0, std::exp(-chosen.value));
        result.tried.push_back(std::move(t));
    }
    result.simulated = guide.looked_at();
    std::stable_sort(result.tried.begin(), result.tried.end(),
                     [](auto const& a, auto const& b) { return a.estimate < b.estimate; });

    auto const most = std::min(options.proved, result.tried.size());
    for (std::size_t k = 0; k < most && limit(); ++k) {
        auto& t = result.tried[k];
        double const each = limit.seconds() / static_cast<double>(most - k);
        promise_options promising;
        promising.seconds = 0.6 * each;
        promising.pairs = options.pairs;
        promising.target = options.target;
        promising.run = options.run;
        promising.keep_going = limit;
        prove(t, promising);
        result.integrations += t.promised->integrations;
        prediction_options checking;
        checking.seconds = 0.4 * each / static_cast<double>(models.size());
        checking.parts = 1000;
        checking.run = options.run;
        checking.keep_going = limit;
        result.integrations += check_limits(t, models, checking);
    }
    std::stable_sort(result.tried.begin(), result.tried.end(), [](auto const& a, auto const& b) {
        if (a.allowed() != b.allowed()) return a.allowed();
        return a.allowed() ? a.factor() < b.factor() : a.estimate < b.estimate;
    });
    result.seconds = limit.spent();
    return result;
}

} // namespace decision_detail

SIVID_DECL experiment_design design_experiment(prediction_problem const& problem,
                                               std::vector<manoeuvre> const& menu,
                                               planned_measurements const& plan,
                                               std::vector<design_goal> const& goals,
                                               requirement const* limits,
                                               design_options const& options) {
    if (goals.empty()) throw std::invalid_argument("design: there is no goal");
    std::vector<node_id> nodes;
    for (auto const& g : goals) nodes.push_back(g.value);
    return decision_detail::design_search(menu, {{&problem, limits}}, plan, nodes, options,
                                          [&](tried_manoeuvre& t, promise_options const& how) {
                                              t.promised = promise_widths(problem.under(t.inputs),
                                                                          plan, nodes, how);
                                          });
}

SIVID_DECL experiment_design design_separation(prediction_problem const& first,
                                               prediction_problem const& second,
                                               std::vector<manoeuvre> const& menu,
                                               planned_measurements const& plan,
                                               requirement const* limits_of_first,
                                               requirement const* limits_of_second,
                                               design_options const& options) {
    return decision_detail::design_search(
        menu, {{&first, limits_of_first}, {&second, limits_of_second}}, plan, {}, options,
        [&](tried_manoeuvre& t, promise_options const& how) {
            t.promised = tell_apart(first.under(t.inputs), second.under(t.inputs), plan, how);
        });
}

} // namespace sivid

#endif
