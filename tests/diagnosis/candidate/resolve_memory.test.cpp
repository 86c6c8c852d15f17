// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/resolve_memory.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/enclosure/flow.hpp>
#include <sivid/model/affected_problem.hpp>

using namespace sivid;
using namespace sivid::literals;

TEST_CASE("a delayed signal shows the past") {
    sampled_signal const linear({0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, interpolation::linear);
    sampled_signal const hold({0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, interpolation::hold);
    auto const formula = analytic_signal::from([](auto const& t) { return 3 * t + 1; });
    auto const late = std::get<sampled_signal>(delayed(linear, {0.5}, 0));
    auto const late_hold = std::get<sampled_signal>(delayed(hold, {0.5}, 0));
    for (double t = 0; t < 4; t += 0.0625) {
        double const past = std::max(t - 0.5, 0.0);
        CHECK(std::abs(late.approximate(t) - linear.approximate(past)) < 1e-14);
        CHECK(late_hold.approximate(t) == hold.approximate(past));
    }
    auto const late_formula = std::get<analytic_signal>(delayed(formula, {0.5}, 0.25));
    auto const at = [&](double t) {
        graph g;
        auto const v = copy_into(g, late_formula.g, {late_formula.value},
                                 [t](node const&, graph& to) { return to.constant(t); });
        return g.value(g[v.front()]).nearest;
    };
    CHECK(at(0.3) == 1.75);
    CHECK(at(1.0) == 2.5);
    // A signal that was recorded from before the begin on.
    sampled_signal const early({-2.0, 2.0}, {-2.0, 2.0}, interpolation::linear);
    auto const held = std::get<sampled_signal>(delayed(early, {0.5}, 1));
    CHECK(held.approximate(1.25) == 1);
    CHECK(held.approximate(2.0) == 1.5);
    CHECK(std::get<sampled_signal>(delayed(linear, {0}, 0)).times().size() == 3);
    // One that was recorded before the begin alone goes on along its last line.
    sampled_signal const before({-2.0, -1.0}, {0.0, 1.0}, interpolation::linear);
    auto const on = std::get<sampled_signal>(delayed(before, {0.5}, 0));
    for (double t = 0; t < 9; t += 0.125) {
        double const past = before.approximate(std::max(t - 0.5, 0.0));
        CHECK_THAT(on.approximate(t), WithinAbs(past, 1e-12));
    }
}

TEST_CASE("resolving a play puts the recorded input behind it, late or not") {
    std::vector<effect> both{effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec}),
                             effects::input_delay("late", "u", {0_dec, 0.5_dec})};
    auto const p = affected(small_campaign::problem(), both);
    auto const r = resolve_memory(p, {1.25, 0.125, 0.25});
    CHECK(r.kept == std::vector<std::size_t>{0});
    CHECK_FALSE(r.problem.model.has_memory());
    auto const& e = p.experiments[0];
    auto const alone = played(std::get<sampled_signal>(e.inputs[0]), 0, 4, interval(0.125)).within;
    auto const& u = std::get<sampled_signal>(r.problem.experiments[0].inputs[0]);
    for (double t = 0; t < 4; t += 0.0625) {
        auto const k = u.piece(t);
        CHECK(std::abs(u.approximate(t) - alone.approximate(std::max(0.0, t - 0.25))) < 1e-12);
        CHECK(u.error_bound(k, t) < 1e-13);
    }
    CHECK_THROWS_AS(resolve_memory(p, {1.25, -0.125, 0.25}), std::invalid_argument);
    // Of a formula nothing is known behind a play.
    auto formula = p;
    formula.experiments[1].inputs[0] = analytic_signal::from([](auto const& t) { return sin(t); });
    CHECK(remembers_formulas(formula));
    CHECK_THROWS_AS(resolve_memory(formula, {1.25, 0.125, 0.25}), std::invalid_argument);
}

