// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_SLOWER_INPUTS_HPP
#define SIVID_MODEL_CHANGE_DETAIL_SLOWER_INPUTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

#include <optional>

namespace sivid {

/// The same question with inputs that change less often, for steps that are longer than those of a
/// logger: an input that is held for a millisecond ends a step each millisecond.
///   Let w be a function of recorded inputs alone, such as a torque or the square of a rotor's
///   speed, and let the rates be affine in it: \f$ x' = f(t, x, c) + B(x, c) w(t) \f$, where B
///   depends on no state that w drives. With lines p(t) through a knot each `period` and what they
///   leave, \f$ U(t) = \int (w - p) \f$, which comes back to about 0 at each knot, the states
///   \f$ z = x - B U \f$ start where x does, and
///   \f[ z' = f(t, z + B U, c) + B p - \dot B U, \qquad y = g(t, z + B U, c). \f]
///   p is an input in place of w, and U one of which a bound is known: the largest |U| in each
///   period, from the samples. It shrinks with the square of the time for which inputs are held,
///   and with the third power of the period where they are smooth.
/// @param period  between two knots, > 0; inputs with fewer than four knots in one, on the
///                average over an experiment, stay as they are
/// @returns nothing where no input is that fast, or one is not exact, enters a channel or the rates
///          otherwise than said (by a kink or a jump, too), or is delayed
/// @guarantee  a parameter, and a start, that explains the experiments here explains those of the
///             result; not the other way round: the result knows less of the inputs
/// @cost  some operations for each sample
/// @throws std::invalid_argument  for a period that is not positive
[[nodiscard]] SIVID_DECL std::optional<identification_problem>
with_slower_inputs(identification_problem const& problem, double period);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/change/impl/slower_inputs.ipp>
#endif

#endif
