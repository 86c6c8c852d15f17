// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_DISTURBANCE_HPP
#define SIVID_MODEL_DISTURBANCE_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A state equation or a channel that is disturbed, and in which unit its disturbance is counted.
struct disturbed_quantity {
    std::size_t index = 0;
    double scale =
        1; ///< of W = 1: of an equation in its state's unit per time, of a channel in its
};

/// Unknown functions of time beside the model: \f$ x_i' = f_i(t, x, p, u) + d_i(t) \f$ and
/// \f$ y_k = g_k(t, x, p, u) + e_k(t) \f$, \f$ |d_i| \le W s_i \f$, \f$ |e_k| \le W s_k \f$, with
/// scales s and one size W for all. d is any measurable function, e any function.
struct disturbance_set {
    std::vector<disturbed_quantity> equations, channels;
};

/// The same by the names of equations and of channels, with their scales; an equation is known by
/// the name of its state, too.
/// @throws std::invalid_argument  as `require_valid` does, and for a name that is none
[[nodiscard]] SIVID_DECL disturbance_set disturbance_on(
    recorded_model const& model, std::vector<std::pair<std::string, double>> const& equations,
    std::vector<std::pair<std::string, double>> const& channels = {});

/// @throws std::invalid_argument  for a set without members, a scale that is not above 0 and
/// finite,
///         one equation or channel twice or unknown, a model with delays, plays or rate limits, and
///         an equation on which no channel depends
SIVID_DECL void require_valid(disturbance_set const& set, recorded_model const& model);

/// State equations on which constants or inputs act and which some channel shows: where forces,
/// flows and reactions stand. x' = v is none.
[[nodiscard]] SIVID_DECL std::vector<std::size_t> driven_equations(recorded_model const& model);

/// The problem in which disturbances up to `size` are allowed: what identifies, predicts or
/// contradicts does it for all of them. Each disturbed equation has a further input, 0 within an
/// error bound of `size` times the scale, and bounds of disturbed channels are so much wider.
///   d may be any measurable function; a witness is one without disturbance of equations.
/// @throws std::invalid_argument  as `require_valid` of both, and where `size` is below 0 or not
///         finite
[[nodiscard]] SIVID_DECL identification_problem with_disturbance(identification_problem problem,
                                                                 disturbance_set const& set,
                                                                 double size);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/disturbance.ipp>
#endif

#endif
