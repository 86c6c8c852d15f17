// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_NUMBER_IPP
#define SIVID_IMPL_NUMBER_IPP

#include <sivid/number/impl/decimal.ipp>
#include <sivid/number/impl/decimal_output.ipp>
#include <sivid/number/impl/decimal_text.ipp>
#include <sivid/number/impl/kernel_trial.ipp>

#endif
