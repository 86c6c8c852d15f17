// SPDX-License-Identifier: MIT
// Interval types of several kinds, for what is said of any of them.
#ifndef SIVID_TESTS_SUPPORT_INTERVAL_TYPES_HPP
#define SIVID_TESTS_SUPPORT_INTERVAL_TYPES_HPP

#include <sivid/number/boost_interval.hpp>
#include <sivid/number/pack.hpp>
#include <sivid/number/traits_by_bounds.hpp>

#ifdef SIVID_HAS_MPFI
#include <sivid/number/mp_interval.hpp>
#endif

#include "../../examples/custom_interval/middle_radius.hpp"

#include <cmath>
#include <cstddef>

namespace support {

/// Boost's, with a checking policy of its own.
using boost_type =
    boost::numeric::interval<double,
                             boost::numeric::interval_lib::policies<
                                 boost::numeric::interval_lib::save_state<sivid::opaque_rounding>,
                                 boost::numeric::interval_lib::checking_catch_nan<double>>>;

/// Bounds in single precision: `bounds` of doubles is wider than they are.
struct coarse {
    float low = 0, high = 0;
    bool none = false;
};

} // namespace support

template <>
struct sivid::interval_traits<support::coarse> : sivid::traits_by_bounds<support::coarse> {
    static support::coarse bounds(double lo, double hi) {
        if (!(lo <= hi)) return empty();
        float const all = HUGE_VALF;
        auto low = static_cast<float>(lo), high = static_cast<float>(hi);
        if (static_cast<double>(low) > lo) low = std::nextafter(low, -all);
        if (static_cast<double>(high) < hi) high = std::nextafter(high, all);
        return {low, high, false};
    }
    static support::coarse empty() { return {0, 0, true}; }
    static double lower(support::coarse const& a, std::size_t = 0) {
        return a.none ? detail::not_a_number : static_cast<double>(a.low);
    }
    static double upper(support::coarse const& a, std::size_t = 0) {
        return a.none ? detail::not_a_number : static_cast<double>(a.high);
    }
};

#if defined(SIVID_HAS_MPFI) && defined(SIVID_LONG_TESTS)
#define SIVID_MP_TYPES , sivid::mp_interval, sivid::proven_interval
#else
#define SIVID_MP_TYPES
#endif
#ifdef SIVID_LONG_TESTS
#define SIVID_OTHER_TYPES , middle_radius
#define SIVID_OTHER_PACKS , sivid::pack<1>, sivid::pack<8>
#else // each is another integrator to compile
#define SIVID_OTHER_TYPES
#define SIVID_OTHER_PACKS
#endif
/// All of one lane; and packs besides.
#define SIVID_SINGLE_TYPES                                                                         \
    sivid::interval, support::boost_type, support::coarse SIVID_OTHER_TYPES SIVID_MP_TYPES
#define SIVID_INTERVAL_TYPES SIVID_SINGLE_TYPES, sivid::pack<3> SIVID_OTHER_PACKS

#endif
