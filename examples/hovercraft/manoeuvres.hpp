// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_MANOEUVRES_HPP
#define HOVERCRAFT_MANOEUVRES_HPP

#include <sivid/diagnosis/manoeuvre.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// What the craft can be told to do next, so that rival explanations part.
namespace hovercraft_example {

/// Their settings within what rotor and rudder can do: a step of the rudder, a weaving
/// course, and a rotor that is switched on and off while the rudder turns.
inline std::vector<sivid::manoeuvre> new_manoeuvres() {
    using sivid::interpolation;
    using sivid::sampled_signal;
    auto const sampled = [](double duration, auto const& f) {
        std::vector<double> t, v;
        for (int k = 0; 0.05 * k <= duration + 1e-9; ++k) {
            t.push_back(0.05 * k);
            v.push_back(f(t.back()));
        }
        return sampled_signal(std::move(t), std::move(v), interpolation::linear);
    };
    std::vector<double> const slow{1, 0, 0, 0, 0, 0};
    sivid::manoeuvre_setting const rotor{"W", "1/s", 40, 250};
    sivid::manoeuvre_setting const rudder{"delta", "rad", 0.05, 0.6};
    return {
        {"rudder step at 1 s, to the other side at 3 s",
         5,
         slow,
         {rotor, rudder},
         [sampled](std::vector<double> const& s) -> std::vector<sivid::signal> {
             return {sampled(5, [&](double) { return s[0]; }), sampled(5, [&](double t) {
                         return t < 1 ? 0.0 : t < 3 ? s[1] : -s[1];
                     })};
         }},
        {"weaving course",
         6,
         slow,
         {rotor, rudder, {"frequency", "Hz", 0.1, 1}},
         [sampled](std::vector<double> const& s) -> std::vector<sivid::signal> {
             return {sampled(6, [&](double) { return s[0]; }), sampled(6, [&](double t) {
                         return s[1] * std::sin(6.283185307179586 * s[2] * t);
                     })};
         }},
        {"rotor on for 2 s, off for 2 s and on again, rudder held",
         6,
         slow,
         {rotor, rudder},
         [sampled](std::vector<double> const& s) -> std::vector<sivid::signal> {
             return {sampled(6, [&](double t) { return t < 2 || t >= 4 ? s[0] : 0.0; }),
                     sampled(6, [&](double) { return s[1]; })};
         }},
    };
}

} // namespace hovercraft_example

#endif
