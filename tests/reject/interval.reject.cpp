// SPDX-License-Identifier: MIT
// Rounded decimals in the place of facts.
// reject 1: deleted function
// reject 2: deleted function
// reject 3: not a decimal|no matching|unable to find numeric literal
#include <sivid/number/decimal.hpp>

using namespace sivid;

#if SIVID_REJECT == 1
interval const x = hull(0.10, 0.12); // neither double is the decimal
#elif SIVID_REJECT == 2
interval const x = hull(0.10f, 0.12);
#elif SIVID_REJECT == 3
interval const x = enclose("0.1"_dec); // a text is no literal
#else
interval const x = hull(0.10_dec, 0.12_dec);
interval const y = hull(0.1_dec, 3) + x;
#endif
