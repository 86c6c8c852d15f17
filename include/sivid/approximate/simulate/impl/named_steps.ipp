// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_IMPL_NAMED_STEPS_IPP
#define SIVID_APPROXIMATE_SIMULATE_IMPL_NAMED_STEPS_IPP

#include <sivid/approximate/simulate/detail/named_steps.hpp>

#include <sivid/approximate/simulate/odeint_stepping.hpp>
#include <sivid/compiled.hpp>

#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <memory>

namespace sivid {

SIVID_DECL std::unique_ptr<stepping> classical_steps() { return step_by<embedded_runge_kutta4>(); }
SIVID_DECL std::unique_ptr<stepping> dormand_prince_steps() {
    return step_by<odeint_method<boost::numeric::odeint::runge_kutta_dopri5>>();
}

} // namespace sivid

#endif
