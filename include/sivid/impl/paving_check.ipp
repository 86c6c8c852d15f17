// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_PAVING_CHECK_IPP
#define SIVID_IMPL_PAVING_CHECK_IPP

#include <sivid/paving/run/impl/scalar_run.ipp>

#endif
