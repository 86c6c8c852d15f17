// SPDX-License-Identifier: MIT
// Whether the traits of an interval type have what no model is made of: expm1, asin, hypot, ...
#ifndef SIVID_TESTS_SUPPORT_FURTHER_FUNCTIONS_HPP
#define SIVID_TESTS_SUPPORT_FURTHER_FUNCTIONS_HPP

#include <sivid/number/interval_traits.hpp>

namespace support {

template <class I>
concept has_further_functions = requires(I const& x) {
    sivid::interval_traits<I>::expm1(x);
};

} // namespace support

#endif
