// SPDX-License-Identifier: MIT
#include "simulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace withheld {

namespace {

/// Times in (0, end) at which the command behind delay and dead band, or W, has a kink.
std::vector<double> kinks(world const& w, polyline const& rudder, double end) {
    std::vector<double> all = w.motor.t;
    if (!w.acting.always()) all.insert(all.end(), w.rudder.t.begin(), w.rudder.t.end());
    auto const& [t, value] = rudder;
    for (std::size_t i = 0; i < t.size(); ++i) {
        all.push_back(t[i] + w.e.input_delay);
        if (i == 0 || w.e.rudder_deadband <= 0) continue;
        for (double const edge : {-w.e.rudder_deadband, w.e.rudder_deadband}) {
            double const from = value[i - 1] - edge, to = value[i] - edge;
            if (from * to < 0)
                all.push_back(t[i - 1] + (t[i] - t[i - 1]) * from / (from - to) + w.e.input_delay);
        }
    }
    all.insert(all.end(), {w.acting.from, w.acting.to});
    for (auto const& g : w.gusts) all.insert(all.end(), {g.begin, g.begin + g.length});
    std::erase_if(all, [&](double x) { return !(x > 0 && x < end); });
    return all;
}

/// @param rudder  behind the play
command command_at(world const& w, polyline const& rudder, double t) {
    // Before the start the rudder stands at delta(0); the recording may begin earlier.
    double const seen = std::max(t - w.e.input_delay, 0.0);
    return {w.motor.at(t), behind_deadband(rudder.at(seen), w.e.rudder_deadband)};
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
    polyline const rudder = driven_rudder(w);
    std::vector<double> stops = kinks(w, rudder, times.back());
    stops.insert(stops.end(), times.begin(), times.end());
    std::sort(stops.begin(), stops.end());

    world neutral; // while the effects do not act
    if (!w.acting.always()) {
        neutral = w;
        neutral.e = {};
        neutral.e.rudder_lag = w.e.rudder_lag;
        neutral.e.motor_lag = w.e.motor_lag;
        neutral.lags_unseen = true;
    }
    auto const acting = [&](double at) -> world const& { return w.acting.holds(at) ? w : neutral; };
    auto const commanded = [&](world const& model, double at) {
        return command_at(model, &model == &neutral ? w.rudder : rudder, at);
    };
    state now{};
    std::copy(initial.begin(), initial.end(), now.begin());
    // The lag begins at rest, the motor at zero.
    now[6] = commanded(acting(0), 0).rudder;
    state const start = now;
    double t = 0;
    command here = commanded(acting(0), 0);
    std::size_t wanted = 0;
    auto const record = [&] {
        for (; wanted < times.size() && times[wanted] <= t; ++wanted) result.push_back(now);
    };
    record();
    for (double const stop : stops) {
        if (stop <= t) continue;
        world const& model = acting(t);
        command const there = commanded(model, stop);
        auto const steps = std::max(1.0, std::ceil((stop - t) / max_step - 1e-9));
        double const begin = t, h = (stop - t) / steps;
        auto const between = [&](double share) {
            return command{here.motor + share * (there.motor - here.motor),
                           here.rudder + share * (there.rudder - here.rudder)};
        };
        for (double k = 0; k < steps; ++k)
            now = runge_kutta(model, start, now, begin + k * h, h, between(k / steps),
                              between((k + 1) / steps));
        t = stop;
        bool const changes = stop == w.acting.from || stop == w.acting.to;
        here = changes ? commanded(acting(stop), stop) : there;
        record();
    }
    return result;
}

namespace {

/// States at any of the times that were asked for.
class known_states {
public:
    known_states(world const& w, channels const& initial, std::vector<double> times, double step)
        : times_(std::move(times)) {
        std::sort(times_.begin(), times_.end());
        times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
        states_ = states_at(w, initial, times_, step);
    }
    state const& operator()(double t) const {
        auto const place = std::lower_bound(times_.begin(), times_.end(), t) - times_.begin();
        return states_[static_cast<std::size_t>(place)];
    }

private:
    std::vector<double> times_;
    std::vector<state> states_;
};

/// tau z' = h - z from z = h at the start on, at the times that are asked for; h is linear over
/// steps of a millisecond, whose solution is exact.
std::vector<double> low_passed(std::vector<double> const& t, std::vector<double> const& h,
                               double tau, std::vector<double> const& times) {
    std::vector<double> result;
    double z = h.front();
    std::size_t wanted = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        if (i > 0) {
            double const dt = t[i] - t[i - 1], slope = (h[i] - h[i - 1]) / dt;
            z = h[i] - tau * slope + (z - h[i - 1] + tau * slope) * std::exp(-dt / tau);
        }
        if (wanted < times.size() && times[wanted] == t[i]) {
            result.push_back(z);
            ++wanted;
        }
    }
    return result;
}

} // namespace

std::vector<channels> readings(world const& w, channels const& initial,
                               std::vector<double> const& times, double max_step) {
    channels age = w.instruments.late;
    age[3] += w.e.position_latency;
    age[4] += w.e.position_latency;
    auto const& lag = w.instruments.lag;
    auto const in_use = [](double x) { return x > 0; };
    bool const slow = std::any_of(lag.begin(), lag.end(), in_use);
    std::vector<channels> result;
    result.reserve(times.size());
    if (!slow && std::none_of(age.begin(), age.end(), in_use)) {
        auto const states = states_at(w, initial, times, max_step);
        for (std::size_t i = 0; i < times.size(); ++i)
            result.push_back(sensed(w, times[i], states[i]));
        return result;
    }
    auto const older = [](double t, double by) { return std::max(t - by, 0.0); };
    std::vector<double> wanted = times, grid;
    for (auto const& ages : {age, w.instruments.late})
        for (double const a : ages)
            for (double const t : times)
                if (a > 0) wanted.push_back(older(t, a));
    if (slow) {
        grid = times;
        for (int i = 0; i * 1e-3 < times.back(); ++i) grid.push_back(i * 1e-3);
        std::sort(grid.begin(), grid.end());
        grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
        wanted.insert(wanted.end(), grid.begin(), grid.end());
    }
    known_states const at(w, initial, std::move(wanted), max_step);
    auto const age_at = [&](std::size_t k, double t) {
        return w.acting.holds(t) ? age[k] : w.instruments.late[k];
    };
    for (double const t : times) {
        channels shown{};
        for (std::size_t k = 0; k < channel_count; ++k)
            shown[k] = sensed(w, t, at(older(t, age_at(k, t))))[k];
        result.push_back(shown);
    }
    for (std::size_t k = 0; k < channel_count; ++k) {
        if (!(lag[k] > 0)) continue;
        std::vector<double> h;
        for (double const t : grid) h.push_back(sensed(w, t, at(t))[k]);
        auto const shown = low_passed(grid, h, lag[k], times);
        for (std::size_t i = 0; i < times.size(); ++i) result[i][k] = shown[i];
    }
    return result;
}

} // namespace withheld
