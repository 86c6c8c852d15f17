// SPDX-License-Identifier: MIT
#include <sivid/decision/rank.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

using support::between;

namespace {

sivid::run_options of_degree(std::size_t degree) {
    sivid::run_options run;
    run.degree = degree;
    return run;
}

/// Ended by parts, so that a slow machine finds the same.
sivid::rank_options const patient{
    .seconds = 1e6, .parts = 2500, .accuracy = 0.05, .run = of_degree(4)};

/// What a test knows of a problem: its outputs in closed form, sample by sample.
struct known_problem {
    sivid::identification_problem problem;
    /// (experiment, parameters, start) to the outputs, in the order of the measurements
    std::function<std::vector<double>(std::size_t, std::vector<double> const&, double)> outputs;
};

/// x' = -p0 x; y0 = p1 p2 x; y1 = x + p3 sin(2 p4); p5 stands nowhere.
known_problem wavy(sivid::interval const& start) {
    known_problem k;
    auto& p = k.problem;
    p.model = support::model_of(
        {.states = 1, .constants = 6},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{-(c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{c[1] * c[2] * x[0], x[0] + c[3] * sin(2 * c[4])};
        });
    p.choice.unknown = support::all_constants(6);
    p.prior = {between(0.5, 1),  between(0.5, 1.5), between(1, 2),
               between(-1, 0.5), between(-1, 1.5),  between(0, 9)};
    for (double const end : {1.0, 3.0}) {
        sivid::experiment run;
        run.name = "run";
        run.initial = {start};
        for (int n = 1; n <= 4; ++n) {
            run.measurements.push_back({end * n / 4, 0, support::around(0, 0.125)});
            run.measurements.push_back({end * n / 4, 1, support::around(5, 0.25 * n)});
        }
        p.experiments.push_back(run);
    }
    k.outputs = [](std::size_t e, std::vector<double> const& c, double x0) {
        std::vector<double> y;
        for (int n = 1; n <= 4; ++n) {
            double const x = x0 * std::exp(-c[0] * (e == 0 ? 1.0 : 3.0) * n / 4);
            y.push_back(c[1] * c[2] * x);
            y.push_back(x + c[3] * std::sin(2 * c[4]));
        }
        return y;
    };
    return k;
}

/// x' = p0 x (1 - x / p1): parameters that gain and lose their influence along the motion.
known_problem growth() {
    known_problem k;
    auto& p = k.problem;
    p.model = support::model_of({.states = 1, .constants = 2},
                                [](auto const&, auto const& x, auto const& c, auto const&) {
                                    return std::vector{c[0] * x[0] * (1 - x[0] / c[1])};
                                });
    p.choice.unknown = support::all_constants(2);
    p.prior = {between(0.5, 3), between(1, 3)};
    sivid::experiment run;
    run.name = "run";
    run.initial = {sivid::interval(0.125)};
    for (int n = 1; n <= 12; ++n)
        run.measurements.push_back({0.25 * n, 0, support::around(1, 0.02)});
    p.experiments = {run};
    k.outputs = [](std::size_t, std::vector<double> const& c, double x0) {
        std::vector<double> y;
        for (int n = 1; n <= 12; ++n)
            y.push_back(c[1] / (1 + (c[1] / x0 - 1) * std::exp(-c[0] * 0.25 * n)));
        return y;
    };
    return k;
}

/// x' = -p0 x, steep; y1 = p1 (1 - p1), as much at either end of [0, 1].
known_problem fall_and_bump() {
    known_problem k;
    auto& p = k.problem;
    p.model = support::model_of(
        {.states = 1, .constants = 2},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{-(c[0] * x[0])};
        },
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{x[0], c[1] * (1 - c[1])};
        });
    p.choice.unknown = support::all_constants(2);
    p.prior = {between(0.25, 8), between(0, 1)};
    sivid::experiment run;
    run.name = "run";
    run.initial = {sivid::interval(1.0)};
    run.measurements = {{1, 0, between(-1, 1)}, {1, 1, between(-0.01, 0.01)}};
    for (auto& m : run.measurements) m.bound = {m.bound.lower() / 64, m.bound.upper() / 64};
    p.experiments = {run};
    k.outputs = [](std::size_t, std::vector<double> const& c, double x0) {
        return std::vector{x0 * std::exp(-c[0]), c[1] * (1 - c[1])};
    };
    return k;
}