TEST_CASE("resolving a rate limit puts the recorded input behind it, before a play and a delay") {
    std::vector<effect> all{effects::input_delay("late", "u", {0_dec, 0.5_dec}),
                            effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec}),
                            effects::input_rate_limit("slow", "u", "N/s", {0.25_dec, 4_dec})};
    auto const p = affected(small_campaign::problem(), all);
    auto const r = resolve_memory(p, {1.25, 0.25, 0.125, 0.75});
    CHECK(r.kept == std::vector<std::size_t>{0});
    auto const& e = p.experiments[0];
    auto const slow =
        rate_limited(std::get<sampled_signal>(e.inputs[0]), 0, 4, interval(0.75)).within;
    auto const alone = played(slow, 0, 4, interval(0.125)).within;
    auto const& u = std::get<sampled_signal>(r.problem.experiments[0].inputs[0]);
    for (double t = 0; t < 4; t += 0.0625)
        CHECK(std::abs(u.approximate(t) - alone.approximate(std::max(0.0, t - 0.25))) < 1e-12);
    CHECK_THROWS_AS(resolve_memory(p, {1.25, 0.25, 0.125, 0.0}), std::invalid_argument);
    // Two limits, as pairs of a catalogue may be: one behind the other.
    auto const two = affected(small_campaign::problem(),
                              {effects::input_rate_limit("a", "u", "N/s", {0.25_dec, 4_dec}),
                               effects::input_rate_limit("b", "u", "N/s", {0.25_dec, 4_dec})});
    auto const both = resolve_memory(two, {1.25, 0.75, 0.5});
    auto const slower = rate_limited(slow, 0, 4, interval(0.5)).within;
    auto const& seen = std::get<sampled_signal>(both.problem.experiments[0].inputs[0]);
    for (double t = 0; t < 4; t += 0.0625)
        CHECK(std::abs(seen.approximate(t) - slower.approximate(t)) < 1e-12);
}

TEST_CASE("resolving delays moves signals and measurements and drops the unknowns") {
    auto const p = affected(small_campaign::problem(),
                            {effects::input_delay("late", "u", {0_dec, 0.5_dec}),
                             effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec})});
    auto const r = resolve_memory(p, {1.25, 0.25, 0.15});
    CHECK(r.kept == std::vector<std::size_t>{0});
    CHECK(r.problem.choice.unknown == std::vector<std::string>{"k"});
    CHECK(r.problem.model.input_memory.empty());
    CHECK(r.problem.model.channel_delays.empty());
    auto const& e = r.problem.experiments[0];
    auto const& u = std::get<sampled_signal>(e.inputs[0]);
    CHECK(std::abs(u.approximate(1.0) - std::cos(1.5)) < 1e-3);
    CHECK(u.approximate(0.2) == 1);
    REQUIRE(e.measurements.size() == p.experiments[0].measurements.size());
    // 0.1 s - 0.15 s lies before the begin.
    CHECK(e.measurements[0].time == 0);
    CHECK(e.measurements[0].channel == 0);
    r.problem.require_valid();
    flow const f(r.problem.model, r.problem.choice, e.inputs); // binds
    CHECK_THROWS_AS(resolve_memory(p, {1.25, -0.25, 0.15}), std::invalid_argument);
}

TEST_CASE("counts of readings move with late readings, and are any where only some are late") {
    sampled_signal const counts({0.0, 1.0, 2.0}, {0.0, 1.0, -1.0}, interpolation::hold);
    auto const moved = counts_of_late(counts, dead_time{0.5}, 0);
    CHECK(moved.approximate(0.25) == 0);
    CHECK(moved.approximate(0.75) == 1);
    CHECK(moved.approximate(1.75) == -1);
    CHECK(moved.exact());
    for (auto const& any : {counts_of_late(counts, std::nullopt, 0),
                            counts_of_late(counts, dead_time{1.5}, 0)}) { // two before the begin
        CHECK(any.values() == std::vector<double>{0});
        CHECK(any.errors() == std::vector<double>{1});
    }
}

