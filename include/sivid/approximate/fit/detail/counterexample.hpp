// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_COUNTEREXAMPLE_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_COUNTEREXAMPLE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace sivid {

/// How long points are sought, and what becomes of them.
struct counterexample_options {
    double seconds = 5;
    std::size_t fits = 64; ///< of boxes, the most promising ones; each is a handful of simulations
    std::function<bool()> keep_going = nullptr; ///< false ends the search
    /// Whether a point contradicts a claim, by proof; the search ends with the first that does.
    std::function<bool(approximate_fit const&)> confirms = nullptr;
};

/// Seeks a point of some boxes that explains the data, where a result says that none does: a fit in
/// the whole prior, then fits within the boxes, those first whose point next to the former fit
/// explains most, and the largest.
///   A fit finds in no time what a random part of a large box misses: a feasible set may fill a
///   thousandth of it.
/// @returns whether a point was confirmed. That none was says nothing.
/// @cost  in plain doubles: one fit, one simulation for each box, `fits` fits
[[nodiscard]] SIVID_DECL bool find_explaining_point(identification_problem const& problem,
                                                    std::vector<box> const& excluded,
                                                    counterexample_options const& options);

/// Seeks a point of some boxes that does not explain the data, where a result says that all do: in
/// each box the corner at which, to first order, a measurement is missed most; unknown starts are
/// fitted there.
/// @returns whether a point was confirmed. That none was says nothing.
/// @cost  in plain doubles: a simulation with sensitivities for each box, and a few simulations for
/// each experiment; fits instead where starts are not known
[[nodiscard]] SIVID_DECL bool find_unexplained_point(identification_problem const& problem,
                                                     std::vector<box> const& inside,
                                                     counterexample_options const& options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/approximate/fit/impl/counterexample.ipp>
#endif

#endif
