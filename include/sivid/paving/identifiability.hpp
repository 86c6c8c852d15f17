// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_HPP
#define SIVID_PAVING_IDENTIFIABILITY_HPP

#include <sivid/model/find_combinations.hpp>
#include <sivid/model/homogeneity.hpp>
#include <sivid/model/symmetry.hpp>
#include <sivid/paving/detail/sensitivity_spectrum.hpp>
#include <sivid/paving/output_sensitivities.hpp>
#include <sivid/space/certified_rank.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A direction in the unknowns, one of an orthonormal system that the data tell apart.
struct sensitive_direction {
    /// Per unknown, in widths of its prior (of its logarithm where the prior does not touch 0); the
    /// largest is 1: the direction crosses that prior.
    std::vector<double> components;
    /// To first order, by how many half-widths of its bound a move along the direction changes the
    /// output that notices it most.
    double noticed = 0;
};

/// A motion of the unknowns that the outputs do not notice, or hardly.
struct free_motion {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> weights; ///< one per unknown
    double noticed = 0;       ///< as for a direction, across the prior that is crossed first
    /// A theorem about the equations: no output of any experiment changes along it.
    bool proved = false;
};

/// A product or sum that a motion leaves as it is: what its factors or terms act through.
struct fixed_formula {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> weights; ///< exponents of a product, factors of a sum
    std::string formula;
    bool proved = false; ///< all motions that it stands for are
};

/// What the measured outputs can tell about the unknowns, whatever the measured values.
struct identifiability {
    std::vector<unknown_quantity> unknowns;
    box parameters;          ///< where the proofs hold, every parameter in it
    std::vector<box> starts; ///< and the starts, per experiment
    std::size_t outputs = 0; ///< measured outputs that were reached
    std::size_t missing = 0; ///< those that the enclosure did not reach, left out everywhere

    /// The sensitivities of the outputs by the unknowns have at least this rank: proved.
    std::size_t least_rank = 0;
    /// They have at most this rank: proved, by motions that are theorems about the equations.
    std::size_t most_rank = 0;
    /// Their rank in the middle, in floating point: not proved.
    std::size_t approximate_rank = 0;
    /// Not proved; those that are noticed most come first.
    std::vector<sensitive_direction> directions;
    std::vector<free_motion> free; ///< in formulas; found numerically, proved where it says so
    /// Noticed by less than one half-width of a bound; for suggestions only.
    std::vector<free_motion> nearly_free;
    std::vector<fixed_formula> fixed;        ///< what the moving unknowns of `free` act through
    std::vector<fixed_formula> nearly_fixed; ///< the same with `nearly_free`, never proved

    /// Proved: no two values of the unknowns within `parameters` and `starts`, all else being
    /// equal, have the same outputs.
    [[nodiscard]] bool tells_all_apart() const { return least_rank == unknowns.size(); }
};

struct identifiability_options {
    enclosure_options enclosure{};
    bool starts = true;           ///< starts that are not known exactly count among the unknowns
    std::vector<box> at_starts{}; ///< one per experiment; empty: the middles of what is not known
};

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

/// Which unknowns, or combinations of them, the measured outputs of a problem can tell, at a point
/// or over a small box of parameters. Only the times, channels and bounds of the measurements are
/// used, not the measured values; outliers are not considered.
///   Ranks: sensitivities enclosed along proved trajectories (`sensitivity_runs`), a regular part
///   of them proved (`certified_rank`). Directions: the singular value decomposition of their
///   middles, scaled by the bounds and by the prior. Formulas: vectors of small integers in the
///   common null space of the sensitivities at three points, in logarithms (products and ratios)
///   and plain coordinates (sums and differences); then looked for in the equations
///   (`is_symmetry`).
/// @param at  one side per parameter of the problem, within the prior or not
/// @given     no delays; inputs count as recorded, whatever their error bounds
/// @guarantee  `least_rank` for all parameters and starts in the boxes; `most_rank` likewise; with
///             `tells_all_apart` the outputs are injective there (mean value theorem: averages of
///             the sensitivities lie in the enclosure); `proved` motions change no output anywhere
/// @cost  one integration with sensitivities for each experiment at `at`, its middle and two points
/// @ref   Walter and Pronzato, Identification of Parametric Models from Experimental Data (1997)
[[nodiscard]] inline identifiability
identifiability_of(identification_problem const& problem, box const& at,
                   identifiability_options const& options = {}) {
    problem.require_valid();
    if (at.size() != problem.prior.size() || is_empty(at))
        throw std::invalid_argument("identifiability_of: one side per parameter, none empty");
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
        throw std::invalid_argument("identifiability_of: one box of starts per experiment");
    auto const there = runs(at, result.starts);
    result.outputs = there.values.rows();
    result.missing = there.missing;
    result.least_rank = certified_rank(there.values, there.weights);

    paving_detail::sensitivity_spectrum const spectrum(problem, runs, at, result.starts, there);
    result.approximate_rank = spectrum.rank();
    for (auto const& d : spectrum.directions()) {
        result.directions.push_back({d.components, d.noticed});
    }
    for (auto const& m : spectrum.free_motions()) {
        bool const proved = paving_detail::is_proved(problem, runs, m.kind, m.weights);
        result.free.push_back({m.kind, m.weights, m.noticed, proved});
    }
    for (auto const& m : spectrum.nearly_free_motions()) {
        result.nearly_free.push_back({m.kind, m.weights, m.noticed, false});
    }
    result.most_rank = std::min(result.outputs + result.missing,
                                result.unknowns.size() - paving_detail::proved_freedom(result));
    paving_detail::add_formulas(result);
    return result;
}

} // namespace sivid

#endif
