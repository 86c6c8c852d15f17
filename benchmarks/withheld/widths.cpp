// SPDX-License-Identifier: MIT
// How much a diagnosis knows, beside how much the data allow it to know: widths of hulls, and what
// it says of held-out data for every parameter that fits.
#include "catalogue.hpp"
#include "judge.hpp"
#include "reach.hpp"
#include "reading.hpp"

#include <algorithm>
#include <cmath>
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

std::optional<double> known_as(std::vector<std::pair<std::string, double>> const& values,
                               std::string const& name) {
    for (auto const& [known, value] : values)
        if (known == name) return value;
    return std::nullopt;
}

/// Points at the ends of what the data allow explain them: hulls hold these, too, and what is said
/// of held-out data for every parameter.
/// @returns  the largest inflation of the held-out data there; 0 where their starts are not known
double attack(fit_problem const& problem, std::vector<double> const& inside,
              std::vector<std::vector<double>> const& ends, json const& cause, json const& products,
              bool known_starts, judgement& j) {
    double most = 0;
    auto const over = bounds_in(member(member(cause, "holdout"), "over_fits_after"));
    for (auto const& end : ends) {
        for (double const share : {1.0, 0.999, 0.98}) {
            auto x = inside;
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * (end[i] - inside[i]);
            if (problem.inflation(x) > 1 - 1e-6) continue;
            for (auto const& [name, value] : problem.values(x)) {
                auto const hull = hull_in(member(member(cause, "parameters"), name));
                if (!hull) continue;
                ++j.hulls_checked;
                j.proof(hull->contains(value, 1e-7 * (1 + std::abs(value))), "hull",
                        name + " in " + text_of(*hull) + ", explains at " + short_text(value));
            }
            for (auto const& p : products) {
                auto const hull = hull_in(p);
                auto const value = combination_in(
                    p, [&](std::string const& name) { return known_as(problem.values(x), name); });
                if (!hull || !value) continue;
                ++j.hulls_checked;
                j.proof(hull->contains(*value, 1e-7 * (1 + std::abs(*value))), "hull",
                        text_of(member(p, "formula")) + " in " + text_of(*hull) + ", explains at " +
                            short_text(*value));
            }
            if (!known_starts) break;
            double const there = problem.inflation(x, true);
            most = std::max(most, there);
            if (!over) break;
            j.proof(there <= over->upper * (1 + 1e-3) && there >= over->lower * (1 - 1e-3),
                    "holdout",
                    joined(names_in(member(cause, "effects"))) + " over all fits " +
                        text_of(*over) + ", at one of them " + short_text(there));
            break;
        }
    }
    return most;
}

void measure_hulls(label const& truth, recording const& data, json const& cause,
                   json const& products, judgement& j) {
    std::vector<effect const*> effects;
    for (auto const& [name, values] : truth.effects) effects.push_back(effect_named(name));
    fit_problem const problem(data, effects);
    bool const any_budget = std::any_of(data.scenarios.begin(), data.scenarios.end(),
                                        [](auto const& s) { return s.budget > 0; });
    bool const known_starts =
        std::all_of(data.scenarios.begin(), data.scenarios.end(), [](auto const& s) {
            return !s.plan.holdout ||
                   std::all_of(s.plan.initial.begin(), s.plan.initial.end(),
                               [](auto const& side) { return side.lo == side.hi; });
        });
    std::optional<std::vector<double>> x;
    if (!any_budget) x = explaining(truth, problem);
    double held_out = 0;
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
            held_out =
                std::max(held_out, attack(problem, *x, r.ends, cause, products, known_starts, j));
        }
        // Both ends cut to the prior, as the data allow no more there.
        if (auto const hull = hull_in(member(parameters, v.name))) {
            double const from = std::max(hull->lower, v.lo), to = std::min(hull->upper, v.hi);
            w.of_prior = (to - from) / (v.hi - v.lo);
            if (w.allowed && *w.allowed > 0) w.of_allowed = w.of_prior / *w.allowed;
        }
        j.hull_widths.push_back(w);
    }
    if (x && known_starts) {
        auto const worst = worst_held_out(problem, *x);
        j.holdout_attained =
            std::max(held_out, attack(problem, *x, worst, cause, products, known_starts, j));
    }
}

void measure_holdout(json const& cause, judgement& j) {
    auto const holdout = member(cause, "holdout");
    auto const at_witness = number(member(holdout, "inflation_after"), 1);
    if (!at_witness) return;
    auto const all = number(member(holdout, "over_fits_after"), 1);
    j.holdout_ratio = all ? *all / *at_witness : std::numeric_limits<double>::infinity();
    j.holdout_witness = at_witness;
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
        auto const answer = member(diagnosis, "answer");
        bool const answered = names_in(member(answer, "effects")) == truth.names();
        measure_hulls(truth, data, cause, answered ? member(answer, "combinations") : json::array(),
                      j);
        measure_holdout(cause, j);
        return;
    }
}

} // namespace withheld
