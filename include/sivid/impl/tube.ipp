// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_TUBE_IPP
#define SIVID_IMPL_TUBE_IPP

/// @file
/// Sets of first order and tubes of doubles, by the Taylor series and by Runge-Kutta methods.

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>

#include <memory>

namespace sivid {

template class implicit_stages<interval>;
template class dissipative_step<interval>;
template struct formula_step_maker<interval>;
template class stepper<interval>;
template tube<interval> integrate(std::shared_ptr<flow const>, box const&, box const&, double,
                                  double, enclosure_options const&);

} // namespace sivid

#endif
