// SPDX-License-Identifier: MIT
#include "support/pack_functions.hpp"

#include "number/pack_bounds.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

using sivid::interval;
using P = sivid::pack<8>;
using T = sivid::interval_traits<P>;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

void check_all_lanes(P const& x, double lo, double hi) {
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(x.lower(i) == lo);
        CHECK(x.upper(i) == hi);
    }
}

/// Floats from a to b.
double floats_between(double a, double b) {
    double n = 0.0;
    for (; a < b && n < 100.0; ++n) a = std::nextafter(a, inf);
    return n;
}

/// The greatest width, in floats, of f at points of [lo, hi].
template <class F>
double greatest_width(F const& f, double lo, double hi) {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> in{lo, hi};
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        double x[8];
        for (double& t : x) t = in(random);
        P const y = f(P::load(x, x));
        for (std::size_t k = 0; k < 8; ++k)
            worst = std::fmax(worst, floats_between(y.lower(k), y.upper(k)));
    }
    return worst;
}

/// Both bounds differ from the value by less than the error and one rounding; a float is at least
/// 2^-53 of its neighbours.
double allowed_width(double error) { return 2.0 * std::ceil(error) + 3.0; }

} // namespace

TEST_CASE("pack functions: operators are the operations of the traits") {
    P const x = T::bounds(1.0, 2.0), y = T::bounds(-3.0, 4.0);
    check_all_lanes(x + y, -2.0, 6.0);
    check_all_lanes(x - y, -3.0, 5.0);
    check_all_lanes(x * y, -6.0, 8.0);
    check_all_lanes(y / x, -3.0, 4.0);
    check_all_lanes(-y, -4.0, 3.0);
    P z = x;
    z += y;
    z -= y;
    z *= x;
    z /= x;
    check_all_lanes(z, -12.0, 18.0); // ((([1,2] + y) - y) x) / x, no correlation
    check_all_lanes(sqr(y), 0.0, 16.0);
    check_all_lanes(hull(x, y), -3.0, 4.0);
    check_all_lanes(intersect(x, y), 1.0, 2.0);
    check_all_lanes(min(x, y), -3.0, 2.0);
    check_all_lanes(max(x, y), 1.0, 4.0);
    check_all_lanes(abs(y), 0.0, 4.0);
    check_all_lanes(sign(y), -1.0, 1.0);
    check_all_lanes(pown(y, 2), 0.0, 16.0);
}

TEST_CASE("pack functions: values that are known exactly") {
    P const zero = T::point(0.0), one = T::point(1.0);
    check_all_lanes(exp(zero), 1.0, 1.0);
    check_all_lanes(log(one), 0.0, 0.0);
    check_all_lanes(sin(zero), 0.0, 0.0);
    check_all_lanes(cos(zero), 1.0, 1.0);
    check_all_lanes(tan(zero), 0.0, 0.0);
    check_all_lanes(atan(zero), 0.0, 0.0);
    check_all_lanes(tanh(zero), 0.0, 0.0);
    check_all_lanes(exp(T::entire()), 0.0, inf);
    check_all_lanes(log(T::entire()), -inf, inf);
    check_all_lanes(tanh(T::entire()), -1.0, 1.0);
    check_all_lanes(sin(T::entire()), -1.0, 1.0);
    check_all_lanes(atan(T::entire()), -0x1.921fb54442d19p+0, 0x1.921fb54442d19p+0);
    check_all_lanes(exp(T::point(1000.0)), 0x1.fffffffffffffp+1023, inf);
    check_all_lanes(exp(T::point(-1000.0)), 0.0, 0x1p-1074);
}

TEST_CASE("pack functions: extrema and poles between the ends") {
    check_all_lanes(sin(T::bounds(1.0, 2.0)), T::lower(sin(T::point(1.0))), 1.0);
    check_all_lanes(sin(T::bounds(4.0, 5.0)), -1.0, T::upper(sin(T::point(4.0))));
    check_all_lanes(sin(T::bounds(1.0, 5.0)), -1.0, 1.0);
    check_all_lanes(sin(T::bounds(-1000.0, 1000.0)), -1.0, 1.0);
    check_all_lanes(sin(T::bounds(2.0, 4.0)), T::lower(sin(T::point(4.0))),
                    T::upper(sin(T::point(2.0))));
    check_all_lanes(cos(T::bounds(-1.0, 0.5)), T::lower(cos(T::point(1.0))), 1.0);
    check_all_lanes(cos(T::bounds(3.0, 4.0)), -1.0, T::upper(cos(T::point(4.0))));
    check_all_lanes(cos(T::bounds(0.0, 0.5)), T::lower(cos(T::point(0.5))), 1.0);
    check_all_lanes(cos(T::bounds(0.0, 7.0)), -1.0, 1.0);
    std::uint64_t cut = 0;
    check_all_lanes(tan(T::bounds(-1.0, 1.0), cut), T::lower(tan(T::point(-1.0))),
                    T::upper(tan(T::point(1.0))));
    CHECK(cut == 0);
    check_all_lanes(tan(T::bounds(1.0, 2.0), cut), -inf, inf);
    CHECK(cut == T::all_lanes);
    // Half the lanes beyond the limit of the kernels: each is served.
    double const x[]{1.0, 1e22, 2.0, -1e300, 3.0, 0x1p20, 4.0, inf};
    double y[8];
    for (int i = 0; i < 8; ++i) y[i] = x[i] < inf ? x[i] : 1e308;
    P const far = sin(P::load(y, x));
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(far.lower(i) <= std::sin(x[i]));
        CHECK(far.upper(i) >= std::sin(x[i]));
        CHECK(far.upper(i) - far.lower(i) < 1e-15);
    }
    CHECK(far.lower(7) == -1.0);
    CHECK(far.upper(7) == 1.0);
}

