// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_DETAIL_NAMED_STEPS_HPP
#define SIVID_APPROXIMATE_SIMULATE_DETAIL_NAMED_STEPS_HPP

#include <sivid/approximate/simulate/odeint_stepping.hpp>
#include <sivid/compiled.hpp>

#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <memory>

namespace sivid {

SIVID_ENTRY std::unique_ptr<stepping> classical_steps() { return step_by<embedded_runge_kutta4>(); }
SIVID_ENTRY std::unique_ptr<stepping> dormand_prince_steps() {
    return step_by<odeint_method<boost::numeric::odeint::runge_kutta_dopri5>>();
}

} // namespace sivid

#endif
