// SPDX-License-Identifier: MIT
// A model must not branch on values: its functor is run once, on a scalar that has none.
// reject 1: deleted
// reject 2: deleted
// reject 3: contextually convert|could not convert|no viable conversion
// reject 4: cannot convert|no viable conversion
#include <sivid/model/expression.hpp>

using sivid::expression;

expression drag(expression const& v, expression const& k) {
#if SIVID_REJECT == 1
    if (v < 0) return k * sqr(v);
#elif SIVID_REJECT == 2
    if (v == k) return k * v;
#elif SIVID_REJECT == 3
    if (v) return k * v;
#elif SIVID_REJECT == 4
    double const plain = v; // would lose that it is unknown
    return k * plain;
#endif
    return -k * v * abs(v);
}
