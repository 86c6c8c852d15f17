// SPDX-License-Identifier: MIT
#include "simulate.hpp"

#include <algorithm>
#include <cmath>

namespace withheld {

namespace {

/// Times in (0, end) at which the command behind delay and dead band, or W, has a kink.
std::vector<double> kinks(world const& w, double end) {
    std::vector<double> all = w.motor.t;
    auto const& [t, value] = w.rudder;
    for (std::size_t i = 0; i < t.size(); ++i) {
        all.push_back(t[i] + w.e.input_delay);
        if (i == 0 || w.e.rudder_deadband <= 0) continue;
        for (double const edge : {-w.e.rudder_deadband, w.e.rudder_deadband}) {
            double const from = value[i - 1] - edge, to = value[i] - edge;
            if (from * to < 0)
                all.push_back(t[i - 1] + (t[i] - t[i - 1]) * from / (from - to) + w.e.input_delay);
        }
    }
    for (auto const& g : w.gusts) all.insert(all.end(), {g.begin, g.begin + g.length});
    std::erase_if(all, [&](double x) { return !(x > 0 && x < end); });
    return all;
}

command command_at(world const& w, double t) {
    // Before the start the rudder stands at delta(0); the recording may begin earlier.
    double const seen = std::max(t - w.e.input_delay, 0.0);
    return {w.motor.at(t), behind_deadband(w.rudder.at(seen), w.e.rudder_deadband)};
}

state moved(state const& s, state const& rate, double h) {
    state to = s;
    for (std::size_t i = 0; i < state_size; ++i) to[i] += h * rate[i];
    return to;
}

state runge_kutta(world const& w, state const& start, state const& s, double t, double h,
                  command const& at0, command const& at1) {
    command const half{(at0.motor + at1.motor) / 2, (at0.rudder + at1.rudder) / 2};
    state const k1 = derivative(w, t, at0, s, start);
    state const k2 = derivative(w, t + h / 2, half, moved(s, k1, h / 2), start);
    state const k3 = derivative(w, t + h / 2, half, moved(s, k2, h / 2), start);
    state const k4 = derivative(w, t + h, at1, moved(s, k3, h), start);
    state to = s;
    for (std::size_t i = 0; i < state_size; ++i)
        to[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return to;
}

} // namespace

std::vector<state> states_at(world const& w, channels const& initial,
                             std::vector<double> const& times, double max_step) {
    std::vector<state> result;
    if (times.empty()) return result;
    result.reserve(times.size());
    std::vector<double> stops = kinks(w, times.back());
    stops.insert(stops.end(), times.begin(), times.end());
    std::sort(stops.begin(), stops.end());

    state now{};
    std::copy(initial.begin(), initial.end(), now.begin());
    now[6] = command_at(w, 0).rudder; // the lag begins at rest; the motor begins at zero
    state const start = now;
    double t = 0;
    command here = command_at(w, 0);
    std::size_t wanted = 0;
    auto const record = [&] {
        for (; wanted < times.size() && times[wanted] <= t; ++wanted) result.push_back(now);
    };
    record();
    for (double const stop : stops) {
        if (stop <= t) continue;
        command const there = command_at(w, stop);
        auto const steps = std::max(1.0, std::ceil((stop - t) / max_step - 1e-9));
        double const begin = t, h = (stop - t) / steps;
        auto const between = [&](double share) {
            return command{here.motor + share * (there.motor - here.motor),
                           here.rudder + share * (there.rudder - here.rudder)};
        };
        for (double k = 0; k < steps; ++k)
            now = runge_kutta(w, start, now, begin + k * h, h, between(k / steps),
                              between((k + 1) / steps));
        t = stop;
        here = there;
        record();
    }
    return result;
}

std::vector<channels> readings(world const& w, channels const& initial,
                               std::vector<double> const& times, double max_step) {
    std::vector<double> wanted = times, old;
    double const latency = w.e.position_latency;
    if (latency > 0) {
        for (double const t : times) old.push_back(std::max(t - latency, 0.0));
        wanted.insert(wanted.end(), old.begin(), old.end());
        std::sort(wanted.begin(), wanted.end());
    }
    auto const states = states_at(w, initial, wanted, max_step);
    auto const find = [&](double t) -> state const& {
        auto const place = std::lower_bound(wanted.begin(), wanted.end(), t) - wanted.begin();
        return states[static_cast<std::size_t>(place)];
    };
    std::vector<channels> result;
    result.reserve(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (latency > 0)
            result.push_back(sensed(w, find(times[i]), find(old[i])));
        else
            result.push_back(sensed(w, states[i], states[i]));
    }
    return result;
}

} // namespace withheld
