// SPDX-License-Identifier: MIT
// The generator's own simulator against numbers and closed forms that do not come from it.
#include "catalogue.hpp"
#include "simulate.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace withheld;

namespace {

polyline steady(double value, double end) { return {{0, end}, {value, value}}; }

/// Fine enough to stand for the function itself.
template <class F>
polyline sampled(F const& f, double end) {
    polyline p;
    for (int i = 0; i <= 2000; ++i) {
        p.t.push_back(end * i / 2000);
        p.value.push_back(f(p.t.back()));
    }
    return p;
}

world calm(double end) {
    world w;
    w.motor = steady(0, end);
    w.rudder = steady(0, end);
    return w;
}

/// Without any friction or drag.
world frictionless(double end) {
    world w = calm(end);
    w.c.Ff = w.c.D22 = w.c.D33 = w.c.rho = 0;
    return w;
}

void check_state(state const& got, channels const& expected, double tolerance) {
    for (std::size_t i = 0; i < channel_count; ++i) {
        CAPTURE(i);
        CHECK_THAT(got[i], WithinAbs(expected[i], tolerance));
    }
}

/// A lively manoeuvre in which everything is at work.
world lively() {
    world w;
    w.motor = sampled([](double t) { return 90 + 20 * std::sin(0.9 * t); }, 3);
    w.rudder = {{0, 0.5, 1, 1.5, 2, 2.5, 3}, {0.1, 0.4, 0.2, -0.3, -0.1, 0.3, 0.35}};
    return w;
}

} // namespace

TEST_CASE("reference table of the three scenarios") {
    double const half = 6e-4; // the table has three decimals
    world one = calm(1);
    one.motor = steady(250, 1);
    check_state(states_at(one, {0.1, 0, 0, 0, 0, 0}, {1}, careful_step).back(),
                {7.311, 0, 0, 3.872, 0, 0}, half);
    check_state(states_at(calm(10), {2, 0, 0, 0, 0, 0}, {10}, careful_step).back(),
                {0, 0, 0, 4.420, 0, 0}, half);
    world three = calm(3);
    three.motor = steady(250.0 / 3, 3);
    double const pi = std::numbers::pi;
    three.rudder = sampled([&](double t) { return pi / 12 * (1 + std::sin(pi * t / 2)); }, 3);
    check_state(states_at(three, {2, 0, 0, 0, 0, 0}, {3}, careful_step).back(),
                {-1.184, 1.463, -0.315, 7.717, 1.581, -2.356}, half);
}

TEST_CASE("halving the step changes nothing that counts, with every effect") {
    std::vector<double> times;
    for (int i = 1; i <= 30; ++i) times.push_back(0.1 * i);
    channels const start{0.6, 0.2, 0.1, 0, 0, 0.3};
    auto const difference = [&](world const& w, double step) {
        auto const a = readings(w, start, times, step), b = readings(w, start, times, step / 2);
        double most = 0;
        for (std::size_t i = 0; i < times.size(); ++i)
            for (std::size_t k = 0; k < channel_count; ++k)
                most = std::max(most, std::abs(a[i][k] - b[i][k]));
        return most;
    };
    auto const base = readings(lively(), start, times, careful_step);
    random_source random{5};
    for (auto const& e : catalogue()) {
        CAPTURE(e.name);
        world w = lively();
        draw_size(e, random, 1, 0.4, w.e);
        // The kink of |r| r, or a lag that runs into a limit, costs orders, not correctness.
        CHECK(difference(w, careful_step) < 1e-7);
        auto const changed = readings(w, start, times, careful_step);
        double most = 0;
        for (std::size_t i = 0; i < times.size(); ++i)
            for (std::size_t k = 0; k < channel_count; ++k)
                most = std::max(most, std::abs(changed[i][k] - base[i][k]) / 0.02);
        CHECK(most > 1);
    }
    world foreign = lively();
    foreign.f = {0.4, 0.2, 5, 0.3, 1, 0.4};
    foreign.gusts = {{0.3, 1, 1.2}};
    CHECK(difference(foreign, careful_step) < 1e-7);
    // Fourth order: the error falls by 16, a little less exactly measured.
    world coarse = lively(); // few kinks, so that the steps are those that are asked for
    coarse.motor = steady(90, 3);
    CHECK(difference(coarse, 0.05) > 1e-9);
    CHECK(difference(coarse, 0.025) < difference(coarse, 0.05) / 10);
}

