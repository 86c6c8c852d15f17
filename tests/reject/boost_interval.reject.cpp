// SPDX-License-Identifier: MIT
// Policies of Boost.Interval with which its operators prove nothing.
// reject 1: not known to round outward. Use the rounding policy
// reject 2: not known to round outward. Use the rounding policy
// reject 3: not known to round outward. Use the rounding policy
// reject 4: cannot be empty, but intersections are. Use the checking policy
// reject 5: not known to round outward. Use the rounding policy
#include <sivid/number/boost_interval.hpp>
#include <sivid/space/box.hpp>

#include <boost/numeric/interval.hpp>

using namespace sivid;
namespace lib = boost::numeric::interval_lib;
using opaque = lib::save_state<opaque_rounding>;
template <class Rounding, class Checking = lib::checking_base<double>>
using type = boost::numeric::interval<double, lib::policies<Rounding, Checking>>;

#if SIVID_REJECT == 1 // no rounding at all
using chosen = type<lib::save_state_nothing<lib::rounded_arith_exact<double>>>;
#elif SIVID_REJECT == 2 // Boost's own, with which g++ -O3 makes 1/3 a point
using chosen = boost::numeric::interval<double>;
#elif SIVID_REJECT == 3 // rounds only while somebody else has set the mode
using chosen = lib::unprotect<interval>::type;
#elif SIVID_REJECT == 4 // no empty set
using chosen = type<opaque, lib::checking_strict<double>>;
#elif SIVID_REJECT == 5 // a control that sets no mode
struct no_control {
    using rounding_mode = int;
    static void get_rounding_mode(int&) {}
    static void set_rounding_mode(int) {}
    static void upward() {}
    static void downward() {}
    static void to_nearest() {}
    static double to_int(double x) { return x; }
    static double force_rounding(double x) { return x; }
};
using chosen = type<lib::save_state<lib::rounded_arith_opp<double, no_control>>>;
#else
using chosen = type<opaque, lib::checking_catch_nan<double>>;
#endif

basic_box<chosen> const x(3);
