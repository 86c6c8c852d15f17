// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_APP_IPP
#define SIVID_IMPL_APP_IPP

#include <sivid/app/impl/app.ipp>
#include <sivid/app/impl/enclosing.ipp>
#include <sivid/app/impl/fleet.ipp>
#include <sivid/app/impl/generate.ipp>
#include <sivid/app/impl/simulate.ipp>

#endif
