// SPDX-License-Identifier: MIT
// How much wider than necessary elementary functions are, as `elementary.hpp` says.
#include <sivid/number/elementary.hpp>

#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <bit>
#include <cstdint>
#include <cstdlib>

using sivid::interval;

namespace {

std::int64_t floats_between(double a, double b) {
    auto const order = [](double x) {
        auto const magnitude =
            static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
        return x < 0.0 ? -magnitude : magnitude;
    };
    return order(b) - order(a);
}

/// Over random points, enclosures contain the value, and exceed the tightest one by at most
/// `allowed` floats a side.
template <class Function>
void check(oracle::unary exact, int allowed, Function const& f) {
    oracle::inputs in{static_cast<std::uint64_t>(allowed) + 77};
    for (int i = 0; i < 40'000; ++i) {
        double const x = in.mixed();
        oracle::value const v = oracle::at(exact, x);
        if (!v.defined() || v.above - v.below != v.above - v.below) continue;
        interval const y = f(interval{x});
        INFO("argument " << x);
        REQUIRE(v.in(lower(y), upper(y)));
        REQUIRE(floats_between(lower(y), v.below) <= allowed);
        REQUIRE(floats_between(v.above, upper(y)) <= allowed);
    }
}

} // namespace

TEST_CASE("enclosures at points exceed the exact value by no more than is said") {
    check(mpfr_exp, 3, [](interval x) { return sivid::exp(x); });
    check(mpfr_expm1, 8, [](interval x) { return sivid::expm1(x); });
    check(mpfr_log, 4, [](interval x) { return sivid::log(x); });
    check(mpfr_log1p, 4, [](interval x) { return sivid::log1p(x); });
    check(mpfr_sin, 3, [](interval x) { return sivid::sin(x); });
    check(mpfr_cos, 3, [](interval x) { return sivid::cos(x); });
    check(mpfr_tan, 4, [](interval x) { return sivid::tan(x); });
    check(mpfr_asin, 3, [](interval x) { return sivid::asin(x); });
    check(mpfr_acos, 3, [](interval x) { return sivid::acos(x); });
    check(mpfr_atan, 3, [](interval x) { return sivid::atan(x); });
    check(mpfr_sinh, 5, [](interval x) { return sivid::sinh(x); });
    check(mpfr_cosh, 3, [](interval x) { return sivid::cosh(x); });
    check(mpfr_tanh, 5, [](interval x) { return sivid::tanh(x); });
    check(mpfr_asinh, 8, [](interval x) { return sivid::asinh(x); });
    check(mpfr_acosh, 8, [](interval x) { return sivid::acosh(x); });
    check(mpfr_atanh, 8, [](interval x) { return sivid::atanh(x); });
}
