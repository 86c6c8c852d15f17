// SPDX-License-Identifier: MIT
#include <sivid/number/rounding/detail/excess.hpp>

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
/// `allowed` floats a side plus the one float that the library's result may be off.
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
        REQUIRE(floats_between(lower(y), v.below) <= 2 * allowed);
        REQUIRE(floats_between(v.above, upper(y)) <= 2 * allowed);
    }
}

} // namespace

TEST_CASE("enclosures at points exceed the exact value by no more than the table says") {
    namespace e = sivid::excess;
    check(mpfr_exp, e::exp, [](interval x) { return sivid::exp(x); });
    check(mpfr_expm1, e::expm1, [](interval x) { return sivid::expm1(x); });
    check(mpfr_log, e::log, [](interval x) { return sivid::log(x); });
    check(mpfr_log1p, e::log1p, [](interval x) { return sivid::log1p(x); });
    check(mpfr_sin, e::sin, [](interval x) { return sivid::sin(x); });
    check(mpfr_cos, e::cos, [](interval x) { return sivid::cos(x); });
    check(mpfr_tan, e::tan, [](interval x) { return sivid::tan(x); });
    check(mpfr_asin, e::asin, [](interval x) { return sivid::asin(x); });
    check(mpfr_acos, e::acos, [](interval x) { return sivid::acos(x); });
    check(mpfr_atan, e::atan, [](interval x) { return sivid::atan(x); });
    check(mpfr_sinh, e::sinh, [](interval x) { return sivid::sinh(x); });
    check(mpfr_cosh, e::cosh, [](interval x) { return sivid::cosh(x); });
    check(mpfr_tanh, e::tanh, [](interval x) { return sivid::tanh(x); });
    check(mpfr_asinh, e::asinh, [](interval x) { return sivid::asinh(x); });
    check(mpfr_acosh, e::acosh, [](interval x) { return sivid::acosh(x); });
    check(mpfr_atanh, e::atanh, [](interval x) { return sivid::atanh(x); });
}

#if SIVID_TRUSTS_LIBRARY

namespace {

/// Distance in floats of the library's plain results from the exact value; what `excess` must
/// exceed.
template <class Function>
std::int64_t largest_error(oracle::unary exact, std::uint64_t seed, int count, Function const& f) {
    oracle::inputs in{seed};
    std::int64_t worst = 0;
    for (int i = 0; i < count; ++i) {
        double const x = in.mixed();
        oracle::value const v = oracle::at(exact, x);
        if (!v.defined() || v.above - v.below != v.above - v.below) continue;
        double const y = f(x);
        std::int64_t const below = floats_between(v.below, y), above = floats_between(y, v.above);
        std::int64_t const off = below < above ? above : below;
        worst = off > worst ? off : worst;
    }
    return worst;
}

} // namespace

TEST_CASE("the C library is nearer than the table says") {
    namespace e = sivid::excess;
    int const count = 60'000;
    CHECK(largest_error(mpfr_exp, 1, count, [](double x) { return std::exp(x); }) < e::exp);
    CHECK(largest_error(mpfr_expm1, 2, count, [](double x) { return std::expm1(x); }) < e::expm1);
    CHECK(largest_error(mpfr_log, 3, count, [](double x) { return std::log(x); }) < e::log);
    CHECK(largest_error(mpfr_log1p, 4, count, [](double x) { return std::log1p(x); }) < e::log1p);
    CHECK(largest_error(mpfr_sin, 5, count, [](double x) { return std::sin(x); }) < e::sin);
    CHECK(largest_error(mpfr_cos, 6, count, [](double x) { return std::cos(x); }) < e::cos);
    CHECK(largest_error(mpfr_tan, 7, count, [](double x) { return std::tan(x); }) < e::tan);
    CHECK(largest_error(mpfr_atan, 8, count, [](double x) { return std::atan(x); }) < e::atan);
    CHECK(largest_error(mpfr_asin, 9, count, [](double x) { return std::asin(x); }) < e::asin);
    CHECK(largest_error(mpfr_acos, 10, count, [](double x) { return std::acos(x); }) < e::acos);
    CHECK(largest_error(mpfr_sinh, 11, count, [](double x) { return std::sinh(x); }) < e::sinh);
    CHECK(largest_error(mpfr_cosh, 12, count, [](double x) { return std::cosh(x); }) < e::cosh);
    CHECK(largest_error(mpfr_tanh, 13, count, [](double x) { return std::tanh(x); }) < e::tanh);
}

#endif
