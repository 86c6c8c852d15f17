// SPDX-License-Identifier: MIT
#include <sivid/number/boost_interval.hpp>

#include "laws/containment.hpp"
#include "laws/laws.hpp"
#include "number/support.hpp"

#include <limits>

namespace {

namespace lib = boost::numeric::interval_lib;
using opaque = lib::save_state<sivid::opaque_rounding>;

template <class Rounding, class Checking>
using boost_interval = boost::numeric::interval<double, lib::policies<Rounding, Checking>>;

/// Throws where a NaN is handed over.
using strict_about_nan = boost_interval<opaque, lib::checking_catch_nan<double>>;
using careless_about_nan = boost_interval<opaque, lib::checking_no_nan<double>>;

/// A rounding policy that its author vouches for: one float on either side.
struct next_float {
    using unprotected_rounding = next_float;
    static constexpr double all = std::numeric_limits<double>::infinity();
    static double add_down(double x, double y) { return std::nextafter(x + y, -all); }
    static double add_up(double x, double y) { return std::nextafter(x + y, all); }
    static double sub_down(double x, double y) { return std::nextafter(x - y, -all); }
    static double sub_up(double x, double y) { return std::nextafter(x - y, all); }
    static double mul_down(double x, double y) { return std::nextafter(x * y, -all); }
    static double mul_up(double x, double y) { return std::nextafter(x * y, all); }
};
using vouched = boost_interval<next_float, lib::checking_base<double>>;

/// Another mark of emptiness than NaN.
struct empty_is_one_zero : lib::checking_base<double> {
    static double empty_lower() { return 1; }
    static double empty_upper() { return 0; }
};
using one_zero = boost_interval<opaque, empty_is_one_zero>;

} // namespace

template <>
inline constexpr bool sivid::rounds_outward<next_float> = true;

TEMPLATE_TEST_CASE(
    "Boost's interval with sound policies obeys the laws and contains what MPFR says", "",
    strict_about_nan, careless_about_nan, vouched, one_zero) {
    STATIC_REQUIRE(sivid::interval_scalar<TestType>);
    auto const failures = laws::all<TestType>(1'000, 5);
    for (auto const& failure : failures) UNSCOPED_INFO(failure);
    CHECK(failures.empty());
    for (auto const& m : laws::all_contained<TestType>(1'000, 6)) {
        INFO(m.first);
        CHECK(m.count == 0);
    }
}

TEMPLATE_TEST_CASE("what Boost holds for empty, broken or unbounded is read as it is meant", "",
                   strict_about_nan, careless_about_nan, vouched, one_zero) {
    using traits = sivid::interval_traits<TestType>;
    double const nan = sivid::detail::not_a_number, all = sivid::detail::infinity;
    for (auto const& none : {TestType(nan, nan, true), TestType(nan, 3, true),
                             TestType(3, nan, true), TestType(1, 0, true), traits::empty(),
                             traits::intersect(traits::bounds(0, 1), traits::bounds(2, 3))}) {
        CHECK(traits::is_empty(none));
        CHECK(std::isnan(traits::lower(none)));
        CHECK(std::isnan(traits::upper(none)));
        CHECK(traits::is_empty(traits::add(none, traits::entire())));
    }
    bool cut = false;
    auto const quotient = traits::div(traits::point(1), traits::bounds(-1, 1), cut);
    CHECK(cut);
    CHECK(traits::lower(quotient) == -all);
    CHECK(traits::upper(quotient) == all);
    cut = false;
    CHECK(traits::is_empty(traits::div(traits::point(1), traits::point(0), cut)));
    CHECK(cut);
    cut = false;
    auto const root = traits::sqrt(traits::bounds(-1, 4), cut);
    CHECK(cut);
    CHECK(traits::lower(root) == 0);
    CHECK(traits::upper(root) == 2);
    CHECK(traits::mid(traits::entire()) == 0);
    // Infinity is no number: what is said to be there lies beyond the greatest double.
    CHECK(std::isfinite(traits::lower(TestType(all, all, true))));
}

TEST_CASE("the operators of an accepted policy enclose") {
    strict_about_nan const one(1.0), three(3.0);
    auto const third = one / three;
    CHECK(third.lower() < third.upper());
    CHECK(sivid::subset(sivid::interval(third.lower(), third.upper()),
                        sivid::interval(0.3333, 0.3334)));
}

TEST_CASE("Boost's own rounding is taken where the compiler respects rounding modes") {
#ifdef __ROUNDING_MATH__
    CHECK(sivid::rounds_outward<lib::rounded_math<double>>);
#else
    CHECK_FALSE(sivid::rounds_outward<lib::rounded_math<double>>);
#endif
    CHECK_FALSE(sivid::rounds_outward<lib::rounded_arith_exact<double>>);
    CHECK_FALSE(sivid::rounds_outward<lib::save_state_nothing<sivid::opaque_rounding>>);
}
