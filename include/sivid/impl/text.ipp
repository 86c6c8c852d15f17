// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_TEXT_IPP
#define SIVID_IMPL_TEXT_IPP

#include <sivid/text/impl/read_model.ipp>

#endif
