// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_DETAIL_NAMED_STEPS_HPP
#define SIVID_APPROXIMATE_SIMULATE_DETAIL_NAMED_STEPS_HPP

#include <sivid/approximate/simulate/stepping.hpp>
#include <sivid/compiled.hpp>

#include <memory>

namespace sivid {

/// The classical method of order 4 with an estimate of its error (`embedded_runge_kutta4`): the
/// cheapest where steps end at samples.
[[nodiscard]] SIVID_DECL std::unique_ptr<stepping> classical_steps();
/// Dormand and Prince's method of order 5, for long steps and small tolerances.
[[nodiscard]] SIVID_DECL std::unique_ptr<stepping> dormand_prince_steps();

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/approximate/simulate/impl/named_steps.ipp>
#endif

#endif
