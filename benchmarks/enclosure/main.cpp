// SPDX-License-Identifier: MIT
// The engine on the problems of the literature: time, steps, width over the sampled true range,
// containment of sampled trajectories. One thread; the least time of several runs.
#include "hovercraft/model.hpp"
#include "problems.hpp"

#include <sivid/enclosure/implicit_tableau.hpp>
#include <sivid/enclosure/parametric_cover.hpp>
#include <sivid/enclosure/simulate.hpp>
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
#include <vector>

namespace {

using sivid::box;
using sivid::interval;
using sivid::lanes;

struct problem {
    std::string name;
    std::shared_ptr<sivid::flow const> flow;
    box initial, parameters;
    double end = 1;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double inside(interval const& x, double share) {
    return x.lower() + share * (x.upper() - x.lower());
}

/// Range of the ends of sampled trajectories, corners included, and how many leave the parts' sets.
struct sampled {
    std::vector<double> low, high;
    std::size_t missed = 0;
    std::size_t drawn = 0;
};

template <class Cover>
sampled sample(problem const& p, Cover const& cover, std::size_t count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    sivid::approximate_simulator simulate(*p.flow);
    auto const n = p.initial.size();
    auto const wide = n + p.parameters.size();
    sampled s;
    s.low.assign(n, HUGE_VAL);
    s.high.assign(n, -HUGE_VAL);
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<double> x0, c;
        for (std::size_t i = 0; i < wide; ++i) {
            auto const& side = i < n ? p.initial[i] : p.parameters[i - n];
            double const share = k < 256 ? static_cast<double>((k >> (i % 8)) & 1U) : unit(random);
            (i < n ? x0 : c).push_back(inside(side, share));
        }
        auto const end = simulate(x0, c, 0, {p.end}, 1e-11).states.back();
        bool found = false, inside_one = false;
        for (auto const& part : cover.parts) {
            bool member = true;
            for (std::size_t i = 0; i < n; ++i) member = member && contains(part.initial[i], x0[i]);
            for (std::size_t j = 0; j < c.size(); ++j) {
                member = member && contains(part.parameters[j], c[j]);
            }
            if (!member) continue;
            found = true;
            auto const hull = part.set.hull();
            bool all = true;
            for (std::size_t i = 0; i < n; ++i) {
                double const slack = 1e-8 * (1 + std::abs(end[i])); // of the simulation
                all = all && hull[i].lower() - slack <= end[i] && end[i] <= hull[i].upper() + slack;
            }
            inside_one = inside_one || all;
        }
        s.missed += found && !inside_one ? 1 : 0;
        ++s.drawn;
        for (std::size_t i = 0; i < n; ++i) {
            s.low[i] = std::min(s.low[i], end[i]);
            s.high[i] = std::max(s.high[i], end[i]);
        }
    }
    return s;
}

/// An independent enclosure of the same point must meet this one.
std::string meets_doubleton(problem const& p, box const& hull) {
    sivid::enclosure_options options;
    options.order = 20;
    options.tolerance = 1e-14;
    options.relative_tolerance = 0;
    auto const tube =
        sivid::integrate<interval>(p.flow, p.initial, p.parameters, 0, p.end, options);
    if (!tube.complete()) return "the doubleton failed";
    double widest = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (sivid::disjoint(hull[i], tube.end().hull[i])) return "DISJOINT FROM THE DOUBLETON";
        widest = std::max(widest, sivid::width(tube.end().hull[i]));
    }
    char text[64];
    std::snprintf(text, sizeof text, "meets the doubleton (%.1e)", widest);
    return text;
}

struct setting {
    std::size_t order = 8;
    double tolerance = 1e-5, relative = 1e-4;
    std::size_t halvings = 0;
    double minimum_step = 1e-3;
};

char const* only = nullptr;

