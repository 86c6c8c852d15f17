// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_PLACE_REPORT_HPP
#define SIVID_DIAGNOSIS_PLACE_REPORT_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/place_estimate.hpp>
#include <sivid/diagnosis/relation_finding.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace sivid {

[[nodiscard]] inline broken_relation_report reported(relation_finding const& f) {
    broken_relation_report r{f.name, f.channels, f.proved, f.assumptions, {}};
    for (auto const& w : f.windows) r.windows.push_back({w.scenario, w.from, w.to});
    return r;
}

/// An estimated place; where its equation is proved broken, with the proof's window and missing
/// rate.
[[nodiscard]] inline suspected_place reported(estimated_place const& p,
                                              std::vector<relation_finding> const& findings = {}) {
    // Sums of sampling periods lose their last digits.
    auto const shown_time = [](double t) { return std::round(t * 1e9) / 1e9; };
    suspected_place s;
    s.kind = p.kind == place_kind::sensor  ? "sensor"
             : p.kind == place_kind::input ? "input"
                                           : "equation";
    s.name = p.name;
    s.where = {p.scenario, shown_time(p.from), shown_time(p.to)};
    s.estimate = p.missing;
    s.unit = p.unit;
    s.law = p.law;
    s.regime = p.regime;
    if (p.kind != place_kind::equation) return s;
    for (auto const& f : findings) {
        if (f.name != s.name) continue;
        s.proved = f.proved;
        if (!f.missing) return s;
        s.missing = f.missing->value;
        s.where = {f.missing->window.scenario, f.missing->window.from, f.missing->window.to};
    }
    return s;
}

/// Where the model departs from the data, most important first; the first one has the alternatives.
[[nodiscard]] inline std::vector<suspected_place>
reported(place_estimate const& estimate, std::vector<relation_finding> const& findings = {}) {
    std::vector<suspected_place> result;
    for (auto const& p : estimate.places) result.push_back(reported(p, findings));
    if (result.empty()) return result;
    for (auto const& set : estimate.alternatives) {
        std::string text;
        for (auto const& name : set) text += (text.empty() ? "" : " and ") + name;
        result.front().alternatives.push_back(text);
    }
    return result;
}

} // namespace sivid

#endif
