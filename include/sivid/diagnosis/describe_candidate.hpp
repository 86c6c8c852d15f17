// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DESCRIBE_CANDIDATE_HPP
#define SIVID_DIAGNOSIS_DESCRIBE_CANDIDATE_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/place_estimate.hpp>
#include <sivid/diagnosis/screening.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

[[nodiscard]] inline std::vector<std::string> names_of(candidate const& c,
                                                       std::vector<effect> const& catalogue) {
    std::vector<std::string> names;
    for (auto const e : c.effects) names.push_back(catalogue[e].name);
    return names;
}

/// A parameter of a problem with its unit and a value.
[[nodiscard]] inline named_estimate named_parameter(identification_problem const& p, std::size_t j,
                                                    double value) {
    auto const& name = p.choice.unknown[j];
    auto const& about = p.model.about;
    return {name, about.constants[index_of(about.constants, name, "constant")].unit, value,
            std::nullopt};
}

/// What the fit of a candidate says; nothing in it is proved yet.
/// @param own  how many parameters the model itself has
[[nodiscard]] inline cause cause_of(screened const& s, std::vector<effect> const& catalogue,
                                    std::size_t own, std::size_t measurements) {
    cause c;
    c.effects = names_of(s.figures, catalogue);
    c.fitted_inflation = s.figures.inflation;
    c.score = s.figures.score(measurements);
    for (std::size_t j = own; j < s.fit.parameters.size(); ++j) {
        c.parameters.push_back(named_parameter(s.problem, j, s.fit.parameters[j]));
    }
    return c;
}

/// A witness with the names of parameters, scenarios and states.
[[nodiscard]] inline named_witness named(identification_problem const& p,
                                         std::vector<double> const& parameters,
                                         std::vector<std::vector<double>> const& starts) {
    named_witness result;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        result.parameters.push_back(named_parameter(p, j, parameters[j]));
    }
    for (std::size_t e = 0; e < starts.size(); ++e) {
        named_witness::start start{p.experiments[e].name, {}};
        for (std::size_t i = 0; i < starts[e].size(); ++i) {
            auto const& state = p.model.about.states[i];
            start.states.push_back({state.name, state.unit, starts[e][i], std::nullopt});
        }
        result.starts.push_back(std::move(start));
    }
    return result;
}

namespace diagnosis_detail {

/// Sums of sampling periods lose their last digits.
[[nodiscard]] inline double shown_time(double t) { return std::round(t * 1e9) / 1e9; }

} // namespace diagnosis_detail

/// A place where model and data part, as a diagnosis states it.
[[nodiscard]] inline suspected_place described(estimated_place const& p) {
    suspected_place s;
    s.kind = p.kind == place_kind::sensor  ? "sensor"
             : p.kind == place_kind::input ? "input"
                                           : "equation";
    s.name = p.name;
    s.where = {p.scenario, diagnosis_detail::shown_time(p.from),
               diagnosis_detail::shown_time(p.to)};
    s.estimate = p.missing;
    s.unit = p.unit;
    s.law = p.law;
    s.regime = p.regime;
    return s;
}

/// Whether there is a gap, and where.
[[nodiscard]] inline std::string first_sentence_of(diagnosis const& d) {
    std::string text = d.gap == gap_verdict::certified
                           ? "a gap is proved"
                           : "no parameter was found that explains the data";
    for (std::size_t k = 0; k < d.where.size(); ++k) {
        text += (k == 0 ? ": " : ", ") + d.where[k].kind + " " + d.where[k].name;
    }
    return text;
}

} // namespace sivid

#endif