TEST_CASE("neutral values change nothing") {
    auto const base = states_at(lively(), {1, 0, 0, 0, 0, 0}, {3}, 1e-3).back();
    world w = lively();
    w.e.rudder_limit = 0.4; // never reached from above
    CHECK(states_at(w, {1, 0, 0, 0, 0, 0}, {3}, 1e-3).back() == base);
}

TEST_CASE("lags, delay and dead band by their closed forms") {
    world w = calm(2);
    w.motor = steady(80, 2);
    w.rudder = {{0, 2}, {0.1, 0.9}}; // 0.1 + 0.4 t
    w.e.rudder_lag = 0.2;
    w.e.motor_lag = 0.3;
    auto const lagged = states_at(w, {1, 0, 0, 0, 0, 0}, {1.3}, careful_step).back();
    CHECK_THAT(lagged[6], WithinAbs(0.1 + 0.4 * (1.3 - 0.2 + 0.2 * std::exp(-1.3 / 0.2)), 1e-10));
    CHECK_THAT(lagged[7], WithinAbs(80 * (1 - std::exp(-1.3 / 0.3)), 1e-8));

    // Delay and dead band come before the lag: the ramp leaves the band at (0.3 - 0.1)/0.4 + 0.25.
    w.e.input_delay = 0.25;
    w.e.rudder_deadband = 0.3;
    auto const behind = states_at(w, {1, 0, 0, 0, 0, 0}, {0.7, 1.3}, careful_step);
    CHECK_THAT(behind[0][6], WithinAbs(0, 1e-14));
    double const since = 1.3 - 0.75;
    CHECK_THAT(behind[1][6], WithinAbs(0.4 * (since - 0.2 + 0.2 * std::exp(-since / 0.2)), 1e-10));
    w.e.battery_sag = 0.1; // W (1 - k t) goes into the motor's lag
    auto const sagging = states_at(w, {1, 0, 0, 0, 0, 0}, {1.3}, careful_step).back();
    double const tail = std::exp(-1.3 / 0.3);
    CHECK_THAT(sagging[7], WithinAbs(80 * (1 - tail) - 8 * (1.3 - 0.3 * (1 - tail)), 1e-8));

    world servo = calm(2);
    servo.rudder = {{0, 1e-9, 2}, {0, 0.5, 0.5}};
    servo.f.servo_frequency = 5;
    servo.f.servo_damping = 0.3;
    double const damped = 5 * std::sqrt(1 - 0.09), t = 0.8;
    double const step =
        1 - std::exp(-1.5 * t) * (std::cos(damped * t) + 1.5 / damped * std::sin(damped * t));
    CHECK_THAT(states_at(servo, {1, 0, 0, 0, 0, 0}, {t}, careful_step).back()[6],
               WithinAbs(0.5 * step, 1e-7));
}

