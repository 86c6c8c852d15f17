// SPDX-License-Identifier: MIT
// A slide that sticks, or meets an end stop, and whose model knows neither: the right-hand side of
// the missing effect jumps, or has a kink.
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/model/effects.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

/// q' = v, v' = a F - b v.
struct slide {
    static constexpr auto name = "slide";
    static constexpr auto states = sivid::states({{"q", "m", 2}, {"v", "m/s", 4}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"q", "m"}, {"v", "m/s"}});
    static constexpr auto constants = sivid::constants({{"a", "1/kg", 1_dec}, {"b", "1/s", 1_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 2> const& c, vec<T, 1> const& u) const {
        return {x[1], c[0] * u[0] - c[1] * x[1]};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 2> const& x, vec<T, 2> const&, vec<T, 1> const&) const {
        return {x[0], x[1]};
    }
};

struct truth {
    double friction = 0, stiffness = 0, stop = 0.3;
    double lugre = 0, more_at_rest = 0.5; ///< with bristles that bend by 0.02 m
};

double sqr_of(double x) { return x * x; }

/// Four seconds at 50 Hz under a force that swings, in steps of 10 us; the slide rests as long as
/// the force is weaker than the friction.
experiment record_of(truth const& missing, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> noise(-0.9, 0.9);
    double q = 0, v = 0, z = 0;
    std::vector<double> times, force;
    experiment e{"S" + std::to_string(seed), {}, 0, {interval(0.0), interval(0.0)}, {}};
    auto const push = [&](double t) {
        return 3 * std::sin((1.1 + 0.2 * seed) * t) + 1.5 * std::sin(2.3 * t + seed);
    };
    constexpr double h = 1e-5;
    for (int k = 0; k <= 200; ++k) {
        double const t = 0.02 * k;
        times.push_back(t);
        force.push_back(push(t));
        double const seen[] = {q + 1e-3 * noise(random), v + 5e-3 * noise(random)};
        e.measurements.push_back({t, 0, interval(seen[0] - 1e-3, seen[0] + 1e-3)});
        e.measurements.push_back({t, 1, interval(seen[1] - 5e-3, seen[1] + 5e-3)});
        double const next = push(t + 0.02);
        for (int s = 0; s < 2000; ++s) {
            double const u = force.back() + (next - force.back()) * (s + 0.5) / 2000;
            double rate = 1.2 * u - 0.8 * v - missing.stiffness * std::max(q - missing.stop, 0.0);
            double const g = 1 + missing.more_at_rest * std::exp(-sqr_of(v / 0.2));
            double const bend = (v - std::abs(v) * z / g) / 0.02;
            rate -= missing.lugre * (z + 0.02 * bend);
            z += h * bend;
            double const k_f = missing.friction;
            double const before = v;
            if (v == 0) {
                rate = rate > k_f ? rate - k_f : rate < -k_f ? rate + k_f : 0;
                v += h * rate;
            } else {
                v += h * (rate - (v > 0 ? k_f : -k_f));
                if (k_f > 0 && v * before < 0) v = 0;
            }
            q += h * (before + v) / 2;
        }
    }
    e.inputs.push_back(sampled_signal(times, force, interpolation::linear));
    return e;
}

/// @param share  how much of the prior of k may be left
void find(truth const& missing, std::string const& name, double size, double share) {
    identification_problem problem{
        record_model<slide>(), {{"a", "b"}, {}}, {interval(0.5, 2), interval(0.2, 2)}, {}};
    for (unsigned seed : {1U, 2U}) problem.experiments.push_back(record_of(missing, seed));
    std::vector<sivid::effect> const catalogue{
        effects::dry_friction("dry_friction", "v", "m/s^2", {0_dec, 3_dec}, 0_dec),
        effects::end_stop("end_stop", "q", "v", "1/s^2", {0_dec, 100_dec}, 0.3_dec,
                          effects::stop_side::upper),
        effects::lugre_friction("lugre", "v", "m/s^2", {0_dec, 3_dec}, {0_dec, 2_dec}, 0.2_dec,
                                0.02_dec, 0.02_dec),
        effects::constant_rate("offset", "v", "m/s^2", {-3_dec, 3_dec}),
        effects::quadratic_damping("quadratic_damping", "v", "1/m", {0_dec, 3_dec})};
    diagnosis_options options;
    options.seconds = 120; // a slow machine needs them; the work is limited by the boxes
    options.hulls.boxes = 64;
    auto const d = diagnose(std::move(problem), catalogue, options).result;
    INFO(d.seconds << " s");
    for (auto const& c : find_contradictions(d)) FAIL_CHECK(c.claim + ": " + c.reason);
    CHECK(d.gap == gap_verdict::certified);
    CHECK(d.effects == std::vector<std::string>{name});
    CHECK(d.constants_verified);
    for (auto const& c : d.constants) {
        if (c.name != name + ".k") continue;
        REQUIRE(c.hull);
        REQUIRE(c.prior);
        CAPTURE(c.value, c.hull->lower(), c.hull->upper());
        CHECK(std::abs(c.value - size) < 0.02 * size);
        CHECK(c.hull->lower() <= size);
        CHECK(c.hull->upper() >= size);
        CHECK(width(*c.hull) <= share * width(*c.prior));
    }
}

} // namespace

TEST_CASE("a slide that sticks is diagnosed, its friction bounded with proof") {
    find({0.9, 0, 0.3}, "dry_friction", 0.9, 0.05);
}

TEST_CASE("a slide that meets an end stop is diagnosed, its stiffness bounded with proof") {
    find({0, 40, 0.3}, "end_stop", 40, 0.02);
}

TEST_CASE("a slide on bristles is diagnosed, its friction bounded with proof") {
    find({0, 0, 0.3, 0.9}, "lugre", 0.9, 0.05);
}
