// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_VERIFIER_IPP
#define SIVID_IMPL_VERIFIER_IPP

#include <sivid/verifier/impl/certificate.ipp>
#include <sivid/verifier/impl/diagnosis_check.ipp>
#include <sivid/verifier/impl/identification_check.ipp>
#include <sivid/verifier/impl/predict_from.ipp>

#endif