TEST_CASE("a late signal keeps the error bounds of its samples") {
    std::vector<double> const errors{0.1, 0.3, 0.2};
    for (auto const kind : {interpolation::linear, interpolation::hold}) {
        sampled_signal const u({0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, kind, errors);
        auto const late = std::get<sampled_signal>(delayed(u, {0.5}, 0));
        REQUIRE_FALSE(late.exact());
        for (double t = 0; t < 4; t += 0.0625) {
            double const past = std::max(t - 0.5, 0.0);
            CHECK(std::abs(late.error_bound(late.piece(t), t) -
                           u.error_bound(u.piece(past), past)) < 1e-14);
        }
        CHECK(std::get<sampled_signal>(delayed(u.nominal(), {0.5}, 0)).exact());
    }
}

TEST_CASE("a clock that runs slow makes a signal ever later") {
    sampled_signal const linear({-1.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, interpolation::linear);
    sampled_signal const hold({-1.0, 1.0, 3.0}, {2.0, 4.0, 0.0}, interpolation::hold);
    auto const formula = analytic_signal::from([](auto const& t) { return 3 * t + 1; });
    double const begin = -0.25;
    for (dead_time const late : {dead_time{0, 0.25}, {0.5, 0.125}}) {
        auto const moved = std::get<sampled_signal>(delayed(linear, late, begin));
        auto const moved_hold = std::get<sampled_signal>(delayed(hold, late, begin));
        auto const moved_formula = std::get<analytic_signal>(delayed(formula, late, begin));
        for (double t = begin; t < 5; t += 0.0625) {
            double const past = std::max(begin, t - late.delay - late.drift * (t - begin));
            CHECK(std::abs(moved.approximate(t) - linear.approximate(past)) < 1e-13);
            if (std::abs(past - 1) > 1e-9 && std::abs(past - 3) > 1e-9)
                CHECK(moved_hold.approximate(t) == hold.approximate(past));
            graph g;
            auto const v = copy_into(g, moved_formula.g, {moved_formula.value},
                                     [t](node const&, graph& to) { return to.constant(t); });
            CHECK(std::abs(g.value(g[v.front()]).nearest - (3 * past + 1)) < 1e-13);
        }
    }
    // Dead times of one input, and of one sensor, add up.
    auto const p = affected(small_campaign::problem(),
                            {effects::input_delay("late", "u", {0_dec, 0.5_dec}),
                             effects::input_clock_drift("slow", "u", {0_dec, 0.5_dec}),
                             effects::sensor_clock_drift("clock", {"p"}, {0_dec, 0.5_dec})});
    auto const r = resolve_memory(p, {1.25, 0.25, 0.125, 0.0625});
    CHECK(r.kept == std::vector<std::size_t>{0});
    CHECK_FALSE(r.problem.model.has_memory());
    auto const& u = std::get<sampled_signal>(p.experiments[0].inputs[0]);
    auto const& seen = std::get<sampled_signal>(r.problem.experiments[0].inputs[0]);
    for (double t = 0; t < 4; t += 0.0625)
        CHECK(std::abs(seen.approximate(t) - u.approximate(std::max(0.0, 0.875 * t - 0.25))) <
              1e-12);
    std::vector<double> times;
    for (auto const& m : r.problem.experiments[0].measurements)
        if (m.channel == 0) times.push_back(m.time);
    REQUIRE(times.size() == 40);
    CHECK(std::abs(times[39] - 0.9375 * 4) < 1e-14);
    // A clock that stands, or would go back, shows nothing new (priors are widened, too).
    for (double const drift : {1.0, 1.6}) {
        auto const stands = resolve_memory(p, {1.25, 0.25, drift, drift});
        auto const& e = stands.problem.experiments[0];
        for (double t = 0; t < 4; t += 0.0625)
            CHECK(std::get<sampled_signal>(e.inputs[0]).approximate(t) == u.approximate(0));
        for (auto const& m : e.measurements)
            if (m.channel == 0) CHECK(m.time == 0);
    }
    CHECK_THROWS_AS(resolve_memory(p, {1.25, 0.25, -0.1, 0.0625}), std::invalid_argument);
}