TEST_CASE("forces by their closed forms") {
    world w = frictionless(2);
    w.e.slope_x = 0.03;
    w.e.slope_y = -0.02;
    w.e.payload = 0.2; // gravity acts on all of the mass: no influence
    auto const slid = states_at(w, {0, 0, 0, 0, 0, 0.7}, {2}, careful_step).back();
    CHECK_THAT(slid[3], WithinAbs(0.03 * 9.81 * 2, 1e-9));
    CHECK_THAT(slid[4], WithinAbs(-0.02 * 9.81 * 2, 1e-9));

    // Drifting with the wind nothing drags.
    world drift = calm(2);
    drift.c.Ff = drift.c.D22 = 0;
    drift.e.wind_x = 0.6;
    drift.e.wind_y = -0.8;
    double const c = std::cos(0.4), s = std::sin(0.4);
    channels const with{c * 0.6 - s * 0.8, -s * 0.6 - c * 0.8, 0, 0, 0, 0.4};
    check_state(states_at(drift, with, {2}, careful_step).back(),
                {with[0], with[1], 0, 1.2, -1.6, 0.4}, 1e-9);

    // A free body turns about its centre of gravity, which moves straight on.
    world free = frictionless(2);
    free.e.cg_offset = 0.08;
    auto const turned = states_at(free, {1, 0, 2, 0, 0, 0}, {2}, careful_step).back();
    CHECK_THAT(turned[2], WithinAbs(2, 1e-9));
    CHECK_THAT(turned[3] + 0.08 * std::cos(turned[5]), WithinAbs(0.08 + 2.0, 1e-8));
    CHECK_THAT(turned[4] + 0.08 * std::sin(turned[5]), WithinAbs(2 * 0.16, 1e-8));

    // A taut spring alone swings.
    world spring = frictionless(2);
    spring.f.tether_stiffness = 2;
    double const omega = std::sqrt(2 / spring.c.m);
    CHECK_THAT(states_at(spring, {1, 0, 0, 0, 0, 0}, {2}, careful_step).back()[3],
               WithinAbs(std::sin(2 * omega) / omega, 1e-8));

    // sin^2 has the mean 1/2: the impulse of the gust.
    world gust = frictionless(2);
    gust.gusts = {{0.5, 1, 1.2}};
    CHECK_THAT(states_at(gust, {0, 0, 0, 0, 0, 0}, {2}, careful_step).back()[1],
               WithinAbs(0.6 / gust.c.m, 1e-9));
}

TEST_CASE("yaw and surge effects at one state") {
    state s{};
    s[0] = 1.2, s[1] = -0.4, s[2] = -0.8, s[5] = 0.3;
    command const now{90, 0.2};
    world const base = lively();
    state const plain = derivative(base, 0, now, s, s);
    double const thrust = 0.1339 * 1.225 * std::pow(0.18, 4) * 90 * 90;
    auto const change = [&](auto const& set) {
        world w = base;
        set(w.e);
        state d = derivative(w, 0, now, s, s);
        for (std::size_t i = 0; i < 3; ++i) d[i] -= plain[i];
        return d;
    };
    CHECK_THAT(change([](auto& e) { e.thrust_offset = 0.01; })[2],
               WithinAbs(thrust * 0.01 / 0.058, 1e-12));
    CHECK_THAT(change([](auto& e) { e.quadratic_yaw_damping = 0.1; })[2],
               WithinAbs(0.1 * 0.64 / 0.058, 1e-12));
    CHECK_THAT(change([](auto& e) { e.dry_yaw_friction = 0.05; })[2],
               WithinAbs(0.05 * 0.8 / std::sqrt(0.64 + 1e-4) / 0.058, 1e-12));
    CHECK_THAT(change([](auto& e) { e.linear_surge_damping = 0.3; })[0],
               WithinAbs(-0.3 * 1.2 / 1.297, 1e-12));
    double const V = std::sqrt(1.2 * 1.2 + 0.4 * 0.4 + 0.05 * 0.05);
    CHECK_THAT(change([](auto& e) { e.friction_anisotropy = 0.5; })[1],
               WithinAbs(0.5 * 0.5 * 0.4 / V / 1.297, 1e-12));
    auto const weaker = change([](auto& e) { e.thrust_loss = 0.1; });
    CHECK_THAT(weaker[0], WithinAbs(-thrust * 0.12 / 1.297, 1e-12));
    double const lift = 1.891 * thrust * 0.2 / (4 * 0.025447);
    CHECK_THAT(weaker[2], WithinAbs(0.12 * 0.30 * lift * 0.04 / 0.058, 1e-12));
    CHECK_THAT(change([](auto& e) { e.rudder_trim = 0.05; })[1],
               WithinAbs(0.25 * lift * 0.22 / 1.297, 1e-12));
    CHECK_THAT(change([](auto& e) { e.rudder_limit = 0.1; })[1],
               WithinAbs(-0.5 * lift * 0.22 / 1.297, 1e-12));
    // The trim is added behind the limit.
    CHECK_THAT(change([](auto& e) { e.rudder_limit = 0.1, e.rudder_trim = 0.05; })[1],
               WithinAbs(-0.25 * lift * 0.22 / 1.297, 1e-12));
    CHECK(change([](auto& e) { e.friction_anisotropy = 0.5; })[0] == 0);

    // Wind changes the drag of the air alone, not friction and D22.
    double const c = std::cos(0.3), sn = std::sin(0.3);
    double const air_u = 1.2 - c * 0.7, air_v = -0.4 + sn * 0.7;
    double const air_V = std::sqrt(air_u * air_u + air_v * air_v + 0.05 * 0.05);
    auto const blown = change([](auto& e) { e.wind_x = 0.7; });
    double const half = 0.5 * 1.225 * 0.6;
    CHECK_THAT(blown[0], WithinAbs(-half * 0.1276 * (air_V * air_u - V * 1.2) / 1.297, 1e-12));
    CHECK_THAT(blown[1], WithinAbs(-half * 0.22 * (air_V * air_v + V * 0.4) / 1.297, 1e-12));

    world stribeck = base;
    stribeck.e.stribeck_rise = 0.8;
    stribeck.e.stribeck_speed = 0.9;
    double const more = 0.5 * 0.8 * std::exp(-V * V / 0.81);
    CHECK_THAT(derivative(stribeck, 0, now, s, s)[1] - plain[1],
               WithinAbs(more * 0.4 / V / 1.297, 1e-12));

    auto const pushed = [&](double foreign_values::*law) {
        world other = base;
        other.f.*law = 0.3;
        state by = derivative(other, 0, now, s, s);
        for (std::size_t i = 0; i < by.size(); ++i) by[i] -= plain[i];
        return by;
    };
    CHECK_THAT(pushed(&foreign_values::cubic_drag)[0], WithinAbs(-0.3 * 1.728 / 1.297, 1e-12));
    CHECK_THAT(pushed(&foreign_values::weathervane)[2], WithinAbs(0.3 * 1.2 * 0.4 / 0.058, 1e-12));
    CHECK_THAT(pushed(&foreign_values::cross_coupling)[1],
               WithinAbs(-0.3 * 1.2 * s[2] / 1.297, 1e-12));

    world swell = base;
    swell.f.swell_force = 0.7;
    swell.f.swell_frequency = 2;
    CHECK_THAT(derivative(swell, 0.6, now, s, s)[1] - derivative(base, 0.6, now, s, s)[1],
               WithinAbs(0.7 * std::sin(1.2) / 1.297, 1e-12));
}

