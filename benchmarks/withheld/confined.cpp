// SPDX-License-Identifier: MIT
#include "confined.hpp"

#include "reading.hpp"

#include <algorithm>
#include <cmath>

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

std::optional<bool> is_confined_to(label const& truth, recording const& data, json const& part) {
    auto const scenarios = names_in(member(part, "scenarios"));
    auto const channel = text_of(member(part, "channel"));
    if (truth.family == "bounds") return truth.names() == names{"bounds_" + channel};
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
