// SPDX-License-Identifier: MIT
#if defined(SIVID_HAS_MPFI)

#include <sivid/number/mp_interval.hpp>

#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

#include <limits>

using namespace sivid;

namespace {

using t = interval_traits<proven_interval>;

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
#define SIVID_CHECK(f, ...)                                                                        \
    check(                                                                                         \
        mpfr_##f, [&](interval x) { return t::f({x} __VA_OPT__(, ) __VA_ARGS__).bounds; },         \
        [](interval x) { return sivid::f(x); })
    bool cut = false;
    SIVID_CHECK(exp);
    SIVID_CHECK(expm1);
    SIVID_CHECK(sin);
    SIVID_CHECK(cos);
    SIVID_CHECK(atan);
    SIVID_CHECK(sinh);
    SIVID_CHECK(cosh);
    SIVID_CHECK(tanh);
    SIVID_CHECK(asinh);
    SIVID_CHECK(log, cut);
    SIVID_CHECK(log1p, cut);
    SIVID_CHECK(tan, cut);
    SIVID_CHECK(asin, cut);
    SIVID_CHECK(acos, cut);
    SIVID_CHECK(acosh, cut);
    SIVID_CHECK(atanh, cut);
#undef SIVID_CHECK
    CHECK(equal(t::pow({make(2, 3)}, {make(0.5, 1)}, cut).bounds, make(0x1.6a09e667f3bccp0, 3)));
    CHECK(equal(t::pown({make(-2, 3)}, 3, cut).bounds, make(-8, 27)));
    CHECK(equal(t::hypot({make(3, 3)}, {make(4, 4)}).bounds, make(5, 5)));
    CHECK(equal(t::atan2({make(1, 1)}, {make(0, 0)}, cut).bounds,
                make(0x1.921fb54442d18p0, 0x1.921fb54442d19p0)));
}

TEST_CASE("proven functions report a cut domain and keep the empty set") {
    bool cut = false;
    CHECK(is_empty(t::exp({nothing()}).bounds));
    CHECK(equal(t::log({make(1, 1)}, cut).bounds, make(0, 0)));
    CHECK_FALSE(cut);
    t::log({make(0, 1)}, cut);
    CHECK(cut);
    cut = false;
    CHECK(is_empty(t::asin({make(2, 3)}, cut).bounds));
    CHECK(cut);
    proven_interval const e = t::exp(t::point(1.0));
    CHECK(t::lower(e) == 0x1.5bf0a8b145769p1);
    CHECK(t::upper(e) == 0x1.5bf0a8b14576ap1);
    // Beyond the range of double.
    CHECK(equal(t::exp({make(1000, 1000)}).bounds,
                make(std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity())));
}

#endif
