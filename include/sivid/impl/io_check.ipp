// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_IO_CHECK_IPP
#define SIVID_IMPL_IO_CHECK_IPP

#include <sivid/io/impl/identification_check.ipp>
#include <sivid/io/impl/stored_prediction.ipp>

namespace sivid {

template class identification_check<interval, interval>;

} // namespace sivid

#endif
