// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_ENCLOSURE_IPP
#define SIVID_IMPL_ENCLOSURE_IPP

#include <sivid/enclosure/impl/enclose.ipp>
#include <sivid/enclosure/impl/enclosed_motion.ipp>
#include <sivid/enclosure/impl/failure.ipp>
#include <sivid/enclosure/impl/flow.ipp>

#endif
