// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_APPROXIMATE_IPP
#define SIVID_IMPL_APPROXIMATE_IPP

#include <sivid/approximate/candidate/impl/wrapped_channels.ipp>
#include <sivid/approximate/fit/impl/counterexample.ipp>
#include <sivid/approximate/fit/impl/fit.ipp>
#include <sivid/approximate/place/impl/place_estimate.ipp>
#include <sivid/approximate/simulate/impl/named_steps.ipp>

#endif
