// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_IDENTIFIABILITY_IPP
#define SIVID_PAVING_IMPL_IDENTIFIABILITY_IPP

#include <sivid/paving/identifiability.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/structure/find_combinations.hpp>
#include <sivid/model/structure/homogeneity.hpp>
#include <sivid/model/structure/symmetry.hpp>
#include <sivid/number/text/needed_given.hpp>
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>
#include <sivid/paving/identifiability/detail/sensitivity_spectrum.hpp>
#include <sivid/space/exact/detail/certified_rank.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Whether a motion is a theorem in all experiments, each with its own motion of the start.
inline bool is_proved(identification_problem const& problem, sensitivity_runs const& runs,
                      motion_kind kind, std::vector<int> const& weights) {
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        model_motion motion{kind, std::vector<int>(problem.prior.size(), 0),
                            std::vector<int>(problem.model.about.states.size(), 0)};
        for (std::size_t c = 0; c < weights.size(); ++c) {
            auto const& q = runs.unknowns()[c];
            if (!q.experiment) motion.parameters[q.index] = weights[c];
            if (q.experiment == e) motion.states[q.index] = weights[c];
        }
        auto const& model = runs.equations(e).model();
        bool const states_move =
            std::any_of(motion.states.begin(), motion.states.end(), [](int w) { return w != 0; });
        bool const scaled = kind == motion_kind::scaling && !states_move &&
                            is_scale_invariant(model, motion.parameters);
        if (!scaled && !is_symmetry(model, motion)) return false;
    }
    return true;
}

/// A lower bound of the dimension that the velocities of proved motions span, everywhere in a box.
inline std::size_t proved_freedom(identifiability const& found) {
    using traits = interval_traits<interval>;
    std::vector<free_motion const*> proved;
    for (auto const& m : found.free) {
        if (m.proved) proved.push_back(&m);
    }
    interval_matrix<interval> velocities(found.unknowns.size(), proved.size());
    for (std::size_t k = 0; k < proved.size(); ++k) {
        for (std::size_t c = 0; c < found.unknowns.size(); ++c) {
            auto const& q = found.unknowns[c];
            auto const value =
                q.experiment ? found.starts[*q.experiment][q.index] : found.parameters[q.index];
            auto const w = traits::point(static_cast<double>(proved[k]->weights[c]));
            velocities(c, k) = proved[k]->kind == motion_kind::scaling ? traits::mul(w, value) : w;
        }
    }
    return certified_rank(velocities);
}

inline std::string sum_text(std::vector<std::string> const& names, std::vector<int> const& w) {
    std::string text;
    for (std::size_t j = 0; j < w.size(); ++j) {
        if (w[j] == 0) continue;
        if (text.empty()) {
            if (w[j] < 0) text = "-";
        } else {
            text += w[j] < 0 ? " - " : " + ";
        }
        if (std::abs(w[j]) > 1) text += std::to_string(std::abs(w[j])) + "*";
        text += names[j];
    }
    return text;
}

/// Products or sums of the moving unknowns that all the motions of one kind leave as they are.
inline std::vector<fixed_formula> formulas_of(std::vector<unknown_quantity> const& unknowns,
                                              std::vector<free_motion> const& motions,
                                              motion_kind kind) {
    std::vector<std::size_t> moving;
    bool proved = true;
    for (std::size_t c = 0; c < unknowns.size(); ++c) {
        if (std::any_of(motions.begin(), motions.end(), [&](free_motion const& m) {
                return m.kind == kind && m.weights[c] != 0;
            })) {
            moving.push_back(c);
        }
    }
    std::vector<std::vector<int>> vectors;
    for (auto const& m : motions) {
        if (m.kind != kind) continue;
        proved = proved && m.proved;
        auto& v = vectors.emplace_back();
        for (auto const c : moving) v.push_back(m.weights[c]);
    }
    if (vectors.empty()) return {};
    std::vector<std::string> names;
    for (auto const& q : unknowns) names.push_back(q.name);
    std::vector<fixed_formula> result;
    auto const left = orthogonal_complement(vectors, moving.size());
    for (auto const& w : approximate_integer_basis(left, 1e-9, 36)) {
        std::vector<int> weights(unknowns.size(), 0);
        for (std::size_t k = 0; k < moving.size(); ++k) weights[moving[k]] = w[k];
        auto text = kind == motion_kind::scaling ? model_detail::product_text(names, weights)
                                                 : sum_text(names, weights);
        result.push_back({kind, std::move(weights), std::move(text), proved});
    }
    return result;
}

inline void add_formulas(identifiability& found) {
    auto both = found.free;
    both.insert(both.end(), found.nearly_free.begin(), found.nearly_free.end());
    for (auto const kind : {motion_kind::scaling, motion_kind::translation}) {
        for (auto& f : formulas_of(found.unknowns, found.free, kind)) {
            found.fixed.push_back(std::move(f));
        }
        for (auto& f : formulas_of(found.unknowns, both, kind)) {
            bool const known = std::any_of(found.fixed.begin(), found.fixed.end(),
                                           [&](auto const& g) { return g.formula == f.formula; });
            if (!known) found.nearly_fixed.push_back(std::move(f));
        }
    }
}

} // namespace paving_detail

SIVID_DECL identifiability identifiability_of(identification_problem const& problem, box const& at,
                                              identifiability_options const& options) {
    problem.require_data();
    if (at.size() != problem.prior.size() || is_empty(at))
        throw std::invalid_argument("identifiability_of: one side per parameter, none empty" +
                                    needed_given(problem.prior.size(), at.size()));
    sensitivity_runs const runs(problem, unknowns_of(problem, options.starts), options.enclosure);
    identifiability result;
    result.unknowns = runs.unknowns();
    result.parameters = at;
    result.starts = options.at_starts;
    if (result.starts.empty()) {
        for (auto const& e : problem.experiments) {
            auto& start = result.starts.emplace_back(e.initial);
            for (std::size_t i = 0; i < start.size(); ++i) {
                if (!is_known(start[i])) start[i] = interval(mid(start[i]));
            }
        }
    }
    if (result.starts.size() != problem.experiments.size())
        throw std::invalid_argument("identifiability_of: one box of starts per experiment" +
                                    needed_given(problem.experiments.size(), result.starts.size()));
    auto const there = runs(at, result.starts);
    result.outputs = there.values.rows();
    result.missing = there.missing;
    result.least_rank = certified_rank(there.values, there.weights);

    paving_detail::sensitivity_spectrum const spectrum(problem, runs, at, result.starts, there);
    result.approximate_rank = spectrum.rank();
    result.directions = spectrum.directions();
    result.free = spectrum.free_motions();
    for (auto& m : result.free) {
        m.proved = paving_detail::is_proved(problem, runs, m.kind, m.weights);
    }
    result.nearly_free = spectrum.nearly_free_motions();
    result.most_rank = std::min(result.outputs + result.missing,
                                result.unknowns.size() - paving_detail::proved_freedom(result));
    paving_detail::add_formulas(result);
    return result;
}

} // namespace sivid

#endif
