// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/model/effects.hpp>

#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// A geared motor whose angle an encoder shows: theta' = w, w' = a u - b w.
struct motor {
    static constexpr auto name = "motor";
    static constexpr auto states = sivid::states({{"theta", "rad", 100}, {"w", "rad/s", 50}});
    static constexpr auto inputs = sivid::inputs({{"u", "V"}});
    static constexpr auto channels = sivid::channels({{"theta", "rad"}});
    static constexpr auto constants =
        sivid::constants({{"a", "rad/(s^2 V)", 10_dec}, {"b", "1/s", 5_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {x[1], c[0] * u[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};

/// What its record has, and the model has not.
using missing = double (*)(double w);
double friction(double w) { return 3 * w / std::sqrt(w * w + 0.0025); }
double drag(double w) { return 0.2 * w * std::abs(w); }

/// So many seconds at 1 kHz, the voltage held for 20 ms, noise that fills its bound of 2 mrad.
experiment record_of(missing effect, int seconds, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> noise(-0.999, 0.999);
    double theta = 0, w = 0, u = 0;
    std::vector<double> times, volts;
    experiment e{
        "log " + std::to_string(seed), {}, 0, {interval(-0.002, 0.002), interval(0.0)}, {}};
    for (int k = 0; k <= 1000 * seconds; ++k) {
        double const t = 0.001 * k;
        if (k % 20 == 0) {
            u = 6 * std::sin(0.7 * t + seed) + 4 * std::sin(2.9 * t) +
                (std::sin(0.31 * t * (1 + 0.1 * seed)) > 0 ? 3 : -3);
            times.push_back(t);
            volts.push_back(u);
        }
        double const seen = theta + 0.002 * noise(random);
        e.measurements.push_back({t, 0, interval(seen - 0.002, seen + 0.002)});
        for (int s = 0; s < 4; ++s) { // Runge and Kutta's method
            double const h = 0.00025;
            auto const rate = [&](double v) { return 10 * u - 5 * v - effect(v); };
            double const a1 = rate(w), w2 = w + h / 2 * a1, a2 = rate(w2), w3 = w + h / 2 * a2,
                         a3 = rate(w3), w4 = w + h * a3, a4 = rate(w4);
            theta += h / 6 * (w + 2 * w2 + 2 * w3 + w4);
            w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
    }
    e.inputs.push_back(sampled_signal(times, volts, interpolation::hold));
    return e;
}

void find(missing effect, std::string const& name, double size, int seconds, double budget) {
    identification_problem problem{
        record_model<motor>(), {{"a", "b"}, {}}, {interval(5, 20), interval(1, 10)}, {}};
    problem.experiments.push_back(record_of(effect, seconds, 1));
    std::vector<sivid::effect> const catalogue{
        effects::dry_friction("dry_friction", "w", "rad/s^2", {0_dec, 10_dec}, 0.05_dec),
        effects::constant_rate("offset", "w", "rad/s^2", {-5_dec, 5_dec}),
        effects::quadratic_damping("quadratic_damping", "w", "1/rad", {0_dec, 1_dec}),
        effects::input_dead_band("dead_band", "u", "V", {0_dec, 2_dec})};
    diagnosis_options options;
    options.seconds = budget;
    options.hulls.boxes = 8; // nothing here asks for them
    auto const d = diagnose(std::move(problem), catalogue, options).result;
    INFO(d.seconds << " s");
    if (support::long_sweeps) CHECK(d.seconds < 1.05 * budget + 2);
    for (auto const& c : find_contradictions(d)) FAIL_CHECK(c.claim + ": " + c.reason);
    CHECK(d.gap == gap_verdict::certified);
    CHECK(d.answer == answer_kind::effects);
    CHECK(d.effects == std::vector<std::string>{name});
    CHECK(d.constants_verified);
    bool found = false;
    for (auto const& c : d.constants) {
        if (c.name != name + ".k") continue;
        found = true;
        CHECK(std::abs(c.value - size) < 0.01 * size);
    }
    CHECK(found);
}

} // namespace

TEST_CASE("a log at 1 kHz is diagnosed whole") {
    find(friction, "dry_friction", 3, 13, 60); // more samples than fits look at first
}

TEST_CASE("logs of two minutes at 1 kHz are diagnosed whole in two minutes", "[.long]") {
    find(friction, "dry_friction", 3, 120, 120);
    find(drag, "quadratic_damping", 0.2, 120, 120);
}
