// SPDX-License-Identifier: MIT
// The engine on the problems of the literature: time, steps, width over the sampled true range,
// containment of sampled trajectories. One thread; the least time of several runs.
#include "hovercraft/model.hpp"
#include "measure.hpp"
#include "points.hpp"
#include "problems.hpp"
#include "sensitivities.hpp"

#include <sivid/enclosure/enclose.hpp>
#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using benchmark::measure;
using benchmark::problem;
using benchmark::seconds_since;
using sivid::box;
using sivid::interval;
using sivid::lanes;

/// The inputs of scenario 3: by their formulas, or (rate > 0) sampled.
std::vector<sivid::signal> scenario_3(double rate, sivid::interpolation between) {
    if (rate > 0) {
        std::vector<double> times, speed, rudder;
        for (int k = 0; k <= static_cast<int>(3 * rate); ++k) {
            times.push_back(k / rate);
            speed.push_back(250.0 / 3);
            rudder.push_back(0.2617993877991494 * (1 + std::sin(1.5707963267948966 * k / rate)));
        }
        return {sivid::sampled_signal(times, speed, between),
                sivid::sampled_signal(times, rudder, between)};
    }
    interval const pi(3.141592653589793, 3.1415926535897936);
    return {sivid::analytic_signal::from([](auto const&) { return 250 / sivid::expression(3); }),
            sivid::analytic_signal::from([pi](auto const& t) {
                using sivid::expression;
                return expression(pi) / 12 * (1 + sin(expression(pi) * t / 2));
            })};
}

problem hovercraft_problem(std::string name, double w, double rate = 0,
                           sivid::interpolation between = sivid::interpolation::linear) {
    double const truth[3]{0.22, 0.04, 0.30};
    box p(3);
    for (std::size_t j = 0; j < 3; ++j) {
        p[j] = interval(truth[j] * (1 - w / 2), truth[j] * (1 + w / 2));
    }
    if (w < 0) p = box{interval(0.20, 0.25), interval(0.0042, 0.0754), interval(0.25, 0.35)};
    return {std::move(name),
            std::make_shared<sivid::flow const>(sivid::record_model(hovercraft{}),
                                                sivid::parameter_choice{{"Sv", "Sg", "L"}, {}},
                                                scenario_3(rate, between)),
            sivid::point_box({2, 0, 0, 0, 0, 0}), p, 3};
}

/// Scenario 2: coasting from 2 m/s to standstill, with the motor off; dry friction and mass within
/// relative widths w about their nominal values.
problem standstill(double w) {
    auto const off = sivid::analytic_signal::from([](auto const&) { return sivid::expression(0); });
    auto const about = [w](double c) { return interval(c * (1 - w / 2), c * (1 + w / 2)); };
    return {"S2 w=" + std::to_string(w).substr(0, 4),
            std::make_shared<sivid::flow const>(sivid::record_model(hovercraft{}),
                                                sivid::parameter_choice{{"Ff", "m"}, {}},
                                                std::vector<sivid::signal>{off, off}),
            sivid::point_box({2, 0, 0, 0, 0, 0}), box{about(0.5), about(1.297)}, 10};
}

template <class Model>
problem autonomous(std::string name, box initial, double end, sivid::parameter_choice choice = {},
                   box parameters = box(), Model const& model = {}) {
    return {std::move(name),
            std::make_shared<sivid::flow const>(sivid::record_model(model), choice,
                                                std::vector<sivid::signal>{}),
            std::move(initial), std::move(parameters), end};
}