TEST_CASE("pack functions: the excess width at points is what the derived errors allow") {
    namespace e = sivid::pack_error;
    CHECK(greatest_width([](P const& x) { return exp(x); }, -700.0, 700.0) <=
          allowed_width(e::exp));
    CHECK(greatest_width([](P const& x) { return log(x); }, 0.0, 30.0) <= allowed_width(e::log));
    CHECK(greatest_width([](P const& x) { return sin(x); }, -1e4, 1e4) <=
          allowed_width(e::sin_cos));
    CHECK(greatest_width([](P const& x) { return cos(x); }, -1e4, 1e4) <=
          allowed_width(e::sin_cos));
    CHECK(greatest_width([](P const& x) { return tan(x); }, -1e4, 1e4) <= allowed_width(e::tan));
    CHECK(greatest_width([](P const& x) { return atan(x); }, -20.0, 20.0) <=
          allowed_width(e::atan));
    CHECK(greatest_width([](P const& x) { return tanh(x); }, -20.0, 20.0) <=
          allowed_width(e::tanh));
}

TEST_CASE("pack functions: the constants are what the recurrences of the documentation give") {
    namespace e = sivid::pack_error;
    // At least the derived bound, and not more than a quarter above it.
    auto const holds = [](char const* name, double constant, double derived) {
        INFO(name << ": constant " << constant << ", derived " << derived);
        CHECK(constant >= derived);
        CHECK(constant <= 1.25 * derived + 0.1);
    };
    auto const h = pack_bounds::sinh_cosh();
    auto const w = pack_bounds::sin_cos();
    holds("exp", e::exp, pack_bounds::exp());
    holds("expm1", e::expm1, pack_bounds::expm1());
    holds("sinh", e::sinh, h.sinh);
    holds("cosh", e::cosh, h.cosh);
    holds("tanh", e::tanh, h.sinh_value + h.cosh_value + 0.01);
    holds("log", e::log, pack_bounds::log());
    holds("log1p", e::log1p, pack_bounds::log());
    holds("sin, cos", e::sin_cos, std::fmax(w.sin, w.cos));
    holds("tan", e::tan, w.sin_value + w.cos_value + 0.01);
    holds("atan", e::atan, pack_bounds::angle());
    holds("asin", e::asin, pack_bounds::angle());
    holds("acos", e::acos, pack_bounds::angle());
}

TEST_CASE("pack functions: never wider than the vocabulary type by more than a float or two") {
    std::mt19937_64 random{9};
    std::uniform_real_distribution<double> in{-20.0, 20.0};
    for (int i = 0; i < 500; ++i) {
        double const x = in(random);
        interval const s = sivid::sin(interval{x}), e = sivid::exp(interval{x});
        CHECK(floats_between(T::lower(sin(T::point(x))), T::upper(sin(T::point(x)))) <=
              floats_between(s.lower(), s.upper()));
        CHECK(floats_between(T::lower(exp(T::point(x))), T::upper(exp(T::point(x)))) <=
              floats_between(e.lower(), e.upper()));
    }
}

TEST_CASE("pack functions: forms with a mask of cut lanes") {
    std::uint64_t cut = 0;
    P x = T::point(2.0);
    x.set(3, interval{-1.0, 1.0});
    check_all_lanes(sqrt(T::point(4.0), cut), 2.0, 2.0);
    CHECK(cut == 0);
    CHECK(sqrt(x, cut).lower(3) == 0.0);
    CHECK(cut == 0b1000);
    cut = 0;
    CHECK(log(T::bounds(-1.0, 1.0), cut).lower(3) == -inf);
    CHECK(cut == T::all_lanes);
    cut = 0;
    CHECK(pown(x, -2, cut).lower(3) == 1.0);
    CHECK(cut == 0b1000);
}
