// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SOFT_SWITCH_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_SOFT_SWITCH_HPP

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Which ends of its time of action an effect may have in the midst of an experiment.
struct episode_ends {
    bool begins = true, ends = false;
};

/// The effect with a switch that may change in the midst of any experiment of a problem.
[[nodiscard]] inline effect switched_within_all(identification_problem const& base, effect e) {
    std::vector<std::string> names;
    std::vector<double> middles;
    for (auto const& x : base.experiments) {
        names.push_back(x.name);
        middles.push_back(x.begin + 0.5 * (x.end() - x.begin));
    }
    return only_within(std::move(e), std::move(names), std::move(middles));
}

/// A problem with an effect whose switch is a smooth step in time, or one up and one down, whose
/// length is this share of each experiment. At which share of it they are made are further
/// parameters: for all experiments where it begins, then where it ends.
/// @param e  its channels are not late
[[nodiscard]] inline identification_problem with_soft_switch(identification_problem const& base,
                                                             effect const& e, episode_ends ends,
                                                             double length) {
    using namespace literals;
    auto const switched = switched_within_all(base, e);
    auto const count = base.experiments.size();
    auto hard = affected(base, {switched});
    auto const at_switch = index_of(hard.model.about.inputs, switched.name, "input");
    effect soft;
    soft.name = "episode";
    auto const share = [&](std::string const& name) {
        soft.parameters.push_back({name, "1", -0.05_dec, 1.05_dec, 0_dec});
    };
    for (std::size_t s = 0; s < count; ++s) {
        auto const which = static_cast<double>(s); // the experiment
        hard.experiments[s].inputs[at_switch] =
            analytic_signal::from([which](auto const&) { return which; });
        if (ends.begins) share(base.experiments[s].name);
    }
    for (auto const& x : base.experiments)
        if (ends.ends) share(x.name + "_end");
    std::size_t const steps = ends.begins && ends.ends ? 2 : 1;
    soft.on_inputs = [&](effect_scope& h) {
        auto& on = h.input(switched.name);
        expression begin(0.0), span(0.0);
        std::vector<expression> at(2, expression(0.0));
        for (std::size_t s = 0; s < count; ++s) {
            auto const& x = base.experiments[s];
            auto const here = max(1 - abs(on - static_cast<double>(s)), 0); // folds to 0 or 1
            begin += here * x.begin;
            span += here * (x.end() - x.begin);
            for (std::size_t step = 0; step < steps; ++step)
                at[step] += here * h.parameter(step * count + s);
        }
        auto const so_far = (h.time() - begin) / span;
        auto const up = [&](expression const& where) {
            return 0.5 * (1 + tanh((so_far - where) / length));
        };
        if (ends.begins && ends.ends)
            on = up(at[0]) * (1 - up(at[1]));
        else
            on = ends.begins ? up(at[0]) : 1 - up(at[0]);
    };
    return affected(hard, {soft});
}

} // namespace sivid

#endif
