// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_DESCRIBE_CANDIDATE_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_DESCRIBE_CANDIDATE_HPP

#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/structure/find_combinations.hpp>

#include <algorithm>
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
            std::nullopt, p.prior[j]};
}

/// All parameters of a problem with these values.
[[nodiscard]] inline std::vector<named_estimate>
named_parameters(identification_problem const& p, std::vector<double> const& values) {
    std::vector<named_estimate> result;
    for (std::size_t j = 0; j < std::min(values.size(), p.prior.size()); ++j) {
        result.push_back(named_parameter(p, j, values[j]));
    }
    return result;
}

/// A parameter's name without that of its effect.
[[nodiscard]] inline std::string short_name(std::string const& name) {
    auto const dot = name.rfind('.');
    return dot == std::string::npos ? name : name.substr(dot + 1);
}

/// The products and sums of a hull that say at least twice as much as its sides do, at these values
/// of the parameters.
[[nodiscard]] inline std::vector<named_combination>
told_combinations(identification_problem const& p, std::vector<named_estimate> const& values,
                  explained_hull const& hulls) {
    std::vector<std::string> names;
    for (auto const& name : p.choice.unknown) names.push_back(short_name(name));
    std::vector<named_combination> result;
    for (auto const& [what, hull] : hulls.products) {
        if (is_empty(hull) || width(hull) > 0.5 * width(what.over(hulls.parameters))) continue;
        named_combination told;
        told.is_sum = what.is_sum();
        auto const& numbers = told.is_sum ? what.signs : what.exponents;
        auto& about = told.about = {told.is_sum ? model_detail::sum_text(names, numbers)
                                                : model_detail::product_text(names, numbers),
                                    what.unit, told.is_sum ? 0.0 : 1.0, hull, what.over(p.prior)};
        for (std::size_t j = 0; j < numbers.size(); ++j) {
            if (numbers[j] == 0) continue;
            told.parts.push_back({p.choice.unknown[j], numbers[j]});
            about.value = told.is_sum ? about.value + numbers[j] * values[j].value
                                      : about.value * std::pow(values[j].value, numbers[j]);
            told.of_effects = told.of_effects || names[j] != p.choice.unknown[j];
        }
        result.push_back(std::move(told));
    }
    return result;
}

/// Adds the constants among these that sit at the end of their prior, each name once: not those of
/// which the data tell a sum alone, whose values could be others.
inline void add_constants_at_ends(std::vector<std::string> const& effects,
                                  std::vector<named_estimate> const& constants,
                                  std::vector<constant_at_end>& to,
                                  std::vector<named_combination> const& told = {}) {
    for (auto const& c : constants) {
        auto const end = c.prior ? end_of_prior(c.value, *c.prior) : prior_end::none;
        bool const known = std::any_of(to.begin(), to.end(), [&c](constant_at_end const& other) {
            return other.constant.name == c.name;
        });
        bool const in_sum = std::any_of(told.begin(), told.end(), [&c](auto const& k) {
            return k.is_sum && std::any_of(k.parts.begin(), k.parts.end(),
                                           [&c](auto const& p) { return p.name == c.name; });
        });
        if (end != prior_end::none && !known && !in_sum) to.push_back({effects, c, end});
    }
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
    for (auto const e : s.figures.effects)
        for (auto& words : wrap_assumptions({catalogue[e]})) c.assumptions.push_back(words);
    return c;
}

/// A witness with the names of parameters, scenarios and states.
[[nodiscard]] inline named_witness named(identification_problem const& p,
                                         std::vector<double> const& parameters,
                                         std::vector<std::vector<double>> const& starts) {
    named_witness result;
    result.parameters = named_parameters(p, parameters);
    for (std::size_t e = 0; e < starts.size(); ++e) {
        named_witness::start start{p.experiments[e].name, {}};
        for (std::size_t i = 0; i < starts[e].size(); ++i) {
            auto const& state = p.model.about.states[i];
            start.states.push_back({state.name, state.unit, starts[e][i]});
        }
        result.starts.push_back(std::move(start));
    }
    return result;
}

} // namespace sivid

#endif
