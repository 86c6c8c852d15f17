// SPDX-License-Identifier: MIT
// A cart that is pushed: p' = v, v' = k u - v/4; both states are measured. Small enough for tests
// that run a diagnosis from end to end.
#ifndef SIVID_TESTS_DIAGNOSIS_SMALL_CAMPAIGN_HPP
#define SIVID_TESTS_DIAGNOSIS_SMALL_CAMPAIGN_HPP

#include <sivid/model/effects.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace small_campaign {

using sivid::interval;

struct cart {
    static constexpr auto name = "cart";
    static constexpr auto states = sivid::states({{"p", "m", 50}, {"v", "m/s", 10}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"p", "m"}, {"v", "m/s"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1/kg", 1_dec}, {"d", "1/s", 0.25_dec}});
    }();
    template <class T>
    sivid::states_of<cart, T> rate(T const&, sivid::states_of<cart, T> const& x,
                                   sivid::constants_of<cart, T> const& c,
                                   sivid::inputs_of<cart, T> const& u) const {
        return {x[1], c[0] * u[0] - c[1] * x[1]};
    }
    template <class T>
    sivid::channels_of<cart, T> observe(T const&, sivid::states_of<cart, T> const& x,
                                        sivid::constants_of<cart, T> const&,
                                        sivid::inputs_of<cart, T> const&) const {
        return {x[0], x[1]};
    }
};

/// Input of experiment e: 1 at the begin.
inline double input(std::size_t e, double t) {
    return e == 0 ? std::cos(2 * t) : e == 1 ? std::cos(t) - t / 4 : 1 - t / 2;
}

/// What is truly so: the rate of (p, v), and what the two sensors show.
struct truth {
    double k = 1;
    std::function<double(double t, double v, double u)> missing = [](double, double, double) {
        return 0.0;
    };
    std::function<double(double)> seen_position = [](double p) { return p; };
    double delay = 0;             ///< of the input
    double play = 0;              ///< half of a gap behind it
    double limit = 0;             ///< of its rate [N/s]; 0: none
    double lag = 0;               ///< time constant behind it [s]
    double drift = 0;             ///< of its clock
    double sensor_delay = 0;      ///< of the position
    double sensor_drift = 0;      ///< of its clock
    double from = 0, until = 100; ///< when these are seen [s]
    int every = 100;              ///< milliseconds from one measurement to the next
    sivid::interpolation between = sivid::interpolation::linear; ///< samples of the input
};

/// Measured every 0.1 s, unless the truth says otherwise, for 4 s, within +-0.02 m and +-0.03 m/s;
/// the deviations alternate and fill 60 % of the bounds.
inline sivid::experiment experiment(std::size_t e, truth const& real) {
    sivid::experiment result;
    result.name = "E" + std::to_string(e + 1);
    std::vector<double> times, values;
    for (int k = 0; k <= 80; ++k) {
        times.push_back(0.05 * k);
        values.push_back(input(e, times.back()));
    }
    sivid::sampled_signal const u(times, values, real.between);
    result.inputs = {u};
    double const v0 = e == 1 ? 0.5 : 0;
    result.initial = sivid::box{interval(0.0), interval(v0)};
    double p = 0, v = v0;
    double const h = 1e-3;
    std::vector<double> behind{u.approximate(0)}; // the play or the limit, every half step
    for (int k = 1; k <= 8000; ++k) {
        double const now = u.approximate(k * h / 2);
        double const most = real.limit * h / 2;
        behind.push_back(real.limit > 0
                             ? std::clamp(now, behind.back() - most, behind.back() + most)
                             : std::clamp(behind.back(), now - real.play, now + real.play));
    }
    if (real.lag > 0) { // exact for straight lines
        double const left = std::exp(-h / 2 / real.lag);
        for (std::size_t k = 1; k < behind.size(); ++k) {
            double const before = u.approximate((static_cast<double>(k) - 1) * h / 2);
            double const slope = (u.approximate(static_cast<double>(k) * h / 2) - before) / (h / 2);
            double const limit = before - slope * real.lag;
            behind[k] = limit + slope * h / 2 + (behind[k - 1] - limit) * left;
        }
    }
    auto const acts = [&](double t) { return t >= real.from && t < real.until; };
    std::vector<double> past{p};
    auto const rate = [&](double t, double w) {
        double const late = std::max(0.0, t - real.delay - real.drift * t);
        double const force = !acts(t) ? u.approximate(t)
                             : real.play > 0 || real.limit > 0 || real.lag > 0
                                 ? behind[static_cast<std::size_t>(std::lround(2 * late / h))]
                                 : u.approximate(late);
        return real.k * force - w / 4 + real.missing(t, w, force);
    };
    for (int step = 1; step <= 4000; ++step) {
        double const t = (step - 1) * h;
        double const a1 = rate(t, v), a2 = rate(t + h / 2, v + h / 2 * a1);
        double const a3 = rate(t + h / 2, v + h / 2 * a2), a4 = rate(t + h, v + h * a3);
        p += h * (v + h / 6 * (a1 + a2 + a3));
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        past.push_back(p);
        if (step % real.every != 0) continue;
        double const wave = 0.6 * std::sin(12.9898 * step + 4.1 * static_cast<double>(e));
        auto const around = [](double y, double size) { return interval(y - size, y + size); };
        double const ago = real.sensor_delay + real.sensor_drift * step * h;
        auto const steps_ago = acts(step * h) ? std::lround(ago / h) : 0;
        double const shown = past[static_cast<std::size_t>(std::max(0L, step - steps_ago))];
        result.measurements.push_back(
            {step * h, 0, around(real.seen_position(shown) + 0.02 * wave, 0.02)});
        result.measurements.push_back({step * h, 1, around(v + 0.03 * wave, 0.03)});
    }
    return result;
}

inline sivid::identification_problem problem(truth const& real = {}) {
    sivid::identification_problem result{
        sivid::record_model(cart{}), {{"k"}, {}}, sivid::box{interval(0.5, 1.5)}, {}};
    for (std::size_t e = 0; e < 2; ++e) result.experiments.push_back(experiment(e, real));
    return result;
}

} // namespace small_campaign

#endif
