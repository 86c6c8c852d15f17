// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_ENCLOSE_HPP
#define SIVID_ENCLOSURE_ENCLOSE_HPP

/// @file
/// Trajectories by any set and method behind one call. Taylor models are expensive to compile where
/// nothing is compiled once; who needs sets of first order alone constructs an `enclosed_motion`.
/// In another interval type than `interval`: `integrate<I>`, by sets of first order and any method.

#include <sivid/compiled.hpp>
#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/space/box.hpp>

#include <memory>
#include <vector>

namespace sivid {

/// Encloses all trajectories of x' = f(t, x, p, u) from a box of starts and a box of parameters, in
/// steps relative to the span (`for_span`).
/// @param from, to  in the unit of time of the model
/// @param set  first order: cheap, for narrow boxes. Taylor models: tight over wide ones, in any
///   number of unknowns (sides with a width), by the degree of `suggested_degree`
/// @param options  `method` names a Runge-Kutta formula in place of the Taylor series, for sets of
///   first order
/// With Taylor models, where they lose more than they keep the states get variables of their own
/// (`docs/theory/taylor_models.md`, section 2), and about a single start, or where they end early,
/// sets of first order are carried as well: `enclosed_motion::carried`.
/// @returns  `at` and `over` for any times of the proved span; where that ends early, `failure()`
/// @throws std::invalid_argument  for boxes of other sizes, empty or unbounded, a span that ends
///   before it begins, or a method with Taylor models
/// @guarantee  every trajectory from the box of starts, for every parameter in its box and inputs
///   within their error bounds, lies in what `at` and `over` return
/// @cost  one integration, or up to three for points and where one ends early; `at` and
/// `observe_at` cost a step. With Taylor models they cost what it
///   takes to set up a run and at most five steps, or 1/32 of all steps; up to 64 sets are kept for
///   them, with n states about \f$ 13 n^2 \f$ polynomials each
[[nodiscard]] SIVID_DECL enclosed_motion enclose(std::shared_ptr<flow const> f, box const& initial,
                                                 box const& parameters, double from, double to,
                                                 carried_set set = carried_set::taylor_model,
                                                 enclosure_options const& options = {});

/// The same for a recorded model, with sizes that are chosen: the degree by the number of unknowns
/// (`suggested_degree`), the tolerance by the order of the method (`for_method`), the order of the
/// series step by step.
/// @param choice      names of the unknown constants, and values of others
/// @param initial     a side for each state, in the states' units
/// @param parameters  a side for each unknown constant, in the order of `choice` and their units
/// @param inputs      a signal for each input of the model
/// @throws std::invalid_argument  for names that the model lacks or inputs of another number, too
/// @guarantee  as above
/// @cost  recording the derivatives of the model, and as above
[[nodiscard]] SIVID_DECL enclosed_motion enclose(recorded_model const& model,
                                                 parameter_choice const& choice, box const& initial,
                                                 box const& parameters, double from, double to,
                                                 carried_set set = carried_set::taylor_model,
                                                 enclosure_options const& options = {},
                                                 std::vector<signal> const& inputs = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/enclose.ipp>
#endif

#endif