/// The quadrotor has to rise from 0 to 1 m: below 1.4 m always, above 0.9 m from 1 s on, within
/// [0.98, 1.02] m at 5 s; positions and velocities uncertain by `delta`.
problem quadrotor_problem(double delta) {
    box x(12);
    for (std::size_t i = 0; i < 6; ++i) x[i] = interval(-delta, delta);
    return autonomous<problems::quadrotor>("quadrotor delta=" + std::to_string(delta).substr(0, 3),
                                           x, 5);
}
void prove_height(std::size_t degree, problem const& p, benchmark::setting const& s) {
    if (!benchmark::asked.wants(p.name)) return;
    sivid::parametric_flow<> run(*p.flow, s.options(), 6, degree);
    run.begin(0, p.initial, p.parameters);
    bool below = true, above = true;
    for (double const stop : {1.0, p.end}) {
        while (run.time() < stop) {
            double const from = run.time();
            if (!run.step(stop)) {
                std::printf("  not enclosed: %s\n", run.failure()->message("x").c_str());
                return;
            }
            auto const height = run.swept()[2];
            below = below && height.upper() < 1.4;
            above = above && (from < 1 || height.lower() > 0.9);
        }
    }
    auto const last = run.set().hull()[2];
    bool const reached = last.lower() >= 0.98 && last.upper() <= 1.02;
    std::printf("  height at 5 s in [%.5f, %.5f], always below 1.4 m: %s, above 0.9 m from 1 s on: "
                "%s, within 2 cm: %s\n",
                last.lower(), last.upper(), below ? "proved" : "no", above ? "proved" : "no",
                reached ? "proved" : "no");
}

/// One method on the stiff relaxation: steps, and the longest against the time constant 1/k.
void measure_stiff(std::string const& name, std::optional<sivid::tableau> const& method) {
    if (!benchmark::asked.wants("relaxation")) return;
    auto const p = autonomous<problems::relaxation>("relaxation", sivid::point_box({1.4, 0}), 5);
    sivid::enclosure_options options;
    options.method = method;
    options.tolerance = 1e-6;
    options.maximum_steps = 5000;
    auto const begin = std::chrono::steady_clock::now();
    auto const tube =
        sivid::integrate<interval>(p.flow, p.initial, p.parameters, 0, p.end, options);
    double const ms = 1e3 * seconds_since(begin);
    double longest = 0;
    for (auto const& s : tube.steps()) longest = std::max(longest, s.to - s.from);
    std::printf("relaxation k=1e4, T=5, %-14s %8.1f ms %5zu steps, longest %.3g / k, ",
                name.c_str(), ms, tube.steps().size(), 1e4 * longest);
    if (tube.complete()) {
        std::printf("width %.1e\n",
                    std::max(sivid::width(tube.end().hull[0]), sivid::width(tube.end().hull[1])));
    } else {
        std::printf("stopped at t = %.3g\n", tube.end_time());
    }
    std::fflush(stdout);
}

} // namespace

/// Usage: sivid_benchmark_enclosure [--more] [part of a problem's name]
namespace {

/// What a motion by Taylor models says of a time between its steps.
void measure_dense_output(benchmark::problem const& p) {
    if (!benchmark::asked.wants(p.name)) return;
    sivid::enclosure_options options;
    options.tolerance = 1e-7;
    auto const enclosed = [&] {
        return sivid::enclose(p.flow, p.initial, p.parameters, 0, p.end,
                              sivid::carried_set::taylor_model, options);
    };
    auto const motion = enclosed();
    int const looks = 40;
    double const look = benchmark::least_time([&] {
        for (int k = 0; k < looks; ++k) (void)motion.at(motion.end_time() * (k + 0.5) / looks);
    });
    std::printf("%-26s Taylor enclosed in %7.3f ms, %4zu steps; at a time %6.3f ms\n",
                p.name.c_str(), benchmark::least_time([&] { (void)enclosed(); }),
                motion.spans().size(), look / looks);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) {
        if (std::string(argv[k]) == "--more") {
            benchmark::asked.more = true;
        } else {
            benchmark::asked.only = argv[k];
        }
    }
    std::printf("parts are carried %zu at a time; packs for %s\n\n", std::size_t{8},
                std::string(sivid::pack_target()).c_str());
    using eight = lanes<8>;
    auto const h3 = [](double w) {
        return hovercraft_problem("H3 w=" + std::to_string(w).substr(0, 4), w);
    };