template <std::size_t N, std::size_t D, class C>
void measure(problem const& p, setting const& s, std::string const& goal) {
    constexpr std::size_t width = sivid::lane_traits<C>::count;
    if (only != nullptr && p.name.find(only) == std::string::npos) return;
    sivid::enclosure_options options;
    options.order = s.order;
    options.tolerance = s.tolerance;
    options.relative_tolerance = s.relative;
    options.minimum_step = s.minimum_step;
    sivid::cover_options const choice{.first_halvings = s.halvings};
    sivid::parametric_cover<N, D> result;
    double best = HUGE_VAL;
    double total = 0;
    for (int run = 0; run < 25 && (run < 3 || total < 1); ++run) {
        auto const begin = std::chrono::steady_clock::now();
        result = sivid::cover<N, D, C>(*p.flow, options, p.initial, p.parameters, 0, p.end, choice);
        double const t = seconds_since(begin);
        best = std::min(best, t);
        total += t;
    }
    std::size_t steps = 0;
    for (auto const& part : result.parts) steps = std::max(steps, part.steps);
    std::printf("%-26s D%zu K%-2zu x%zu %9.3f ms %4zu steps %3zu parts %2zu failed  ",
                p.name.c_str(), D, s.order, width, 1e3 * best, steps, result.parts.size(),
                result.failed);
    if (!result.complete()) {
        std::printf("not enclosed: %s  [%s]\n", result.failure->message("x").c_str(), goal.c_str());
        return;
    }
    auto const hull = result.hull();
    double widest = 0, over = 0;
    for (auto const& x : hull) widest = std::max(widest, sivid::width(x));
    bool const point = sivid::normalised_unknowns(p.initial, p.parameters).variables == 0;
    if (point) {
        std::printf("width %.1e, %s  [%s]\n", widest, meets_doubleton(p, hull).c_str(),
                    goal.c_str());
    } else {
        auto const seen = sample(p, result, 1000);
        for (std::size_t i = 0; i < hull.size(); ++i) {
            over = std::max(over, sivid::width(hull[i]) / (seen.high[i] - seen.low[i]));
        }
        std::printf("%.4f x the sampled range, %zu of %zu missed  [%s]\n", over, seen.missed,
                    seen.drawn, goal.c_str());
    }
    std::fflush(stdout);
}

problem hovercraft_problem(std::string name, double w) {
    interval const pi(3.141592653589793, 3.1415926535897936);
    std::vector<sivid::signal> inputs;
    inputs.push_back(
        sivid::analytic_signal::from([](auto const&) { return 250 / sivid::expression(3); }));
    inputs.push_back(sivid::analytic_signal::from([pi](auto const& t) {
        using sivid::expression;
        return expression(pi) / 12 * (1 + sin(expression(pi) * t / 2));
    }));
    double const truth[3]{0.22, 0.04, 0.30};
    box p(3);
    for (std::size_t j = 0; j < 3; ++j) {
        p[j] = interval(truth[j] * (1 - w / 2), truth[j] * (1 + w / 2));
    }
    if (w < 0) p = box{interval(0.20, 0.25), interval(0.0042, 0.0754), interval(0.25, 0.35)};
    return {std::move(name),
            std::make_shared<sivid::flow const>(sivid::record_model(hovercraft{}),
                                                sivid::parameter_choice{{"Sv", "Sg", "L"}, {}},
                                                inputs),
            sivid::point_box({2, 0, 0, 0, 0, 0}), p, 3};
}

template <class Model>
problem autonomous(std::string name, box initial, double end, sivid::parameter_choice choice = {}) {
    return {std::move(name),
            std::make_shared<sivid::flow const>(sivid::record_model(Model{}), choice,
                                                std::vector<sivid::signal>{}),
            std::move(initial), box(), end};
}