TEST_CASE("a play follows its command in small steps") {
    polyline const command{{-0.5, 0.1, 0.4, 1, 1.3, 1.6, 1.7, 2.4},
                           {0.9, 0.3, -0.2, 0.8, 0.7, 0.75, -0.4, -0.1}};
    for (double const b : {0.01, 0.07, 0.3, 2.0}) {
        auto const driven = behind_play(command, b);
        double at = command.at(0);
        for (int i = 0; i <= 30000; ++i) {
            double const t = 1e-4 * i, u = command.at(t);
            at = std::max(u - b, std::min(u + b, at));
            CHECK_THAT(driven.at(t), WithinAbs(at, 1e-12));
        }
    }
    CHECK(behind_play(command, 0).value == command.value);
}

TEST_CASE("a rate limit follows its command in small steps") {
    polyline const command{{-0.5, 0.1, 0.4, 1, 1.3, 1.6, 1.7, 2.4},
                           {0.9, 0.3, -0.2, 0.8, 0.7, 0.75, -0.4, -0.1}};
    for (double const most : {0.1, 0.6, 1.2, 1.7, 20.0}) {
        auto const driven = behind_rate_limit(command, most);
        double at = command.at(0);
        for (int i = 0; i <= 24000; ++i) {
            double const t = 1e-4 * i, u = command.at(t);
            if (i > 0) at = std::clamp(u, at - 1e-4 * most, at + 1e-4 * most);
            CHECK_THAT(driven.at(t), WithinAbs(at, 2e-4 * most));
        }
    }
    CHECK(behind_rate_limit(command, effect_values{}.rudder_rate).value == command.value);
}