/// What moving p_j from a to b does to the channel's measurements, in error bounds.
double moved(known_problem const& k, sivid::channel_effects const& c, std::size_t j,
             std::vector<double> p, double a, double b, double start) {
    auto const& samples = k.problem.experiments[c.experiment].measurements;
    p[j] = a;
    auto const one = k.outputs(c.experiment, p, start);
    p[j] = b;
    auto const other = k.outputs(c.experiment, p, start);
    double most = 0;
    for (std::size_t s = 0; s < samples.size(); ++s) {
        if (samples[s].channel != c.channel) continue;
        most = std::max(most, std::abs(one[s] - other[s]) / rad(samples[s].bound));
    }
    return most;
}

/// Draws points of the prior and looks for a motion that contradicts a bound.
void attack(known_problem const& k, sivid::ranking const& found, int draws) {
    support::draws d{11};
    for (auto const& c : found.channels) {
        REQUIRE(c.effects.size() == k.problem.prior.size());
        auto const& starts = k.problem.experiments[c.experiment].initial;
        for (std::size_t j = 0; j < c.effects.size(); ++j) {
            auto const& e = c.effects[j];
            CHECK(e.parameter == j);
            CHECK(e.low <= e.high);
            double most = 0;
            for (int n = 0; n < draws; ++n) {
                auto const p = d.in(k.problem.prior);
                most = std::max(most, moved(k, c, j, p, d.in(k.problem.prior[j]),
                                            d.in(k.problem.prior[j]), d.in(starts[0])));
            }
            CHECK(most <= e.high + 1e-9);
            if (e.low == 0) continue;
            REQUIRE(subset(sivid::point_box(e.at), k.problem.prior));
            CHECK(contains(k.problem.prior[j], e.from));
            CHECK(contains(k.problem.prior[j], e.to));
            // What is said to be reached is reached.
            REQUIRE(subset(sivid::point_box(e.start), starts));
            CHECK(moved(k, c, j, e.at, e.from, e.to, e.start[0]) >= e.low - 1e-9);
        }
    }
}

} // namespace

TEST_CASE("no motion moves more than the bounds of its parameter and each lower one is reached") {
    for (auto const& start : {sivid::interval(2.0), between(1.9, 2.1)}) {
        auto const k = wavy(start);
        auto const found = sivid::rank(k.problem, patient);
        REQUIRE(found.channels.size() == 4);
        attack(k, found, 4000);
        CAPTURE(found.parts, found.integrations);
        CHECK(found.complete);
        auto const& first = found.channels[0];
        CHECK(first.experiment == 0);
        CHECK(first.channel == 0);
        // By hand: p1 moves y0 by p2 x, at the largest p2, the smallest p0 and the first instant.
        double const by_hand = 1.0 * 2 * start.upper() * std::exp(-0.5 * 0.25) / 0.125;
        CHECK(first.effects[1].high >= by_hand * (1 - 1e-12));
        CHECK(first.effects[1].high <= by_hand * 1.05);
        CHECK(first.effects[1].low >= by_hand * 0.95);
        // p4 passes a crest and a trough: from one to the other, not along all of its way.
        CHECK(found.channels[1].effects[4].high <= 2.15 / 0.25);
        CHECK(found.channels[1].effects[4].low >= 1.9 / 0.25);
    }
}

