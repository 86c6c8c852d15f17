// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_FLOW_LANES_IPP
#define SIVID_IMPL_FLOW_LANES_IPP

/// @file
/// Sets of Taylor models in lanes.

#include <sivid/enclosure/taylor/parametric_flow.hpp>

namespace sivid {

template class parametric_flow<taylor_model<lanes<8>>>;

} // namespace sivid

#endif
