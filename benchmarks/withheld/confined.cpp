// SPDX-License-Identifier: MIT
#include "confined.hpp"

#include "reading.hpp"
#include "simulate.hpp"
#include "witness.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace withheld {

std::string confined_text(json const& part) {
    auto const channel = text_of(member(part, "channel"));
    auto const scenarios = names_in(member(part, "scenarios"));
    return channel + (channel.empty() || scenarios.empty() ? "" : " in ") + joined(scenarios, "");
}

recording loosened(recording data, json const& part, double factor) {
    auto const channel = text_of(member(part, "channel"));
    auto const scenarios = names_in(member(part, "scenarios"));
    for (auto& s : data.scenarios) {
        if (!scenarios.empty() && !scenarios.contains(s.plan.name)) continue;
        for (auto& m : s.samples)
            if (channel.empty() || channel == channel_names[m.channel]) m.error *= factor;
    }
    return data;
}

std::optional<recording> grown(recording data, json const& part, double units) {
    auto const grows = member(part, "grows");
    bool const by_rate = text_of(member(grows, "with")) == "rate";
    auto const shown = member(grows, "shown");
    auto const channel = text_of(member(part, "channel"));
    auto const fit = world_of(data, json{{"effects", json::array()}}, shown);
    if (!fit) return std::nullopt;
    for (auto& s : data.scenarios) {
        auto w = *fit;
        w.motor = s.plan.motor;
        w.rudder = s.plan.rudder;
        auto const& when = s.plan.sample_times;
        auto const model = readings(w, start_of(s.plan, shown), when, careful_step);
        std::set<std::size_t> measured;
        for (auto const& m : s.samples)
            if (channel == channel_names[m.channel]) measured.insert(m.time);
        for (auto& m : s.samples) {
            if (channel != channel_names[m.channel]) continue;
            auto const at = [&](std::size_t i) { return model[i][m.channel]; };
            auto const now = measured.find(m.time), after = std::next(now);
            auto const from = now == measured.begin() ? *now : *std::prev(now);
            auto const to = after == measured.end() ? *now : *after;
            double const lasts = when[to] - when[from];
            double const rate = lasts > 0 ? (at(to) - at(from)) / lasts : 0;
            m.error += units * std::abs(by_rate ? rate : at(m.time));
        }
    }
    return data;
}

std::optional<bool> is_confined_to(label const& truth, recording const& data, json const& part) {
    auto const scenarios = names_in(member(part, "scenarios"));
    auto const channel = text_of(member(part, "channel"));
    if (truth.family == "bounds") return truth.names() == names{"bounds_" + channel};
    if (truth.family == "reading" && truth.names() != names{"wraps_psi"})
        return truth.names() == names{"steps_" + channel} && member(part, "steps").is_object();
    if (truth.family == "slow")
        return truth.names() == names{"slow_" + channel} && member(part, "correlated").is_object();
    if (truth.family == "noise") {
        auto const with = text_of(member(member(part, "grows"), "with"));
        return (with == "rate" && truth.names() == names{"jitter_" + channel}) ||
               (with == "value" && truth.names() == names{"growing_" + channel});
    }
    if (truth.family != "experiments") return std::nullopt;
    names acting;
    bool everywhere = true;
    for (auto const& s : data.scenarios) {
        if (s.plan.holdout) continue;
        bool const acts = !true_episode(truth, s.plan.name).never();
        if (acts) acting.insert(s.plan.name);
        everywhere = everywhere && acts;
    }
    if (everywhere) return std::nullopt;
    return !scenarios.empty() && includes(acting, scenarios);
}

} // namespace withheld
