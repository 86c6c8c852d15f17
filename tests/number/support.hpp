// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_NUMBER_SUPPORT_HPP
#define SIVID_TESTS_NUMBER_SUPPORT_HPP

#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <sivid/number/interval.hpp>

#include <limits>
#include <utility>

inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double greatest = std::numeric_limits<double>::max();
inline constexpr double tiny = std::numeric_limits<double>::denorm_min();

inline sivid::interval make(double lo, double hi) { return sivid::detail::bounded(lo, hi); }
inline sivid::interval nothing() { return sivid::detail::empty_interval(); }
inline sivid::interval everything() { return sivid::detail::entire_interval(); }

/// The result of a function with a cut flag, and the flag.
template <class Function>
std::pair<sivid::interval, bool> with_cut(Function const& f, sivid::interval const& x) {
    bool cut = false;
    sivid::interval const y = f(x, cut);
    return {y, cut};
}

#endif