TEST_CASE("what is remembered goes on, and acts in its time") {
    world w = lively();
    w.e = {};
    double const begin = 0.8;
    channels const start{1, 0, 0, 0.5, -0.5, 0.2};
    std::vector<double> const times{0.4, begin, 1.3, 2};
    auto const plain = states_at(w, start, times, careful_step);
    auto const seen_from_then = [&](auto const& change) {
        world later = w;
        change(later.e);
        act_within(later, {begin, for_ever});
        return states_at(later, start, times, careful_step);
    };
    // The craft from then on, under a rudder that is given.
    auto const under = [&](polyline const& rudder) {
        world other = w;
        other.rudder = rudder;
        for (auto* line : {&other.rudder, &other.motor})
            for (double& t : line->t) t -= begin;
        channels now{};
        std::copy_n(plain[1].begin(), channel_count, now.begin());
        std::vector<double> const after{0.5, 1.2};
        return states_at(other, now, after, careful_step);
    };
    auto const compare = [&](std::vector<state> const& got, std::vector<state> const& want) {
        for (std::size_t k = 0; k < channel_count; ++k) {
            CHECK_THAT(got[0][k], WithinAbs(plain[0][k], 1e-12));
            CHECK_THAT(got[1][k], WithinAbs(plain[1][k], 1e-9));
            for (std::size_t n : {0U, 1U}) CHECK_THAT(got[n + 2][k], WithinAbs(want[n][k], 1e-7));
        }
        CHECK(std::abs(got[3][2] - plain[3][2]) > 1e-4);
    };
    auto late = w.rudder;
    for (double& t : late.t) t += 0.3;
    compare(seen_from_then([](auto& e) { e.input_delay = 0.3; }), under(late));
    compare(seen_from_then([](auto& e) { e.rudder_play = 0.05; }),
            under(behind_play(w.rudder, 0.05)));
    compare(seen_from_then([](auto& e) { e.rudder_rate = 0.1; }),
            under(behind_rate_limit(w.rudder, 0.1)));
    // A lag by its solution for straight lines.
    polyline slow{{0.0}, {w.rudder.at(0)}};
    double const h = 1e-3, tau = 0.25;
    for (int i = 0; i < 2500; ++i) {
        double const before = w.rudder.at(i * h), slope = (w.rudder.at((i + 1) * h) - before) / h;
        double const limit = before - slope * tau;
        slow.t.push_back((i + 1) * h);
        slow.value.push_back(limit + slope * h + (slow.value.back() - limit) * std::exp(-h / tau));
    }
    auto const lagging = seen_from_then([](auto& e) { e.rudder_lag = 0.25; });
    auto const want = under(slow);
    for (std::size_t k = 0; k < channel_count; ++k)
        for (std::size_t n : {0U, 1U}) CHECK_THAT(lagging[n + 2][k], WithinAbs(want[n][k], 1e-4));

    world shown = w;
    shown.e.position_latency = 0.4;
    act_within(shown, {begin, 1.9});
    auto const positions = readings(shown, start, times, careful_step);
    CHECK_THAT(positions[0][3], WithinAbs(plain[0][3], 1e-9));
    CHECK_THAT(positions[1][3], WithinAbs(plain[0][3], 1e-9)); // 0.4 s ago
    CHECK_THAT(positions[3][3], WithinAbs(plain[3][3], 1e-9)); // no more
}

TEST_CASE("sensors") {
    std::vector<double> const times{0.1, 0.5, 1, 2};
    channels const start{1, 0, 0, 0.5, -0.5, 0.2};
    auto const plain = readings(lively(), start, times, careful_step);
    world w = lively();
    w.e.gyro_bias = 0.1;
    w.e.heading_bias = -0.2;
    w.e.position_scale = 0.05;
    w.e.position_latency = 0.5;
    auto const got = readings(w, start, times, careful_step);
    CHECK_THAT(got[3][2] - plain[3][2], WithinAbs(0.1, 1e-12));
    CHECK_THAT(got[3][5] - plain[3][5], WithinAbs(-0.2, 1e-12));
    CHECK_THAT(got[0][3], WithinAbs(1.05 * 0.5, 1e-12)); // before the latency: the start
    CHECK_THAT(got[2][4], WithinAbs(1.05 * plain[1][4], 1e-9));
}

