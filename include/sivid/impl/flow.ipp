// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_FLOW_IPP
#define SIVID_IMPL_FLOW_IPP

/// @file
/// Sets of Taylor models, one by one.

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>

namespace sivid {

template class implicit_stages<taylor_model<double>>;
template class parametric_flow<taylor_model<double>>;
template class parametric_flow<taylor_model<double>, runge_kutta_centre<taylor_model<double>>>;

} // namespace sivid

#endif