/// One method on the stiff relaxation: steps, and the longest against the time constant 1/k.
void measure_stiff(std::string const& name, std::optional<sivid::tableau> const& method) {
    if (only != nullptr && std::string("relaxation").find(only) == std::string::npos) return;
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

/// Usage: sivid_benchmark_enclosure [part of a problem's name]
int main(int argc, char** argv) {
    if (argc > 1) only = argv[1];
    std::printf("parts are carried %zu at a time; packs for %s\n\n", std::size_t{8},
                std::string(sivid::pack_target()).c_str());
    using eight = lanes<8>;
    auto const h3 = [](double w) {
        return hovercraft_problem("H3 w=" + std::to_string(w).substr(0, 4), w);
    };

    measure<1, 0, double>(hovercraft_problem("H3-point", 0), {20, 2e-14, 0}, "0.5 ms, 1e-11");
    measure<3, 2, double>(h3(0.01), {8, 1e-6, 1e-4}, "0.5 ms, 1.005");
    measure<3, 3, double>(h3(0.05), {6, 1e-5, 1e-4}, "0.5 ms, 1.02");
    measure<3, 2, eight>(h3(0.05), {6, 1e-5, 1e-4, 3}, "0.2 ms a box");
    measure<3, 3, double>(h3(0.1), {6, 1e-5, 1e-4}, "0.8 ms, 1.05");
    measure<3, 4, double>(h3(0.2), {8, 1e-5, 1e-4}, "2 ms, 1.07");
    measure<3, 3, eight>(h3(0.2), {6, 1e-5, 1e-4, 3}, "2 ms, 1.07");
    measure<3, 4, eight>(h3(0.3), {8, 1e-5, 1e-4, 3}, "10 ms, 1.02");
    measure<3, 4, eight>(hovercraft_problem("H3 whole prior", -1), {8, 1e-5, 1e-4, 3},
                         "16 parts, 60 ms");

    auto const vdp = autonomous<problems::van_der_pol>(
        "van der Pol T=7", box{interval(1.25, 1.55), interval(2.35, 2.45)}, 7);
    measure<2, 4, double>(vdp, {10, 1e-6, 1e-4}, "1 ms, 1.02");
    measure<2, 6, double>(vdp, {10, 1e-6, 1e-4}, "1 ms, 1.02");

    auto const loomis = [](double w) {
        double const centre[7]{1.2, 1.05, 1.5, 2.4, 1, 0.1, 0.45};
        box x(7);
        for (std::size_t i = 0; i < 7; ++i) x[i] = interval(centre[i] - w, centre[i] + w);
        return autonomous<problems::laub_loomis>("Laub-Loomis W=" + std::to_string(w).substr(0, 4),
                                                 x, 20);
    };
    measure<7, 2, double>(loomis(0.01), {8, 1e-6, 1e-4}, "2 ms, 1.06");
    measure<7, 3, double>(loomis(0.05), {8, 1e-6, 1e-4}, "8 ms, 1.055");
    measure<7, 4, double>(loomis(0.1), {8, 1e-5, 1e-4}, "15 ms, 1.19");

    for (double const end : {10.0, 20.0}) {
        measure<1, 0, double>(
            autonomous<problems::lorenz>("Lorenz T=" + std::to_string(static_cast<int>(end)),
                                         sivid::point_box({15, 15, 36}), end),
            {24, 1e-15, 0}, end < 15 ? "4 ms, 1.3e-7" : "8 ms, 2.5e-4");
    }
    using namespace sivid::literals;
    for (auto const& [beta, gamma, goal] : {std::tuple{100_dec, 1000_dec, "35 ms, 8.5e-10"},
                                            std::tuple{1000_dec, 100000_dec, "270 ms, 5.9e-9"},
                                            std::tuple{1000_dec, 10000000_dec, "400 ms, 1.8e-8"}}) {
        sivid::parameter_choice c;
        c.fixed["beta"] = sivid::enclose(beta);
        c.fixed["gamma"] = sivid::enclose(gamma);
        measure<1, 0, double>(
            autonomous<problems::robertson>("Robertson", sivid::point_box({1, 0, 0}), 40, c),
            {20, 1e-14, 0, 0, 1e-7}, goal);
    }
    measure<1, 3, double>(
        autonomous<problems::lotka_volterra>(
            "Lotka-Volterra", box{interval(1.3 - 0.012, 1.3 + 0.012), interval(1.0)}, 3.64),
        {10, 1e-7, 1e-4}, "published tables");
    std::printf("\n");
    measure_stiff("Radau IIA 5", sivid::radau_iia5());
    measure_stiff("Gauss 6", sivid::gauss6());
    measure_stiff("Gauss 4", sivid::gauss4());
    measure_stiff("Lobatto IIIC 6", sivid::lobatto_iiic6());
    measure_stiff("RK4", sivid::rk4());
    measure_stiff("Taylor", std::nullopt);
    return 0;
}
