// SPDX-License-Identifier: MIT
#include "craft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace withheld {

double constants::*constant_named(std::string_view name) {
    using entry = std::pair<std::string_view, double constants::*>;
    static constexpr std::array<entry, 17> all{{{"m", &constants::m},
                                                {"Iz", &constants::Iz},
                                                {"rho", &constants::rho},
                                                {"Cd", &constants::Cd},
                                                {"CL", &constants::CL},
                                                {"Cdelta", &constants::Cdelta},
                                                {"D", &constants::D},
                                                {"Su", &constants::Su},
                                                {"Sv", &constants::Sv},
                                                {"Sg", &constants::Sg},
                                                {"A", &constants::A},
                                                {"L", &constants::L},
                                                {"Ff", &constants::Ff},
                                                {"eps", &constants::eps},
                                                {"D11", &constants::D11},
                                                {"D22", &constants::D22},
                                                {"D33", &constants::D33}}};
    for (auto const& [known, member] : all)
        if (known == name) return member;
    return nullptr;
}

double polyline::at(double time) const {
    if (time <= t.front()) return value.front();
    if (time >= t.back()) return value.back();
    auto const after =
        static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin());
    double const share = (time - t[after - 1]) / (t[after] - t[after - 1]);
    return value[after - 1] + share * (value[after] - value[after - 1]);
}

double polyline::largest_magnitude() const {
    double most = 0;
    for (double const x : value) most = std::max(most, std::abs(x));
    return most;
}

double behind_deadband(double delta, double band) {
    if (delta > band) return delta - band;
    if (delta < -band) return delta + band;
    return 0;
}

polyline behind_play(polyline const& recorded, double half_width) {
    if (half_width <= 0) return recorded;
    double t = 0, command = recorded.at(0);
    double rest = command; // where the end that is driven stands
    polyline driven{{t}, {rest}};
    for (std::size_t i = 0; i < recorded.t.size(); ++i) {
        double const next_t = recorded.t[i], next = recorded.value[i];
        if (next_t <= t) continue;
        // The side of the gap that the command would reach, going this way.
        double const side = rest + (next > command ? half_width : -half_width);
        bool const pushes = next > command ? next > side : next < side;
        if (pushes) {
            double const share = (side - command) / (next - command);
            if (share > 0) {
                driven.t.push_back(t + share * (next_t - t));
                driven.value.push_back(rest);
            }
            rest += next - side;
        }
        driven.t.push_back(next_t);
        driven.value.push_back(rest);
        t = next_t;
        command = next;
    }
    return driven;
}

polyline behind_rate_limit(polyline const& recorded, double most) {
    if (std::isinf(most)) return recorded;
    double t = 0, command = recorded.at(0);
    polyline driven{{t}, {command}};
    double rest = command;
    for (std::size_t i = 0; i < recorded.t.size(); ++i) {
        double const next_t = recorded.t[i], next = recorded.value[i];
        if (next_t <= t) continue;
        double const slope = (next - command) / (next_t - t), ahead = command - rest;
        // On its way towards the command, by `most`, until both meet.
        double const way = ahead != 0 ? std::copysign(most, ahead) : std::clamp(slope, -most, most);
        double const closing = way - slope;
        double const meets = ahead != 0 && ahead * closing > 0 ? t + ahead / closing : next_t;
        if (meets < next_t) {
            driven.t.push_back(meets);
            driven.value.push_back(rest + way * (meets - t));
            rest = driven.value.back() + std::clamp(slope, -most, most) * (next_t - meets);
        } else {
            rest += way * (next_t - t);
        }
        driven.t.push_back(next_t);
        driven.value.push_back(rest);
        t = next_t;
        command = next;
        if (std::abs(command - rest) < 1e-15) rest = command; // both have met, but for rounding
    }
    return driven;
}

polyline driven_rudder(world const& w) {
    return behind_play(behind_rate_limit(w.rudder, w.e.rudder_rate), w.e.rudder_play);
}

namespace {

double gust_force(std::vector<gust_pulse> const& gusts, double t) {
    double sum = 0;
    for (auto const& g : gusts) {
        double const phase = (t - g.begin) / g.length;
        if (phase <= 0 || phase >= 1) continue;
        double const s = std::sin(std::numbers::pi * phase);
        sum += g.force * s * s;
    }
    return sum;
}

/// The angle at the rudder's hinge, and the rates of what moves it.
double rudder_angle(world const& w, command const& now, state const& s, state& rate) {
    double angle = now.rudder;
    if (w.f.servo_frequency > 0) {
        double const omega = w.f.servo_frequency;
        angle = s[6];
        rate[6] = s[8];
        rate[8] = omega * omega * (now.rudder - s[6]) - 2 * w.f.servo_damping * omega * s[8];
    } else if (w.e.rudder_lag > 0) {
        if (!w.lags_unseen) angle = s[6];
        rate[6] = (now.rudder - s[6]) / w.e.rudder_lag;
    }
    return std::clamp(angle, -w.e.rudder_limit, w.e.rudder_limit) + w.e.rudder_trim;
}

double motor_speed(world const& w, double t, command const& now, state const& s, state& rate) {
    double const fed = now.motor * (1 - w.e.battery_sag * t);
    if (w.e.motor_lag <= 0) return fed;
    rate[7] = (fed - s[7]) / w.e.motor_lag;
    return w.lags_unseen ? fed : s[7];
}

} // namespace

