// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"

#include "conformance/types.hpp"

#include <cfenv>

namespace shapes {

template <class I>
I product_elsewhere(double x, double y) {
    return by_traits<I>::mul(by_traits<I>::of(x), by_traits<I>::of(y));
}
template <class I>
I sum_elsewhere(double x, double y) {
    return by_traits<I>::add(by_traits<I>::of(x), by_traits<I>::of(y));
}
template <class I>
I quotient_elsewhere(double x, double y) {
    return by_operators<I>::div(by_traits<I>::of(x), by_traits<I>::of(y));
}
template <class I>
I sine_elsewhere(double x) {
    return by_traits<I>::sin(by_traits<I>::of(x));
}
double plain_product_elsewhere(double x, double y) { return x * y; }
void change_rounding_elsewhere(int mode) { std::fesetround(mode); }

#define SIVID_INSTANTIATE(I)                                                                       \
    template I product_elsewhere<I>(double, double);                                               \
    template I sum_elsewhere<I>(double, double);                                                   \
    template I quotient_elsewhere<I>(double, double);                                              \
    template I sine_elsewhere<I>(double);
SIVID_INSTANTIATE(sivid::interval)
#if SIVID_PACK_AVX512
SIVID_INSTANTIATE(sivid::pack<8>)
#endif
#if SIVID_PACK_AVX2
SIVID_INSTANTIATE(sivid::pack<4>)
#else
SIVID_INSTANTIATE(sivid::pack<2>)
#endif
SIVID_INSTANTIATE(sivid::pack<1>)
#if defined(SIVID_HAS_MPFI)
SIVID_INSTANTIATE(sivid::mp_interval)
#endif
#undef SIVID_INSTANTIATE

} // namespace shapes
