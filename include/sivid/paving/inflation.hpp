// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_HPP
#define SIVID_PAVING_INFLATION_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/combination.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

struct inflation_options {
    double relative_width = 0.05; ///< stop when upper - lower is at most this share of upper
    double seconds = 3;
    /// Boxes bounded and integrations of an experiment over a box, together: unlike the time, the
    /// same on every machine. A step that was begun is ended.
    std::size_t boxes = std::numeric_limits<std::size_t>::max();
    /// So many in all where it is open then whether the inflation is above 1, or where the bounds
    /// have come near each other but are more than a tenth apart.
    std::size_t further_boxes = 0;
    std::size_t memory = std::numeric_limits<std::size_t>::max(); ///< bytes, see `used_up`
    bool only_verdict = false;        ///< stop as soon as lower > 1 or upper <= 1
    std::function<bool()> keep_going; ///< false stops the search with what is proved until then
    feasibility_test_options test;
    /// Asked about grown bounds where runs end early.
    sivid::strategy strategy = default_strategy();
};

/// What was proved about the inflation of a problem.
struct inflation_bound {
    interval value{0.0, detail::infinity}; ///< contains it
    /// Attains `value.upper()`; none while that is infinite.
    std::optional<verified_witness> witness;
    /// Contains every parameter whose inflation is at most `value.upper()`.
    box hull;
    std::size_t boxes = 0;
    std::size_t integrations = 0;
    double seconds = 0;
    /// Products of parameters that those have within these ranges, where they tell more than
    /// `hull`.
    std::vector<combination_hull> products{};
};

/// The problem with those measurements only for which keep(experiment index, measurement) holds;
/// experiments without any are left out, and of those with fewer than their outliers all may be.
/// What is no data but a constraint is kept.
template <class Keep>
[[nodiscard]] identification_problem restricted_to(identification_problem problem,
                                                   Keep const& keep) {
    std::vector<experiment> kept;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        auto e = std::move(problem.experiments[s]);
        record measurements;
        for (auto const& m : e.measurements) {
            if (e.constraint || keep(s, m)) measurements.push_back(m);
        }
        e.measurements = std::move(measurements);
        e.outliers = std::min(e.outliers, e.measurements.size());
        if (!e.measurements.empty()) kept.push_back(std::move(e));
    }
    problem.experiments = std::move(kept);
    return problem;
}

/// The problem with all measured bounds `level` times as wide.
/// @guarantee  every parameter with an inflation of at most `level` explains its data
[[nodiscard]] inline identification_problem with_bounds_grown(identification_problem problem,
                                                              double level) {
    for (auto& e : problem.experiments)
        for (auto& m : e.measurements) m.bound = grown(m.bound, level);
    return problem;
}

/// Bounds the factor by which all measured bounds must grow until some parameter of the prior
/// explains the data,
///   \f$ \lambda^* = \min_p \max_s \min_{x_{0s}} (q_s+1)\text{-th largest } |y_i - m_i|/e_i \f$;
/// the boxes of the initial states and the error bounds of inputs do not grow; where inputs have
/// such bounds, the least is over them, too. lower > 1 proves that no parameter explains the
/// data, upper <= 1 that one does. Below, states that follow the parameters
/// (`starts_follow_parameters`) start anywhere in their ranges; above, where the parameters say.
/// @param guess  where the upper bound may start; without it the search proposes points itself
/// @returns  a factor without unit
/// @throws std::invalid_argument  for an invalid problem
/// @guarantee  `value` contains the inflation whenever the search ends
/// @cost  dominated by integrations over boxes; some tens for a few parameters that the data fix
[[nodiscard]] SIVID_DECL inflation_bound bound_inflation(identification_problem const& problem,
                                                         approximate_fit const* guess = nullptr,
                                                         inflation_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/inflation.ipp>
#endif

#endif
