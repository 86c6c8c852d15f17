// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_FLOW_IPP
#define SIVID_IMPL_FLOW_IPP

/// @file
/// Sets of Taylor models, one by one.

#include <sivid/enclosure/taylor/parametric_flow.hpp>

namespace sivid {

template class parametric_flow<taylor_model<double>>;

} // namespace sivid

#endif
