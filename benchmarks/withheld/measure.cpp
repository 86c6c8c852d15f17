// SPDX-License-Identifier: MIT
#include "measure.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace withheld {

world world_of(campaign const& c, measured_scenario const& s) {
    world w = base_world_of(c, s);
    w.e = c.true_effects;
    w.f = c.true_foreign;
    w.gusts = s.gusts;
    w.instruments = c.true_instruments;
    act_within(w, s.acting);
    return w;
}

world base_world_of(campaign const& c, measured_scenario const& s) {
    world w;
    w.c = c.true_constants;
    w.motor = s.plan.motor;
    w.rudder = s.plan.rudder;
    return w;
}

double largest_deviation(campaign const& c, effect_values const& e, foreign_values const& f) {
    double most = 0;
    for (auto const& s : c.scenarios) {
        if (s.plan.holdout) continue;
        // Coarse steps will do to see whether an effect matters.
        double const step = 5e-3;
        auto const truth = readings(world_of(c, s), s.initial, s.plan.sample_times, step);
        world model = base_world_of(c, s);
        model.e = e;
        model.f = f;
        auto const other = readings(model, s.initial, s.plan.sample_times, step);
        for (std::size_t i = 0; i < truth.size(); ++i)
            for (std::size_t const k : c.channels_measured)
                most = std::max(most, std::abs(truth[i][k] - other[i][k]) / error_bound[k]);
    }
    return most;
}

bool heading_passes(campaign const& c, double angle) {
    return std::any_of(c.scenarios.begin(), c.scenarios.end(), [&](auto const& s) {
        if (s.plan.holdout) return false;
        auto const now = readings(world_of(c, s), s.initial, s.plan.sample_times, 5e-3);
        return std::any_of(now.begin(), now.end(),
                           [angle](channels const& y) { return y[5] < angle - 0.2; });
    });
}

double largest_growth(campaign const& c) {
    double most = 0;
    for (auto const& s : c.scenarios) {
        if (s.plan.holdout) continue;
        double const step = 5e-3;
        auto const& times = s.plan.sample_times;
        auto const now = readings(world_of(c, s), s.initial, times, step);
        for (std::size_t i = 1; i < now.size(); ++i) {
            for (std::size_t const k : c.channels_measured) {
                double const rate = (now[i][k] - now[i - 1][k]) / (times[i] - times[i - 1]);
                double const grown =
                    c.noise_of_value[k] * std::abs(now[i][k]) + c.jitter[k] * std::abs(rate);
                most = std::max(most, grown / error_bound[k]);
            }
        }
    }
    return most;
}

double inflation_of(std::vector<double>& misfits, std::size_t allowed) {
    if (allowed >= misfits.size()) return 0;
    auto const place = misfits.begin() + static_cast<std::ptrdiff_t>(allowed);
    std::nth_element(misfits.begin(), place, misfits.end(), std::greater<>{});
    return *place;
}

double inflation_at_truth(campaign const& c, bool with_effects, part which) {
    double most = 0;
    for (auto const& s : c.scenarios) {
        if (s.plan.holdout != (which == part::holdout)) continue;
        auto const model = with_effects ? s.truth
                                        : readings(base_world_of(c, s), s.initial,
                                                   s.plan.sample_times, careful_step);
        std::vector<double> misfits;
        for (std::size_t i = 0; i < model.size(); ++i)
            for (std::size_t const k : c.channels_measured)
                misfits.push_back(
                    std::abs(apart(s.value[i][k], model[i][k],
                                   with_effects ? c.true_instruments.modulus[k] : 0)) /
                    error_bound[k]);
        std::size_t const allowed = outlier_budget(c.outlier_fraction, misfits.size());
        most = std::max(most, inflation_of(misfits, allowed));
    }
    return most;
}

} // namespace withheld
