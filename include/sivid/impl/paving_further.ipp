// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_PAVING_FURTHER_IPP
#define SIVID_IMPL_PAVING_FURTHER_IPP

#include <sivid/paving/identifiability/impl/output_sensitivities.ipp>
#include <sivid/paving/impl/bound_influence.ipp>
#include <sivid/paving/impl/confidence_region.ipp>
#include <sivid/paving/impl/divisors.ipp>
#include <sivid/paving/impl/identifiability.ipp>
#include <sivid/paving/impl/least_disturbance.ipp>
#include <sivid/paving/impl/online_identification.ipp>

#endif
