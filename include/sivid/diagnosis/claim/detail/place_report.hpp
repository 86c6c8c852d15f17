// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_PLACE_REPORT_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_PLACE_REPORT_HPP

#include <sivid/approximate/place/estimated_place.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/relation/relation_finding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

[[nodiscard]] inline broken_relation_report reported(relation_finding const& f) {
    broken_relation_report r{f.name, f.channels, f.proved, f.assumptions, {}, f.definition};
    for (auto const& w : f.windows) r.windows.push_back({w.scenario, w.from, w.to});
    return r;
}

/// Whether no sensor of a relation, and no input, is suspected itself.
[[nodiscard]] inline bool is_about_equation(relation_finding const& f,
                                            std::vector<estimated_place> const& suspected) {
    return std::none_of(suspected.begin(), suspected.end(), [&f](estimated_place const& p) {
        bool const read =
            std::find(f.channels.begin(), f.channels.end(), p.name) != f.channels.end();
        return p.kind == place_kind::input || (p.kind == place_kind::sensor && read);
    });
}

/// Whether faults of sensors or inputs, and of no equation, were found that explain the data: of
/// several at once, too, such as an instrument of two channels that is mounted askew.
[[nodiscard]] inline bool instruments_explain(place_estimate const& estimate) {
    return std::any_of(estimate.tried.begin(), estimate.tried.end(), [](tried_places const& t) {
        return t.inflation <= 1 && !t.names.empty() &&
               std::all_of(t.names.begin(), t.names.end(), [](std::string const& name) {
                   return name.starts_with("sensor ") || name.starts_with("input ");
               });
    });
}

/// Whether the fault of one sensor was found to explain the data.
[[nodiscard]] inline bool one_sensor_explains(place_estimate const& estimate) {
    return std::any_of(estimate.tried.begin(), estimate.tried.end(), [](tried_places const& t) {
        return t.inflation <= 1 && t.names.size() == 1 && t.names.front().starts_with("sensor ");
    });
}

/// The mean of an estimated missing rate over a window; nothing where none was estimated.
[[nodiscard]] inline std::optional<double> mean_missing(estimated_place const& p,
                                                        relation_window const& w) {
    for (auto const& r : p.rates) {
        if (r.scenario != w.scenario || r.times.size() < 2 || !(w.from < w.to)) continue;
        double const from = std::max(w.from, r.times.front());
        double const to = std::min(w.to, r.times.back());
        if (!(from < to)) continue;
        double sum = 0;
        for (std::size_t k = 0; k + 1 < r.times.size(); ++k) {
            double const a = std::max(from, r.times[k]);
            double const b = std::min(to, r.times[k + 1]);
            if (!(a < b)) continue;
            double const slope = (r.values[k + 1] - r.values[k]) / (r.times[k + 1] - r.times[k]);
            sum += (b - a) * (r.values[k] + slope * ((a + b) / 2 - r.times[k]));
        }
        return sum / (to - from);
    }
    return std::nullopt;
}

/// Sums of sampling periods lose their last digits: times to a billionth of what they are apart.
[[nodiscard]] inline time_window shown_window(std::string scenario, double from, double to) {
    if (!(to > from)) return {std::move(scenario), from, to};
    double const digits = std::pow(10, 9 - std::floor(std::log10(to - from)));
    auto const shown = [digits](double t) { return std::round(t * digits) / digits; };
    return {std::move(scenario), shown(from), shown(to)};
}

/// An estimated place; where its equation is proved to be what is wrong, with the proof's window,
/// and its missing rate there.
///   A rate in which no constant acts is a definition, and its sensors are what is wrong: the one
///   of its own state is named, the others of the row beside it.
[[nodiscard]] inline suspected_place reported(estimated_place const& p,
                                              std::vector<relation_finding> const& findings = {}) {
    suspected_place s;
    s.kind = p.kind == place_kind::sensor  ? "sensor"
             : p.kind == place_kind::input ? "input"
                                           : "equation";
    s.name = p.name;
    s.where = shown_window(p.scenario, p.from, p.to);
    if (p.kind == place_kind::kinematic && !p.sensors.empty()) {
        s.kind = "sensor";
        s.name = p.sensors.front();
        s.alternatives.assign(p.sensors.begin() + 1, p.sensors.end());
        for (auto& name : s.alternatives) name = "sensor " + name;
        return s;
    }
    s.estimate = p.missing;
    s.unit = p.unit;
    s.law = p.law;
    s.regime = p.regime;
    if (p.kind != place_kind::equation) return s;
    for (auto const& f : findings) {
        if (f.name != s.name || !f.proved || !f.place) continue;
        s.proved = true;
        s.assumptions = f.place->assumptions;
        if (!f.place->missing || contains(f.place->missing->value, 0)) return s;
        auto const& [window, value, unit] = *f.place->missing;
        s.missing = value;
        s.where = shown_window(window.scenario, window.from, window.to);
        s.estimate = mean_missing(p, window);
        // What lies outside is known to be wrong.
        if (s.estimate) s.estimate = std::clamp(*s.estimate, value.lower(), value.upper());
    }
    return s;
}

/// Where the model departs from the data, most important first; the first one has the alternatives.
[[nodiscard]] inline std::vector<suspected_place>
reported(place_estimate const& estimate, std::vector<relation_finding> const& findings = {}) {
    std::vector<relation_finding> about_equations;
    for (auto const& f : findings) {
        bool const about = is_about_equation(f, estimate.places) && !instruments_explain(estimate);
        if (about) about_equations.push_back(f);
    }
    std::vector<suspected_place> result;
    for (auto const& p : estimate.places) {
        auto s = reported(p, about_equations);
        auto const known = std::find_if(result.begin(), result.end(), [&s](auto const& other) {
            return other.kind == s.kind && other.name == s.name;
        });
        if (known == result.end()) {
            result.push_back(std::move(s));
        } else if (s.estimate && !known->estimate) { // a sensor by itself and by its definition
            s.alternatives = known->alternatives;
            *known = std::move(s);
        }
    }
    if (result.empty()) return result;
    for (auto const& set : estimate.alternatives)
        result.front().alternatives.push_back(joined(set, " and "));
    return result;
}

} // namespace sivid

#endif
