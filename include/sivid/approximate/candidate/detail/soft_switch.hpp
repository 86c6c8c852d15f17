// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_SOFT_SWITCH_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_SOFT_SWITCH_HPP

#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Which ends of its time of action an effect may have in the midst of an experiment.
struct episode_ends {
    bool begins = true, ends = false;
};

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

/// A problem with an effect that is switched on and off by jumps. About each of them it acts by a
/// share of its own, for as long as `width` of the experiment says to either side: nearly what a
/// jump does that comes the sooner the larger the share, which are further parameters in the order
/// of `places`.
/// @param places  of the jumps, as shares: for all experiments where it begins, then where it ends
[[nodiscard]] inline identification_problem with_soft_jumps(identification_problem const& base,
                                                            effect const& e, episode_ends ends,
                                                            std::vector<double> const& places,
                                                            double width) {
    using namespace literals;
    auto const switched = switched_within_all(base, e);
    auto hard = affected(base, {switched});
    auto const at_switch = index_of(hard.model.about.inputs, switched.name, "input");
    auto const count = base.experiments.size(), steps = places.size() / count;
    auto const held = [&](std::size_t s, double from, double to) {
        auto const& x = base.experiments[s];
        std::vector<double> times{x.begin}, values{from > 0 ? 0.0 : 1.0};
        auto const add = [&](double share, double value) {
            double const t = x.begin + share * (x.end() - x.begin);
            if (t > times.back()) times.push_back(t), values.push_back(value);
        };
        if (from > 0) add(from, 1);
        add(to, 0);
        return sampled_signal(std::move(times), std::move(values), interpolation::hold);
    };
    for (std::size_t s = 0; s < count; ++s) {
        double const on = ends.begins ? places[s] + width : 0;
        double const off = ends.ends ? places[s + (steps - 1) * count] - width : 2;
        hard.experiments[s].inputs[at_switch] = held(s, on, std::max(on, off));
    }
    std::vector<effect> halves(steps + 1);
    for (std::size_t step = 0; step < halves.size(); ++step) {
        auto& half = halves[step];
        half.name = step == steps ? "which" : "half " + std::to_string(step);
        half.only_in = switched.only_in;
        if (step == steps) continue;
        for (auto const& name : switched.only_in)
            half.parameters.push_back({name, "1", -1_dec, 2_dec, 0_dec});
        half.on_inputs = [&](effect_scope& h) {
            for (std::size_t s = 0; s < count; ++s) {
                auto const here = max(1 - abs(h.input("which") - static_cast<double>(s)), 0);
                h.input(switched.name) += here * h.parameter(s); // while it acts
            }
        };
    }
    auto soft = affected(hard, halves);
    auto const place = [&](effect const& one) {
        return index_of(soft.model.about.inputs, one.name, "input");
    };
    for (std::size_t s = 0; s < count; ++s) {
        auto& inputs = soft.experiments[s].inputs;
        auto const which = static_cast<double>(s);
        inputs[place(halves.back())] =
            analytic_signal::from([which](auto const&) { return which; });
        for (std::size_t step = 0; step < steps; ++step) {
            double const at = places[s + step * count];
            inputs[place(halves[step])] = held(s, std::max(at - width, 1e-9), at + width);
        }
    }
    return soft;
}

} // namespace sivid

#endif
