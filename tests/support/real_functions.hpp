// SPDX-License-Identifier: MIT
// The functions that models use and that builtin numbers lack.
#ifndef SIVID_TESTS_SUPPORT_REAL_FUNCTIONS_HPP
#define SIVID_TESTS_SUPPORT_REAL_FUNCTIONS_HPP

#include <cmath>
#include <type_traits>

namespace support {

template <class T>
inline constexpr bool is_real = std::is_floating_point_v<T>;

namespace real {
template <class T>
concept number = is_real<T>;
using std::abs;
using std::atan;
using std::cos;
using std::exp;
using std::log;
using std::sin;
using std::sqrt;
using std::tan;
using std::tanh;
template <number T>
T sqr(T const& a) {
    return a * a;
}
template <number T>
T pown(T const& a, int n) {
    T y = 1;
    for (int i = 0; i < (n < 0 ? -n : n); ++i) y *= a;
    return n < 0 ? T(1) / y : y;
}
template <number T>
T sign(T const& a) {
    return a > 0 ? T(1) : a < 0 ? T(-1) : T(0);
}
template <number T>
T min(T const& a, T const& b) {
    return b < a ? b : a;
}
template <number T>
T max(T const& a, T const& b) {
    return a < b ? b : a;
}
template <number T>
T saturate(T const& a, T const& lo, T const& hi) {
    return min(max(a, lo), hi);
}
} // namespace real

} // namespace support

#endif
