// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_AFFECTED_PROBLEM_HPP
#define SIVID_DIAGNOSIS_AFFECTED_PROBLEM_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/arithmetic.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// Encloses an input at one time, its error included.
inline interval input_at(signal const& s, double t) {
    if (auto const* sampled = std::get_if<sampled_signal>(&s)) {
        using traits = interval_traits<interval>;
        auto const piece = sampled->piece(t);
        double const e = sampled->error_bound(piece, t);
        return traits::add(sampled->value<interval>(piece, interval(t)), traits::bounds(-e, e));
    }
    auto const& formula = std::get<analytic_signal>(s);
    graph g;
    auto const value = copy_into(g, formula.g, {formula.value},
                                 [t](node const&, graph& to) { return to.constant(t); });
    if (!g.is_literal(value.front())) {
        throw std::domain_error("an input is not defined at the begin of its experiment");
    }
    return g.value(g[value.front()]).enclosure;
}

/// Encloses the initial value of an added state; constants are taken over their ranges.
inline interval start_of(recorded_model const& model, added_state const& added,
                         std::vector<interval> const& constants, experiment const& e) {
    // Each leaf is an interval, so that the whole folds to a literal.
    graph g;
    auto const value = copy_into(g, model.g, {added.at_begin}, [&](node const& n, graph& to) {
        auto const k = static_cast<std::size_t>(n.index);
        auto const range =
            n.op == operation::constant ? constants[k] : input_at(e.inputs[k], e.begin);
        return to.constant(literal{range, mid(range)});
    });
    if (!g.is_literal(value.front())) {
        throw std::domain_error("the initial value of state '" +
                                model.about.states[added.state].name + "' is not defined");
    }
    return g.value(g[value.front()]).enclosure;
}

} // namespace diagnosis_detail

/// Sets the initial ranges of the states that effects added, for the parameters in the prior.
/// @throws std::domain_error where such a value is not defined
inline void start_added_states(identification_problem& problem) {
    auto const& about = problem.model.about;
    auto const constants = constant_ranges(problem.model, problem.choice, problem.prior);
    for (auto& e : problem.experiments) {
        std::vector<interval> sides(e.initial.begin(), e.initial.end());
        sides.resize(about.states.size());
        for (auto const& a : problem.model.added_states) {
            sides[a.state] = diagnosis_detail::start_of(problem.model, a, constants, e);
        }
        e.initial = box(std::move(sides));
    }
}

/// Whether a state that effects added starts at a value that the parameters decide: of its initial
/// range then only one value belongs to a parameter.
[[nodiscard]] inline bool starts_follow_parameters(identification_problem const& problem) {
    return std::any_of(
        problem.experiments.begin(), problem.experiments.end(), [&](experiment const& e) {
            return std::any_of(problem.model.added_states.begin(), problem.model.added_states.end(),
                               [&](added_state const& a) { return width(e.initial[a.state]) > 0; });
        });
}

/// The same experiments, with effects joined to the model. The parameters of the effects become
/// further unknowns, with the effects' priors; effects that act in some experiments only are
/// switched on in these.
///   A parameter that is feasible for `base` is feasible here with all effects neutral.
/// @throws std::invalid_argument as `with`
[[nodiscard]] SIVID_DECL identification_problem affected(identification_problem const& base,
                                                         std::vector<effect> const& effects);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/affected_problem.ipp>
#endif

#endif
