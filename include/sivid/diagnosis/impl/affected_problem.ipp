// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_AFFECTED_PROBLEM_IPP
#define SIVID_DIAGNOSIS_IMPL_AFFECTED_PROBLEM_IPP

#include <sivid/diagnosis/affected_problem.hpp>

namespace sivid {

SIVID_DECL identification_problem affected(identification_problem const& base,
                                           std::vector<effect> const& effects) {
    identification_problem result{with(base.model, effects), base.choice, {}, base.experiments};
    auto const& inputs = result.model.about.inputs;
    for (auto& x : result.experiments) {
        for (auto k = base.model.about.inputs.size(); k < inputs.size(); ++k) {
            auto const e = std::find_if(effects.begin(), effects.end(), [&](effect const& other) {
                return other.name == inputs[k].name;
            });
            auto const& in = e->only_in;
            double const on = std::find(in.begin(), in.end(), x.name) == in.end() ? 0 : 1;
            x.inputs.push_back(analytic_signal::from([on](auto const&) { return on; }));
        }
    }
    std::vector<interval> prior(base.prior.begin(), base.prior.end());
    for (auto const& e : effects) {
        for (auto const& p : e.parameters) {
            result.choice.unknown.push_back(e.name + "." + p.name);
            prior.push_back(p.prior());
        }
    }
    result.prior = box(std::move(prior));
    start_added_states(result);
    return result;
}

} // namespace sivid

#endif
