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
#include <sivid/space/box.hpp>

#include <memory>

namespace sivid {

/// Encloses all trajectories of x' = f(t, x, p, u) from a box of starts and a box of parameters.
/// @param set  first order: cheap, for narrow boxes. Taylor models: tight over wide ones, in any
///   number of unknowns (sides with a width), by the degree of `suggested_degree`
/// @param options  `method` names a Runge-Kutta formula in place of the Taylor series; with Taylor
///   models it crosses no kinks
/// @returns  `at` and `over` for any times of the proved span; where that ends early, `failure()`
/// @throws std::invalid_argument  for boxes of other sizes, empty or unbounded, or a span that
///   ends before it begins
/// @guarantee  every trajectory from the box of starts, for every parameter in its box and inputs
///   within their error bounds, lies in what `at` and `over` return
/// @cost  one integration; with Taylor models, one for each call of `at` and `observe_at`, too
[[nodiscard]] SIVID_DECL enclosed_motion enclose(std::shared_ptr<flow const> f, box const& initial,
                                                 box const& parameters, double from, double to,
                                                 carried_set set = carried_set::taylor_model,
                                                 enclosure_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/enclosure/impl/enclose.ipp>
#endif

#endif
