// SPDX-License-Identifier: MIT
#if defined(SIVID_HAS_MPFI)

#include <sivid/number/mp_functions.hpp>

#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

using namespace sivid;

namespace {

/// `tight` is the tightest enclosure at points of the domain, and lies in `fast`.
template <class Tight, class Fast>
void check(oracle::unary exact, Tight const& tight, Fast const& fast) {
    oracle::inputs in{31};
    for (int i = 0; i < 3'000; ++i) {
        double const x = in.mixed();
        oracle::value const v = oracle::at(exact, x);
        if (!v.defined() || v.above - v.below != v.above - v.below) continue;
        interval const y = tight(interval{x});
        INFO("argument " << x);
        REQUIRE(lower(y) == v.below);
        REQUIRE(upper(y) == v.above);
        REQUIRE(subset(y, fast(interval{x})));
    }
}

} // namespace

TEST_CASE("proven functions are tight, and the library's enclose them") {
#define SIVID_CHECK(f)                                                                             \
    check(                                                                                         \
        mpfr_##f, [](interval x) { return proven::f(x); }, [](interval x) { return sivid::f(x); })
    SIVID_CHECK(exp);
    SIVID_CHECK(expm1);
    SIVID_CHECK(log);
    SIVID_CHECK(log1p);
    SIVID_CHECK(sin);
    SIVID_CHECK(cos);
    SIVID_CHECK(tan);
    SIVID_CHECK(asin);
    SIVID_CHECK(acos);
    SIVID_CHECK(atan);
    SIVID_CHECK(sinh);
    SIVID_CHECK(cosh);
    SIVID_CHECK(tanh);
    SIVID_CHECK(asinh);
    SIVID_CHECK(acosh);
    SIVID_CHECK(atanh);
#undef SIVID_CHECK
    CHECK(equal(proven::pow(make(2, 3), make(0.5, 1)), make(0x1.6a09e667f3bccp0, 3)));
    CHECK(equal(proven::pown(make(-2, 3), 3), make(-8, 27)));
    CHECK(equal(proven::hypot(make(3, 3), make(4, 4)), make(5, 5)));
    CHECK(equal(proven::atan2(make(1, 1), make(0, 0)),
                make(0x1.921fb54442d18p0, 0x1.921fb54442d19p0)));
}

TEST_CASE("proven functions report a cut domain and keep the empty set") {
    bool cut = false;
    CHECK(is_empty(proven::exp(nothing())));
    CHECK(equal(proven::log(make(1, 1), cut), make(0, 0)));
    CHECK_FALSE(cut);
    proven::log(make(0, 1), cut);
    CHECK(cut);
    cut = false;
    CHECK(is_empty(proven::asin(make(2, 3), cut)));
    CHECK(cut);
    // In code for any interval type.
    using t = interval_traits<proven_interval>;
    proven_interval const e = t::exp(t::point(1.0));
    CHECK(t::lower(e) == 0x1.5bf0a8b145769p1);
    CHECK(t::upper(e) == 0x1.5bf0a8b14576ap1);
}

#endif