TEST_CASE("instruments that no catalogue has by their closed forms") {
    // Straight ahead at a constant speed while turning evenly: every channel is known.
    world w = frictionless(4);
    double const speed = 1.5, turn = 0.4;
    channels const start{speed, 0, 0, 0, 0, 0};
    std::vector<double> const times{0.05, 0.7, 2, 4};
    auto const at = [&](world const& model) { return readings(model, start, times, careful_step); };
    auto const plain = at(w);
    CHECK_THAT(plain[3][3], WithinAbs(4 * speed, 1e-9));

    // A low-pass follows a ramp with a delay that settles at tau.
    world slow = w;
    slow.instruments.lag[3] = 0.3;
    auto const lagging = at(slow);
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const t = times[i];
        CHECK_THAT(lagging[i][3], WithinAbs(speed * (t - 0.3 + 0.3 * std::exp(-t / 0.3)), 1e-9));
        CHECK(lagging[i][0] == plain[i][0]);
    }
    // A late one shows the start until something younger is old enough.
    world late = w;
    late.instruments.late[3] = 0.1;
    CHECK_THAT(at(late)[0][3], WithinAbs(0, 1e-12));
    CHECK_THAT(at(late)[1][3], WithinAbs(speed * 0.6, 1e-9));
    // A drift is the same whatever moves.
    world drifting = w;
    drifting.instruments.drift[2] = 0.05;
    CHECK_THAT(at(drifting)[2][2], WithinAbs(0.1, 1e-12));
    CHECK_THAT(at(drifting)[3][2], WithinAbs(0.2, 1e-12));

    // Turned axes keep lengths; x goes where y was after a quarter.
    world askew = w;
    askew.instruments.velocity_turn = 0.1;
    askew.instruments.position_turn = std::numbers::pi / 2;
    auto const turned = at(askew);
    CHECK_THAT(turned[2][0], WithinAbs(speed * std::cos(0.1), 1e-9));
    CHECK_THAT(turned[2][1], WithinAbs(-speed * std::sin(0.1), 1e-9));
    CHECK_THAT(turned[2][3], WithinAbs(0, 1e-9));
    CHECK_THAT(turned[2][4], WithinAbs(-2 * speed, 1e-9));

    // A point of a body that turns about its centre goes round in a circle.
    world arm = w;
    arm.instruments.velocity_arm = 0.2;
    arm.instruments.antenna_x = 0.3;
    arm.instruments.antenna_y = -0.1;
    channels const spinning{0, 0, turn, 1, 2, 0};
    auto const seen = readings(arm, spinning, times, careful_step);
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const c = std::cos(turn * times[i]), sn = std::sin(turn * times[i]);
        CHECK_THAT(seen[i][0], WithinAbs(0, 1e-9));
        CHECK_THAT(seen[i][1], WithinAbs(0.2 * turn, 1e-9));
        CHECK_THAT(seen[i][3], WithinAbs(1 + 0.3 * c + 0.1 * sn, 1e-9));
        CHECK_THAT(seen[i][4], WithinAbs(2 + 0.3 * sn - 0.1 * c, 1e-9));
    }
}

TEST_CASE("halving the step changes nothing with slow and late instruments") {
    world w = lively();
    w.instruments.lag = {0.2, 0.2, 0.3, 0, 0, 0.1};
    w.instruments.late = {0, 0, 0, 0.13, 0.13, 0};
    std::vector<double> times;
    for (int i = 1; i <= 30; ++i) times.push_back(0.1 * i);
    channels const start{1, 0.2, 0.1, 0, 0, 0.3};
    auto const a = readings(w, start, times, careful_step);
    auto const b = readings(w, start, times, careful_step / 2);
    for (std::size_t i = 0; i < times.size(); ++i)
        for (std::size_t k = 0; k < channel_count; ++k)
            CHECK_THAT(a[i][k], WithinAbs(b[i][k], 1e-7));
}

