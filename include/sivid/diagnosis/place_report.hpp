// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_PLACE_REPORT_HPP
#define SIVID_DIAGNOSIS_PLACE_REPORT_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/place_estimate.hpp>
#include <sivid/diagnosis/relation_finding.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sivid {

[[nodiscard]] inline broken_relation_report reported(relation_finding const& f) {
    broken_relation_report r{f.name, f.channels, f.proved, f.assumptions, {}};
    for (auto const& w : f.windows) r.windows.push_back({w.scenario, w.from, w.to});
    return r;
}

/// Whether a proof about an equation and its sensors is one about the equation: none of these
/// sensors, nor an input, is suspected itself.
[[nodiscard]] inline bool is_about_equation(relation_finding const& f,
                                            std::vector<estimated_place> const& suspected) {
    return std::none_of(suspected.begin(), suspected.end(), [&f](estimated_place const& p) {
        bool const read =
            std::find(f.channels.begin(), f.channels.end(), p.name) != f.channels.end();
        return p.kind == place_kind::input || (p.kind == place_kind::sensor && read);
    });
}

/// An estimated place; where its equation is proved broken, with the proof's window and missing
/// rate.
/// @param findings  the broken relations that are about an equation
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
    std::vector<relation_finding> about_equations;
    for (auto const& f : findings) {
        if (is_about_equation(f, estimate.places)) about_equations.push_back(f);
    }
    std::vector<suspected_place> result;
    for (auto const& p : estimate.places) result.push_back(reported(p, about_equations));
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