state derivative(world const& w, double t, command const& now, state const& s, state const& start) {
    auto const& c = w.c;
    auto const& e = w.e;
    auto const& f = w.f;
    double const u = s[0], v = s[1], r = s[2];
    double const cosine = std::cos(s[5]), sine = std::sin(s[5]);
    double const mass = c.m + e.payload;
    state rate{};

    double const delta = rudder_angle(w, now, s, rate);
    double const speed = motor_speed(w, t, now, s, rate);
    double const thrust =
        c.Cdelta * c.rho * c.D * c.D * c.D * c.D * speed * speed * (1 - e.thrust_loss * u);

    double const V = std::sqrt(u * u + v * v + c.eps * c.eps);
    double const air_u = u - (cosine * e.wind_x + sine * e.wind_y);
    double const air_v = v - (-sine * e.wind_x + cosine * e.wind_y);
    double const air_V = std::sqrt(air_u * air_u + air_v * air_v + c.eps * c.eps);
    double const pressure = 0.5 * c.rho * c.Cd;
    double friction = c.Ff;
    if (e.stribeck_rise > 0)
        friction *=
            1 + e.stribeck_rise * std::exp(-(V / e.stribeck_speed) * (V / e.stribeck_speed));
    double const lift = c.CL * thrust * delta / (4 * c.A);

    double X = thrust - friction * u / V - pressure * c.Su * air_V * air_u - c.D11 * u -
               e.linear_surge_damping * u;
    double Y = lift * c.Sv - friction * (1 + e.friction_anisotropy) * v / V -
               pressure * c.Sv * air_V * air_v - c.D22 * v + gust_force(w.gusts, t) +
               f.swell_force * std::sin(f.swell_frequency * t);
    double const N = -c.L * lift * c.Sg - c.D33 * r + thrust * e.thrust_offset -
                     e.quadratic_yaw_damping * std::abs(r) * r - f.weathervane * u * v -
                     e.dry_yaw_friction * r / std::sqrt(r * r + 0.01 * 0.01);

    X -= f.cubic_drag * u * u * u;
    Y -= f.cross_coupling * u * r;
    double const weight = mass * 9.81;
    double world_x = weight * e.slope_x, world_y = weight * e.slope_y; // forces in the fixed frame
    if (f.tether_stiffness > 0) {
        double const dx = s[3] - start[3], dy = s[4] - start[4];
        double const distance = std::hypot(dx, dy);
        if (distance > f.tether_slack) {
            double const pull = f.tether_stiffness * (distance - f.tether_slack) / distance;
            world_x -= pull * dx;
            world_y -= pull * dy;
        }
    }
    X += cosine * world_x + sine * world_y;
    Y += -sine * world_x + cosine * world_y;

    // Two equations for v' and r', coupled by the offset of the centre of gravity (Cramer's rule).
    double const xg = e.cg_offset;
    double const a = mass, b = mass * xg, d = c.Iz + mass * xg * xg;
    double const right_v = Y - mass * u * r, right_r = N - mass * xg * u * r;
    double const determinant = a * d - b * b;
    rate[0] = v * r + X / mass + xg * r * r;
    rate[1] = (right_v * d - b * right_r) / determinant;
    rate[2] = (a * right_r - b * right_v) / determinant;
    rate[3] = u * cosine - v * sine;
    rate[4] = u * sine + v * cosine;
    rate[5] = r;
    return rate;
}

command effective(world const& w, double t, command const& now, state const& s) {
    state rate{};
    return {motor_speed(w, t, now, s, rate), rudder_angle(w, now, s, rate)};
}

channels sensed(world const& w, double t, state const& s) {
    effect_values const e = w.acting.holds(t) ? w.e : effect_values{};
    auto const& fault = w.instruments;
    auto const turned = [](double a, double b, double angle) {
        return std::pair{std::cos(angle) * a + std::sin(angle) * b,
                         -std::sin(angle) * a + std::cos(angle) * b};
    };
    double const cosine = std::cos(s[5]), sine = std::sin(s[5]);
    auto const [u, v] = turned(s[0] - fault.velocity_side * s[2], s[1] + fault.velocity_arm * s[2],
                               fault.velocity_turn);
    auto const [x, y] =
        turned(s[3] + fault.antenna_x * cosine - fault.antenna_y * sine,
               s[4] + fault.antenna_x * sine + fault.antenna_y * cosine, fault.position_turn);
    double const scale = 1 + e.position_scale;
    channels shown{u, v, s[2] + e.gyro_bias, scale * x, scale * y, s[5] + e.heading_bias};
    for (std::size_t k = 0; k < channel_count; ++k) shown[k] += fault.drift[k] * t;
    return shown;
}

void act_within(world& w, episode const& when) {
    w.acting = {};
    if (when.always()) return;
    if (when.never())
        w.e = {};
    else
        w.acting = when;
}

} // namespace withheld
