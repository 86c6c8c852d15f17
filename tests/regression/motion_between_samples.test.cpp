// SPDX-License-Identifier: MIT
// Inputs that move between two samples: the bound on how much a rate varies there was taken from
// the inputs at the samples, and relations that hold were called refuted.
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

#include "../../examples/hovercraft/model.hpp"

using namespace diagnosis_support;

namespace {

constexpr double pi = 3.14159265358979;

struct dither {
    double size, period;         ///< of the rudder's second motion [rad, s]
    double sampling;             ///< time between two measurements [s]
    bool straight_first = false; ///< S1 without a rudder
    double motor = 250;          ///< at most
    interpolation kind = interpolation::linear;
};

sampled_signal on_a_grid(std::function<double(double)> const& f, double duration,
                         interpolation kind) {
    std::vector<double> t, v;
    for (int k = 0; k * 0.02 < duration + 0.03; ++k) {
        t.push_back(k * 0.02);
        v.push_back(f(t.back()));
    }
    return {t, v, kind};
}

/// The hovercraft as modelled in five manoeuvres; only the sensors of x and y are wrong.
identification_problem dithered_craft(draws& d, dither const& how) {
    auto const model = record_model<hovercraft>();
    identification_problem problem{
        model,
        {{"Sv", "Sg", "L"}, {}},
        box{between(0.2, 0.25), between(0.0042, 0.0754), between(0.25, 0.35)},
        {}};
    std::vector<double> constants;
    for (auto const& c : model.about.constants) constants.push_back(c.nominal.nearest);
    auto const value = [&](char const* name, double v) {
        constants[index_of(model.about.constants, name, "constant")] = v;
    };
    value("Sv", d.uniform(0.205, 0.245));
    value("Sg", d.uniform(0.03, 0.05));
    value("L", d.uniform(0.26, 0.34));
    struct plan {
        double duration, u;
        std::function<double(double)> motor, rudder;
    };
    std::vector<plan> const plans{
        {1, 0.1, [](double) { return 250; }, [](double) { return 0; }},
        {10, 2, [](double) { return 0; }, [](double) { return 0; }},
        {3, 2, [](double) { return 83; },
         [](double t) { return 0.2617994 * (1 + std::sin(pi / 2 * t)); }},
        {6, 1, [](double) { return 90; }, [](double t) { return 0.35 * std::sin(1.2 * t); }},
        {6, 0.5, [](double t) { return 100 + 30 * std::sin(0.9 * t); },
         [](double t) { return -0.1 + 0.25 * std::sin(0.7 * t + 0.6); }}};
    std::vector<double> const error{0.02, 0.02, 0.05, 0.02, 0.02, 0.03};
    for (std::size_t s = 0; s < plans.size(); ++s) {
        auto const& p = plans[s];
        double const size = s == 0 && how.straight_first ? 0 : how.size;
        std::vector<sampled_signal> const inputs{
            on_a_grid([&](double t) { return std::min(p.motor(t), how.motor); }, p.duration,
                      how.kind),
            on_a_grid(
                [&](double t) { return p.rudder(t) + size * std::sin(2 * pi / how.period * t); },
                p.duration, how.kind)};
        auto const motion = simulate(model, constants, inputs, {p.u, 0, 0, 0, 0, 0}, p.duration);
        experiment e;
        for (std::size_t y = 0; y < 6; ++y) {
            auto one = measured(d, support::numbered('S', s + 1), motion, inputs, {y}, error[y],
                                noise::uniform, {}, how.sampling);
            for (auto& m : one.measurements) {
                if (y == 3 || y == 4) m.bound = around(mid(m.bound) * 1.12, error[y]);
            }
            if (y == 0) {
                e = std::move(one);
            } else {
                e.measurements.insert(e.measurements.end(), one.measurements.begin(),
                                      one.measurements.end());
            }
        }
        problem.experiments.push_back(std::move(e));
    }
    return problem;
}

/// Proved relations in whose row no faulty sensor stands.
std::string false_proofs(identification_problem const& problem,
                         std::vector<std::string> const& faulty) {
    std::string names;
    for (auto const& f : find_broken_relations(problem)) {
        bool const excused = std::any_of(f.channels.begin(), f.channels.end(), [&](auto const& c) {
            return std::find(faulty.begin(), faulty.end(), c) != faulty.end();
        });
        if (!excused) names += f.name + " ";
    }
    return names;
}

} // namespace

TEST_CASE("a rudder that moves between the samples refutes no equation that holds") {
    draws d(501);
    std::vector<dither> const attacks{{0.3, 0.7, 0.5},
                                      {0.3, 0.7, 0.5, true, 130},
                                      {0.1, 0.5, 0.5},
                                      {0.4, 0.5, 0.5},
                                      {0.4, 0.5, 0.5, true},
                                      {0.4, 0.2, 0.2},
                                      {0.4, 0.2, 0.2, true},
                                      {0.4, 0.1, 0.1},
                                      {0.3, 1.0, 0.5},
                                      {0, 1, 0.5},
                                      {0.4, 0.5, 0.5, false, 250, interpolation::hold},
                                      {0.3, 0.14, 0.1, false, 250, interpolation::hold}};
    for (auto const& how : attacks) {
        INFO("rudder " << how.size << " rad, period " << how.period << " s, samples every "
                       << how.sampling << " s");
        CHECK(false_proofs(dithered_craft(d, how), {"x", "y"}) == "");
    }
}

TEST_CASE("a force that comes and goes between the samples refutes nothing of a small model") {
    // Velocity and position under a known force of the samples' own period.
    auto const model = support::model_of(
        {2, 2, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            using T = std::decay_t<decltype(x[0])>;
            return std::vector<T>{x[1], p[0] * u[0] - p[1] * x[1]};
        });
    draws d(502);
    for (int n = 0; n < 24; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        double const period = n % 3 == 0 ? 0.5 : n % 3 == 1 ? 0.25 : 0.7;
        double const phase = d.uniform(0, 6);
        double const size = d.uniform(2, 20);
        std::vector<sampled_signal> const inputs{on_a_grid(
            [&](double t) { return size * std::sin(2 * pi / period * t + phase); }, 6, kind)};
        std::vector<double> const p{d.uniform(0.6, 1.9), d.uniform(0.1, 0.9)};
        auto const motion = simulate(model, p, inputs, {0, d.uniform(-1, 1)}, 6);
        identification_problem problem{
            model, {support::all_constants(2), {}}, box{between(0.5, 2), between(0, 1)}, {}};
        problem.experiments.push_back(
            measured(d, "S", motion, inputs, {0, 1}, 0.005, noise::uniform, {}, 0.5));
        INFO("force " << size << ", period " << period << " s");
        CHECK(false_proofs(problem, {}) == "");
    }
}
