// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_MEASUREMENT_IPP
#define SIVID_IMPL_MEASUREMENT_IPP

#include <sivid/measurement/impl/limited_signal.ipp>
#include <sivid/measurement/impl/played_signal.ipp>
#include <sivid/measurement/impl/signal.ipp>
#include <sivid/measurement/impl/wrapped_readings.ipp>

#endif
