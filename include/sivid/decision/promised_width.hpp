// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_PROMISED_WIDTH_HPP
#define SIVID_DECISION_PROMISED_WIDTH_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/design/promise_types.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/model/graph/graph.hpp>

#include <vector>

namespace sivid {

/// How wide will a quantity be once an experiment has been made?
///   Data d of an experiment are explained by the parameters p for which some start x brings all
/// outputs within their bounds: \f$ |y_k(p, x) - d_k| \le \epsilon_k \f$. Two that explain the same
/// data, whatever these are, fulfil \f$ |y_k(p, x) - y_k(q, z)| \le 2 \epsilon_k \f$. So no data
/// leave a goal wider than
///   \f[ \max \{ g(p) - g(q) : |y_k(p, x) - y_k(q, z)| \le 2 \epsilon_k \; \forall k \} \f]
/// over all pairs of parameters in the sets and all starts; and some data, those halfway between
/// the pair, leave it just so wide. It is bounded by linear programs over both motions' responses,
/// in which products are unknowns (`lifted_program`), and over what is measured already
/// (`problem.measured`); pairs of parts are halved where these bounds are largest.
/// @param goals  nodes of the model's graph that depend on constants only
/// @throws std::invalid_argument
/// @guarantee  `after` holds for every truth in the sets, every start and all errors within their
///             bounds, if the problem's model and inputs are those of the experiment
/// @cost  one integration, and some milliseconds a pair
[[nodiscard]] SIVID_DECL promise promise_widths(prediction_problem const& problem,
                                                planned_measurements const& plan,
                                                std::vector<node_id> const& goals,
                                                promise_options const& options = {});

/// Will an experiment tell two models apart?
///   It does if no parameters and starts of the one and of the other fulfil \f$ |y_k(p, x) - z_k(q,
/// w)| \le 2 \epsilon_k \f$ for all measurements: whatever the data show, they refute all of one
/// model or all of the other.
/// @param first, second  with the same inputs and channels, over the same time
/// @returns `told_apart`, where that is proved
/// @throws std::invalid_argument  for models of unequal inputs, channels or ends, a plan that
///   does not fit
/// @guarantee  where it says `told_apart`, no data within the error bounds are explained by
///   parameters of both
/// @cost  one integration of each model, and some milliseconds a pair of parts
[[nodiscard]] SIVID_DECL promise tell_apart(prediction_problem const& first,
                                            prediction_problem const& second,
                                            planned_measurements const& plan,
                                            promise_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/impl/promised_width.ipp>
#endif

#endif
