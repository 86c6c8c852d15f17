// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_NUMBER_IPP
#define SIVID_IMPL_NUMBER_IPP

#include <sivid/number/impl/decimal.ipp>
#include <sivid/number/impl/decimal_output.ipp>
#include <sivid/number/pack/impl/kernel_trial.ipp>
#include <sivid/number/text/impl/decimal_text.ipp>

#endif
