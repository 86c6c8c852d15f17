// SPDX-License-Identifier: MIT
// How much a diagnosis knows, beside how much the data allow it to know: widths of hulls, and what
// it says of held-out data for every parameter that fits.
#include "catalogue.hpp"
#include "judge.hpp"
#include "reach.hpp"
#include "reading.hpp"

#include <algorithm>
#include <limits>

namespace withheld {

namespace {

/// A point that explains the data, from the truth on; nothing when fits find none.
std::optional<std::vector<double>> explaining(label const& truth, fit_problem const& problem) {
    std::vector<std::pair<std::string, double>> known{truth.constants_true.begin(),
                                                      truth.constants_true.end()};
    for (auto const& [name, values] : truth.effects) {
        auto const& parameters = effect_named(name)->parameters;
        for (std::size_t i = 0; i < values.size() && i < parameters.size(); ++i)
            known.emplace_back(name + '.' + std::string{parameters[i].name}, values[i]);
    }
    auto x = problem.start(known);
    if (problem.inflation(x) <= 1) return x;
    problem.minimise(x, 2, 25);
    return problem.inflation(x) <= 1 || problem.tighten(x) <= 1 ? std::optional{x} : std::nullopt;
}

void measure_hulls(label const& truth, recording const& data, json const& cause, judgement& j) {
    std::vector<effect const*> effects;
    for (auto const& [name, values] : truth.effects) effects.push_back(effect_named(name));
    fit_problem const problem(data, effects);
    bool const any_budget = std::any_of(data.scenarios.begin(), data.scenarios.end(),
                                        [](auto const& s) { return s.budget > 0; });
    std::optional<std::vector<double>> x;
    if (!any_budget) x = explaining(truth, problem);
    auto const parameters = member(cause, "parameters");
    for (std::size_t i = 0; i < problem.variables().size(); ++i) {
        auto const& v = problem.variables()[i];
        if (v.effect == nullptr) continue;
        hull_width w;
        w.name = v.name;
        w.of_prior = w.of_allowed = std::numeric_limits<double>::infinity();
        if (x) {
            auto const r = reach(problem, *x, i);
            w.allowed = r.upper - r.lower;
        }
        // Both ends cut to the prior, as the data allow no more there.
        if (auto const hull = hull_in(member(parameters, v.name))) {
            double const from = std::max(hull->lower, v.lo), to = std::min(hull->upper, v.hi);
            w.of_prior = (to - from) / (v.hi - v.lo);
            if (w.allowed && *w.allowed > 0) w.of_allowed = w.of_prior / *w.allowed;
        }
        j.hull_widths.push_back(w);
    }
}

void measure_holdout(json const& cause, judgement& j) {
    auto const holdout = member(cause, "holdout");
    auto const at_witness = number(member(holdout, "inflation_after"), 1);
    if (!at_witness) return;
    auto const all = number(member(holdout, "over_fits_after"), 1);
    j.holdout_ratio = all ? *all / *at_witness : std::numeric_limits<double>::infinity();
    auto const covered = member(holdout, "covered_after");
    if (covered.is_number()) j.tube_coverage = covered.get<double>();
}

} // namespace

void measure_widths(label const& truth, recording const& data, json const& diagnosis,
                    judgement& j) {
    auto const held_by = truth.held_by();
    if (!held_by || held_by->empty()) return;
    for (auto const& cause : member(diagnosis, "causes")) {
        if (member(cause, "verdict") != "explains" ||
            names_in(member(cause, "effects")) != truth.names())
            continue;
        measure_hulls(truth, data, cause, j);
        measure_holdout(cause, j);
        return;
    }
}

} // namespace withheld
