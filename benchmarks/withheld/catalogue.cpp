// SPDX-License-Identifier: MIT
#include "catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <limits>

namespace withheld {

std::vector<effect> const& catalogue() {
    using v = effect_values;
    static std::vector<effect> const all{
        {"wind",
         {{"wx", &v::wind_x, -2, 2, 0.2, 0.7, true}, {"wy", &v::wind_y, -2, 2, 0.2, 0.7, true}}},
        {"rudder_lag", {{"tau", &v::rudder_lag, 0, 1, 0.1, 0.3, false}}},
        {"input_delay", {{"tau", &v::input_delay, 0, 0.5, 0.08, 0.2, false}}},
        {"rudder_trim", {{"d0", &v::rudder_trim, -0.2, 0.2, 0.03, 0.08, true}}},
        {"thrust_offset", {{"yT", &v::thrust_offset, -0.02, 0.02, 0.003, 0.008, true}}},
        {"cg_offset", {{"xg", &v::cg_offset, -0.1, 0.1, 0.015, 0.05, true}}},
        {"ground_slope",
         {{"sx", &v::slope_x, -0.05, 0.05, 0.007, 0.02, true},
          {"sy", &v::slope_y, -0.05, 0.05, 0.007, 0.02, true}}},
        {"battery_sag", {{"k", &v::battery_sag, 0, 0.15, 0.02, 0.06, false}}},
        {"quadratic_yaw_damping", {{"k", &v::quadratic_yaw_damping, 0, 0.3, 0.03, 0.12, false}}},
        {"linear_surge_damping", {{"k", &v::linear_surge_damping, 0, 1, 0.12, 0.4, false}}},
        {"payload", {{"dm", &v::payload, 0, 0.5, 0.1, 0.3, false}}},
        {"gyro_bias", {{"b", &v::gyro_bias, -0.5, 0.5, 0.08, 0.2, true}}},
        {"heading_bias", {{"b", &v::heading_bias, -0.3, 0.3, 0.06, 0.15, true}}},
        {"rudder_saturation", {{"lim", &v::rudder_limit, 0.05, 1, 0.15, 0.3, false}}},
        {"rudder_deadband", {{"b", &v::rudder_deadband, 0, 0.3, 0.05, 0.12, false}}},
        {"position_scale", {{"k", &v::position_scale, -0.2, 0.2, 0.03, 0.1, true}}},
        {"motor_lag", {{"tau", &v::motor_lag, 0, 1, 0.1, 0.35, false}}},
        {"dry_yaw_friction", {{"k", &v::dry_yaw_friction, 0, 0.15, 0.015, 0.05, false}}},
        {"friction_anisotropy", {{"k", &v::friction_anisotropy, -0.9, 2, 0.3, 0.8, true}}},
        {"position_latency", {{"tau", &v::position_latency, 0, 0.5, 0.06, 0.2, false}}},
        {"thrust_loss_with_speed", {{"k", &v::thrust_loss, 0, 0.3, 0.03, 0.1, false}}},
        {"rudder_backlash", {{"b", &v::rudder_play, 0, 0.15, 0.03, 0.1, false}}},
        {"stribeck",
         {{"k", &v::stribeck_rise, 0, 2, 0.6, 1.5, false},
          {"vs", &v::stribeck_speed, 0.2, 1, 0.3, 0.8, false}}},
        {"rudder_rate_limit", {{"R", &v::rudder_rate, 0.02, 2, 0.04, 0.2, false}}}};
    return all;
}

namespace {

constexpr std::string_view wider = "_wider";

std::vector<effect> wider_catalogue() {
    static std::deque<std::string> names; // effects refer to them
    auto all = catalogue();
    for (auto& e : all) {
        bool const vanishes_above = e.name == "rudder_saturation" || e.name == "rudder_rate_limit";
        e.name = names.emplace_back(std::string{e.name} + std::string{wider});
        for (auto& p : e.parameters) {
            p.lo *= p.lo < 0 ? 4 : 0.25;
            if (!vanishes_above) p.hi *= p.hi > 0 ? 4 : 0.25;
        }
    }
    return all;
}

} // namespace

effect const* effect_named(std::string_view name) {
    name = name.substr(0, name.find('@'));
    static std::vector<effect> const wide = wider_catalogue();
    for (auto const* all : {&catalogue(), &wide})
        for (auto const& e : *all)
            if (e.name == name) return &e;
    return nullptr;
}

std::string plain_name(std::string_view name) {
    name = name.substr(0, name.find('@'));
    return std::string{name.substr(0, name.size() - (name.ends_with(wider) ? wider.size() : 0))};
}

episode episode_in(std::string_view name, std::string_view scenario) {
    auto at = name.find('@');
    if (at == std::string_view::npos) return {};
    while (at < name.size()) {
        auto const end = std::min(name.find('+', at + 1), name.size());
        auto one = name.substr(at + 1, end - at - 1);
        auto const cut = [&](std::string_view sign, double otherwise) {
            auto const when = one.find(sign);
            if (when == one.npos) return otherwise;
            std::string const time{one.substr(when + sign.size())};
            one = one.substr(0, when);
            return std::strtod(time.c_str(), nullptr);
        };
        episode result;
        result.to = cut("<", for_ever);
        result.from = cut(">=", 0);
        if (one == scenario) return result;
        at = end;
    }
    return {for_ever, for_ever};
}

std::string six_digits(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

double rounded(double value) { return std::strtod(six_digits(value).c_str(), nullptr); }

void draw_size(effect const& which, random_source& random, double scale, double largest_rudder,
               effect_values& e) {
    for (auto const& p : which.parameters) {
        double size = random.uniform(p.small, p.large);
        if (p.member == &effect_values::rudder_limit)
            size = largest_rudder - scale * (largest_rudder - size); // neutral is "nothing clipped"
        else
            size *= scale;
        if (p.either_sign) size *= random.sign();
        e.*p.member = rounded(size);
    }
}

std::string described(effect const& which, effect_values const& e) {
    std::string text{which.name};
    char separator = '(';
    for (auto const& p : which.parameters) {
        text += separator + six_digits(e.*p.member);
        separator = ',';
    }
    return text + ')';
}

} // namespace withheld