TEST_CASE("what no equation carries to a channel has no effect on it") {
    auto const k = wavy(sivid::interval(2.0));
    auto const found = sivid::rank(k.problem, patient);
    for (auto const& c : found.channels) {
        for (std::size_t j = 0; j < 6; ++j) {
            bool const acts = j == 0 || (c.channel == 0 ? j == 1 || j == 2 : j == 3 || j == 4);
            CHECK(c.effects[j].acts == acts);
            if (!acts) CHECK(c.effects[j].high == 0);
        }
        CHECK(c.place_of(5).best == 4);
    }
    CHECK(found.overall(5).upper() == 0);
    CHECK_FALSE(found.acts(5));
    CHECK(found.acts(4));
    CHECK(found.combinations.entangled == std::vector<std::size_t>{1, 2});
}

TEST_CASE("measurements whose bounds have no width do not count, and are named") {
    auto k = wavy(sivid::interval(2.0));
    for (auto& e : k.problem.experiments) {
        for (auto& m : e.measurements)
            if (m.channel == 1)
                m.bound = sivid::interval(mid(m.bound)); // p3 and p4 act there alone
    }
    auto const found = sivid::rank(k.problem, {.seconds = 0.2});
    REQUIRE(found.channels.size() == 2);
    for (auto const& c : found.channels) CHECK(c.channel == 0);
    REQUIRE(found.exact.size() == 2);
    CHECK(found.exact[0].channel == 1);
    CHECK(found.exact[0].count > 0);
    CHECK(found.exact[0].acts == std::vector<bool>{true, false, false, true, true, false});
    CHECK(found.overall(3).upper() == 0);
    CHECK(found.acts(3));
    CHECK(found.moves_exact(3));
    CHECK_FALSE(found.moves_exact(1));
    // One that counts, and all others without any bound: they are moved by no error bound.
    for (auto& m : k.problem.experiments[0].measurements)
        if (m.channel == 1) m.bound = sivid::interval_traits<sivid::interval>::entire();
    k.problem.experiments.resize(1);
    auto const unbounded = sivid::rank(k.problem, {.seconds = 0.2});
    CHECK(unbounded.exact.empty());
    CHECK(unbounded.overall(3).upper() == 0);
    CHECK(unbounded.acts(3));
}

TEST_CASE("a certified order is that of the true effects") {
    auto const k = growth();
    auto const found = sivid::rank(k.problem, {.seconds = 1e6, .accuracy = 0.02});
    REQUIRE(found.complete);
    attack(k, found, 20'000);
    auto const& c = found.channels.at(0);
    CHECK(c.place_of(0).best == c.place_of(0).worst);
    auto const order = c.order();
    CHECK(c.effects[order[0]].low > c.effects[order[1]].high);
    CHECK(c.place_of(order[0]).worst == 1);
    CHECK(c.place_of(order[1]).best == 2);
}

TEST_CASE("a fall that takes many parts and a bump that comes back") {
    auto const k = fall_and_bump();
    auto const found = sivid::rank(k.problem, {.seconds = 1e6, .accuracy = 0.05});
    REQUIRE(found.complete);
    attack(k, found, 20'000);
    auto const& fall = found.channels.at(0).effects[0];
    double const whole = 64 * (std::exp(-0.25) - std::exp(-8));
    CHECK(fall.high >= whole * (1 - 1e-9));
    CHECK(fall.low >= whole * 0.95);
    auto const& bump = found.channels.at(1).effects[1];
    CHECK(bump.high >= 1600 * (1 - 1e-9));
    CHECK(bump.low >= 1600 * 0.95);
}

TEST_CASE("a small budget costs closeness and no proof") {
    auto const k = growth();
    for (std::size_t const parts : {1U, 3U, 10U}) {
        auto const found = sivid::rank(k.problem, {.seconds = 1e6, .parts = parts});
        CHECK(found.parts <= parts);
        attack(k, found, 3000);
    }
    attack(k, sivid::rank(k.problem, {.keep_going = [] { return false; }}), 3000);
}

TEST_CASE("what cannot be ranked is said") {
    auto p = wavy(sivid::interval(2.0)).problem;
    p.model.channel_delays.push_back({0, 5});
    CHECK_THROWS_AS(sivid::rank(p), std::invalid_argument);
    p.model.channel_delays.clear();
    p.prior = {};
    CHECK_THROWS_AS(sivid::rank(p), std::invalid_argument);
}