    measure<double>(1, 0, hovercraft_problem("H3-point", 0), {20, 2e-14, 0}, "0.5 ms, 1e-11");
    benchmark::measure_corners(hovercraft_problem("H3, eight points at once", 0.05), {20, 2e-14, 0},
                               "1 ms");
    measure<double>(3, 2, h3(0.01), {8, 1e-7, 1e-4}, "0.5 ms, 1.005");
    measure<double>(3, 3, h3(0.05), {8, 3e-6, 1e-4}, "0.5 ms, 1.02");
    measure<eight>(3, 2, h3(0.05), {6, 1e-5, 1e-4, 3}, "0.2 ms a box");
    measure<double>(3, 3, h3(0.1), {6, 1e-6, 1e-4}, "0.8 ms, 1.05");
    measure<double>(3, 4, h3(0.2), {8, 1e-5, 1e-4}, "2 ms, 1.07");
    measure<eight>(3, 3, h3(0.2), {6, 1e-5, 1e-4, 3}, "2 ms, 1.07");
    measure<eight>(3, 4, h3(0.3), {8, 1e-5, 1e-4, 3}, "10 ms, 1.02");
    measure<eight>(3, 4, hovercraft_problem("H3 whole prior", -1), {6, 1e-5, 1e-4, 0, 1e-2},
                   "16 parts, 60 ms");

    std::printf("\n");
    benchmark::sensitivities_at_a_point(hovercraft_problem("H3-point, sensitivities", 0));
    benchmark::sensitivities_over_a_box(3, 2, hovercraft_problem("H3 w=0.01, sensitivities", 0.01),
                                        {8, 1e-6, 1e-4});
    benchmark::sensitivities_over_a_box(3, 3, hovercraft_problem("H3 w=0.05, sensitivities", 0.05),
                                        {6, 1e-5, 1e-4});
    std::printf("\n");

    auto const vdp = autonomous<problems::van_der_pol>(
        "van der Pol T=7", box{interval(1.25, 1.55), interval(2.35, 2.45)}, 7);
    measure<double>(2, 4, vdp, {10, 1e-6, 1e-4}, "1 ms, 1.02");
    measure<double>(2, 6, vdp, {10, 1e-6, 1e-4}, "1 ms, 1.02");

    auto const loomis = [](double w) {
        double const centre[7]{1.2, 1.05, 1.5, 2.4, 1, 0.1, 0.45};
        box x(7);
        for (std::size_t i = 0; i < 7; ++i) x[i] = interval(centre[i] - w, centre[i] + w);
        return autonomous<problems::laub_loomis>("Laub-Loomis W=" + std::to_string(w).substr(0, 4),
                                                 x, 20);
    };
    measure<double>(7, 2, loomis(0.01), {12, 1.5e-6, 3e-4}, "2 ms, 1.06");
    measure<double>(7, 3, loomis(0.05), {12, 1.5e-6, 3e-4}, "8 ms, 1.06");
    measure<double>(7, 4, loomis(0.1), {8, 1e-5, 1e-4}, "15 ms, 1.19");
    measure_dense_output(loomis(0.01));

    for (double const end : {10.0, 20.0}) {
        measure<double>(
            1, 0,
            autonomous<problems::lorenz>("Lorenz T=" + std::to_string(static_cast<int>(end)),
                                         sivid::point_box({15, 15, 36}), end),
            {28, 1e-17, 0}, end < 15 ? "4 ms, 1.3e-7" : "8 ms, 2.5e-4");
    }
    using namespace sivid::literals;
    for (auto const& [beta, gamma, goal] : {std::tuple{100_dec, 1000_dec, "35 ms, 8.5e-10"},
                                            std::tuple{1000_dec, 100000_dec, "270 ms, 5.9e-9"},
                                            std::tuple{1000_dec, 10000000_dec, "400 ms, 1.8e-8"}}) {
        sivid::parameter_choice c;
        c.fixed["beta"] = sivid::enclose(beta);
        c.fixed["gamma"] = sivid::enclose(gamma);
        measure<double>(
            1, 0, autonomous<problems::robertson>("Robertson", sivid::point_box({1, 0, 0}), 40, c),
            {20, 1e-14, 0, 0, 1e-7}, goal);
    }
    // ARCH-COMP, without its guard: half-widths of 2021 and of 2020.
    for (double const e : {0.008, 0.012}) {
        measure<double>(1, 3,
                        autonomous<problems::lotka_volterra>(
                            "Lotka-Volterra +-" + std::to_string(e).substr(0, 5),
                            box{interval(1.3 - e, 1.3 + e), interval(1.0)}, 3.64),
                        {10, 1e-7, 1e-4}, "published tables");
    }
    for (double const delta : {0.1, 0.4, 0.8}) {
        auto const p = quadrotor_problem(delta);
        measure<double>(6, 2, p, {8, 1e-6, 1e-4, 0, 1e-4}, "published tables");
        prove_height(2, p, {8, 1e-6, 1e-4, 0, 1e-4});
    }
    std::printf("\n");
    measure<double>(2, 3, standstill(0.05), {8, 1e-5, 1e-4}, "1.2");
    if (benchmark::asked.more) measure<double>(2, 4, standstill(0.2), {10, 1e-6, 1e-4}, "1.2");
    measure<eight>(2, 3, standstill(0.2), {8, 1e-5, 1e-4, 5}, "1.2");