TEST_CASE("effects that begin later or end") {
    // Down a slope from 0.8 s on.
    world w = frictionless(2);
    w.e.slope_x = 0.03;
    w.e.gyro_bias = 0.2;
    act_within(w, {0.8});
    auto const slid = states_at(w, {0, 0, 0, 0, 0, 0}, {0.8, 2}, careful_step);
    CHECK_THAT(slid[0][3], WithinAbs(0, 1e-15));
    CHECK_THAT(slid[1][0], WithinAbs(0.03 * 9.81 * 1.2, 1e-9));
    CHECK_THAT(slid[1][3], WithinAbs(0.03 * 9.81 * 0.72, 1e-9));
    auto const shown = readings(w, {0, 0, 0, 0, 0, 0}, {0.7, 0.9}, careful_step);
    CHECK(shown[0][2] == 0);
    CHECK_THAT(shown[1][2], WithinAbs(0.2, 1e-12));

    // Until then as if there were none, then as one that starts from that state.
    world band = lively();
    band.e.rudder_deadband = 0.1;
    band.e.payload = 0.2;
    act_within(band, {1.2});
    channels const start{1, 0, 0, 0, 0, 0};
    auto const both = states_at(band, start, {1.2, 3}, careful_step);
    auto const before = states_at(lively(), start, {1.2}, careful_step).back();
    for (std::size_t i = 0; i < channel_count; ++i)
        CHECK_THAT(both[0][i], WithinAbs(before[i], 1e-10));
    world rest = band;
    rest.acting = {};
    for (auto* p : {&rest.motor, &rest.rudder}) {
        polyline const whole = *p;
        *p = sampled([&](double t) { return whole.at(t + 1.2); }, 1.8);
    }
    channels handed{};
    std::copy_n(before.begin(), channel_count, handed.begin());
    auto const after = states_at(rest, handed, {1.8}, careful_step).back();
    for (std::size_t i = 0; i < channel_count; ++i)
        CHECK_THAT(both[1][i], WithinAbs(after[i], 1e-4)); // knots of `rest` lie elsewhere

    world never = lively();
    never.e.payload = 0.2;
    act_within(never, {for_ever});
    CHECK(states_at(never, start, {3}, 1e-3).back() ==
          states_at(lively(), start, {3}, 1e-3).back());

    // From 0.8 to 1.1 s: what was gained by then stays.
    act_within(w, {0.8, 1.1});
    auto const ended = states_at(w, {0, 0, 0, 0, 0, 0}, {1.1, 2}, careful_step);
    for (auto const& s : ended) CHECK_THAT(s[0], WithinAbs(0.03 * 9.81 * 0.3, 1e-9));
    CHECK(readings(w, {0, 0, 0, 0, 0, 0}, {1.2}, careful_step)[0][2] == 0);
    // From the start, until the rudder is what is commanded again.
    world whole = band, first = band;
    whole.acting = {};
    act_within(first, {0, 1.2});
    auto const same = states_at(whole, start, {1.2}, careful_step).back();
    auto const first_states = states_at(first, start, {1.2, 3}, careful_step);
    world then = lively();
    for (auto* p : {&then.motor, &then.rudder}) {
        polyline const all = *p;
        *p = sampled([&](double t) { return all.at(t + 1.2); }, 1.8);
    }
    channels passed{};
    std::copy_n(same.begin(), channel_count, passed.begin());
    auto const later = states_at(then, passed, {1.8}, careful_step).back();
    for (std::size_t i = 0; i < channel_count; ++i) {
        CHECK_THAT(first_states[0][i], WithinAbs(same[i], 1e-10));
        CHECK_THAT(first_states[1][i], WithinAbs(later[i], 1e-4));
    }
}

TEST_CASE("what acts in place of the inputs") {
    world w = lively();
    w.e.rudder_trim = 0.05;
    w.e.rudder_limit = 0.3;
    w.e.battery_sag = 0.1;
    auto const acts = effective(w, 2, {90, 0.4}, {});
    CHECK_THAT(acts.rudder, WithinAbs(0.35, 1e-15));
    CHECK_THAT(acts.motor, WithinAbs(72, 1e-12));
}
