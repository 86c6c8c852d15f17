// SPDX-License-Identifier: MIT
#include "noise.hpp"
#include "measure.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace withheld {

namespace {

enum class shape { uniform, triangular, bell, edges };

/// Within [-1, 1].
double drawn(shape s, random_source& random) {
    double const a = random.uniform(-1, 1);
    switch (s) {
    case shape::uniform:
        return a;
    case shape::triangular:
        return (a + random.uniform(-1, 1)) / 2;
    case shape::bell:
        return std::clamp(random.normal() / 3, -1.0, 1.0);
    case shape::edges:
        return std::sin(std::numbers::pi * a); // often close to the bound
    }
    return a;
}

/// The truth as it is shown by instruments whose time stamps are off.
std::vector<channels> shown(campaign const& c, measured_scenario const& s, random_source& random) {
    auto result = s.truth;
    for (std::size_t k = 0; k < channel_count; ++k) {
        if (!(c.jitter[k] > 0)) continue;
        auto const& when = s.plan.sample_times;
        auto off = when;
        for (std::size_t i = 0; i < when.size(); ++i) {
            double const room =
                i + 1 < when.size() ? when[i + 1] - when[i] : 0; // none is overtaken
            double const most = std::min(c.jitter[k], 0.49 * room);
            off[i] = std::max(0.0, when[i] + random.uniform(-most, most));
        }
        auto const late = readings(world_of(c, s), s.initial, off, careful_step);
        for (std::size_t i = 0; i < when.size(); ++i) result[i][k] = late[i][k];
    }
    return result;
}

/// Errors within [-1, 1] that reach an end and fall to 1/e, without new ones, in so many seconds.
std::vector<double> slow_errors(std::vector<double> const& times, double seconds,
                                random_source& random) {
    std::vector<double> result;
    double now = random.uniform(-1, 1), most = 1e-9;
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const kept = i == 0 ? 1 : std::exp((times[i - 1] - times[i]) / seconds);
        now = kept * now + std::sqrt(1 - kept * kept) * random.uniform(-1, 1);
        result.push_back(now);
        most = std::max(most, std::abs(now));
    }
    for (double& e : result) e /= most;
    return result;
}

/// As the instrument reads it.
double read(campaign const& c, std::size_t channel, double value) {
    double const step = c.quantum[channel], modulus = c.true_instruments.modulus[channel];
    if (step > 0) value = step * std::round(value / step);
    if (modulus > 0) value -= modulus * std::floor((value - c.lowest) / modulus);
    return six_decimals(value);
}

void add_noise(measured_scenario& s, std::vector<channels> const& truth, shape noise, double reach,
               channels const& factor, channels const& of_value, channels const& slow,
               random_source& random) {
    s.value.assign(s.truth.size(), channels{});
    std::array<std::vector<double>, channel_count> together;
    for (std::size_t k = 0; k < channel_count; ++k)
        if (slow[k] > 0) together[k] = slow_errors(s.plan.sample_times, slow[k], random);
    for (std::size_t i = 0; i < s.truth.size(); ++i)
        for (std::size_t k = 0; k < channel_count; ++k) {
            // Rounding and the integration must not push a sample over its bound.
            double const grown = of_value[k] * std::abs(truth[i][k]);
            double const room = reach * (factor[k] * error_bound[k] + grown) - 2e-6;
            // Where the bound is too small, it is broken often.
            shape const own = factor[k] > 1 || of_value[k] > 0 ? shape::uniform : noise;
            double const error = slow[k] > 0 ? together[k][i] : drawn(own, random);
            s.value[i][k] = six_decimals(truth[i][k] + room * error);
        }
}

/// Single gross errors, some barely over the bound and some huge.
void add_outliers(measured_scenario& s, campaign const& c, random_source& random) {
    std::vector<std::pair<std::size_t, std::size_t>> cells;
    for (std::size_t i = 0; i < s.truth.size(); ++i)
        for (std::size_t const k : c.channels_measured) cells.emplace_back(i, k);
    std::size_t const most = outlier_budget(c.outlier_fraction, cells.size());
    if (most == 0) return;
    random.shuffle(cells);
    s.outliers = most - random.below(most / 2 + 1);
    for (std::size_t n = 0; n < s.outliers; ++n) {
        auto const [i, k] = cells[n];
        double const size =
            error_bound[k] * (random.coin(0.2) ? random.uniform(1.2, 4) : random.uniform(4, 40));
        s.value[i][k] = six_decimals(s.truth[i][k] + random.sign() * size);
    }
}

} // namespace

std::size_t outlier_budget(double fraction, std::size_t samples) {
    auto const hundredths = static_cast<std::size_t>(std::lround(fraction * 100));
    return hundredths * samples / 100;
}

void add_uniform_noise(measured_scenario& s, random_source& random) {
    add_noise(s, s.truth, shape::uniform, 1, {1, 1, 1, 1, 1, 1}, {}, {}, random);
}

void measure(campaign& c, random_source& random) {
    double const kind = random.uniform(0, 1);
    shape const noise = kind < 0.7   ? shape::uniform
                        : kind < 0.8 ? shape::triangular
                        : kind < 0.9 ? shape::bell
                                     : shape::edges;
    c.noise = noise == shape::uniform      ? "uniform"
              : noise == shape::triangular ? "triangular"
              : noise == shape::bell       ? "bell"
                                           : "edges";
    // Bounds are mostly stated with a little reserve, sometimes with none.
    double const reach = random.coin(0.7) ? 0.95 : 1.0;
    if (reach < 1) c.noise += " 0.95";
    for (auto& s : c.scenarios) {
        s.truth = readings(world_of(c, s), s.initial, s.plan.sample_times, careful_step);
        add_noise(s, shown(c, s, random), noise, reach, c.bound_factor, c.noise_of_value, c.slow,
                  random);
        for (auto& y : s.value)
            for (std::size_t k = 0; k < channel_count; ++k) y[k] = read(c, k, y[k]);
        add_outliers(s, c, random);
    }
}

} // namespace withheld