    std::printf("\n");
    // Kinks: narrow families, one box each, as functions of the unknowns and as doubletons. Steps
    // across a kink are of first order: the tolerances are small so that they stay short.
    using servo = problems::saturated_servo;
    box const start{interval(-0.001, 0.001), interval(0.0)}, gain{interval(3.998, 4.002)};
    auto const kinked = [&](std::string const& name, servo const& model) {
        auto const p = autonomous<servo>(name, start, 6, {{"gain"}, {}}, gain, model);
        benchmark::setting const s{8, 1e-10, 1e-6, 0, 1e-7};
        measure<double>(2, 3, p, s, "not absurdly wide");
        benchmark::measure_doubleton(p, s, "not absurdly wide");
    };
    kinked("servo without kinks", {false, false});
    kinked("servo, saturation", {true, false});
    kinked("servo, dead band", {false, true});
    kinked("servo, both", {true, true});
    auto const friction = autonomous<problems::dry_friction>(
        "dry friction", box{interval(0.0), interval(0.9996, 1.0004)}, 6, {{"k"}, {}},
        box{interval(0.2498, 0.2502)});
    measure<double>(2, 3, friction, {8, 1e-10, 1e-6, 0, 1e-7}, "not absurdly wide");
    benchmark::measure_doubleton(friction, {8, 1e-10, 1e-6, 0, 1e-7}, "not absurdly wide");

    std::printf("\n");
    // Most of the time goes into simulating the samples.
    auto const asked_samples = [](int rate) -> std::size_t {
        return rate > 20 && !benchmark::asked.more ? 100 : 1000;
    };
    for (int const rate : {20, 200, 1000}) {
        std::size_t const samples = asked_samples(rate);
        auto const p = hovercraft_problem("H3 w=0.05, " + std::to_string(rate) + " Hz", 0.05, rate);
        measure<double>(3, 3, p, {6, 1e-5, 1e-4, 0, 1e-6, samples}, "no collapse");
        if (rate > 20 && !benchmark::asked.more) continue;
        measure<eight>(3, 2, p, {6, 1e-5, 1e-4, 3, 1e-6, samples}, "no collapse");
    }
    // Inputs that are held between their samples: a jump ends every step.
    for (int const rate : {200, 1000}) {
        auto const rated = ", held at " + std::to_string(rate) + " Hz";
        auto const hold = sivid::interpolation::hold;
        measure<double>(1, 0, hovercraft_problem("H3-point" + rated, 0, rate, hold),
                        {20, 2e-14, 0, 0, 1e-6}, "no collapse");
        measure<double>(3, 3, hovercraft_problem("H3 w=0.05" + rated, 0.05, rate, hold),
                        {6, 1e-5, 1e-4, 0, 1e-6, asked_samples(rate)}, "no collapse");
    }
    std::printf("\n");
    measure_stiff("Radau IIA 5", sivid::radau_iia5());
    measure_stiff("Gauss 6", sivid::gauss6());
    measure_stiff("Gauss 4", sivid::gauss4());
    measure_stiff("Lobatto IIIC 6", sivid::lobatto_iiic6());
    measure_stiff("RK4", sivid::rk4());
    measure_stiff("Taylor", std::nullopt);
    return 0;
}
