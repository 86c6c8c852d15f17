// SPDX-License-Identifier: MIT
#include <sivid/number/rounding.hpp>

#include "support/catch.hpp"
#include "support/oracle.hpp"

#include <cfenv>
#include <cmath>
#include <limits>

using namespace sivid::detail;

namespace {

bool same(double a, double b) { return a == b || (a != a && b != b); }

/// Tight in both directions, whatever the caller's rounding mode is; the mode is kept.
template <class Down, class Up>
std::size_t wrong(std::uint64_t seed, int mode, oracle::binary exact, Down const& down,
                  Up const& up) {
    oracle::inputs in{seed};
    std::size_t count = 0;
    for (int i = 0; i < 40'000; ++i) {
        double const x = in.mixed();
        double const y = in.below(4) == 0 ? oracle::inputs::moved(-x, 2) : in.mixed();
        std::fesetround(mode);
        double const lo = down(x, y), hi = up(x, y);
        if (std::fegetround() != mode) ++count;
        std::fesetround(FE_TONEAREST);
        oracle::value const v = oracle::at(exact, x, y);
        if (!v.defined()) continue;
        if (!same(lo, v.below) || !same(hi, v.above)) ++count;
    }
    return count;
}

} // namespace

TEST_CASE("directed operations are tight in every rounding mode of the caller") {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    CHECK(wrong(1, mode, mpfr_add, add_down, add_up) == 0);
    CHECK(wrong(2, mode, mpfr_mul, mul_down, mul_up) == 0);
    CHECK(wrong(3, mode, mpfr_div, div_down, div_up) == 0);
    oracle::binary const root = [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr, mpfr_rnd_t d) {
        return mpfr_sqrt(r, x, d);
    };
    CHECK(wrong(
              4, mode, root, [](double x, double) { return sqrt_down(x); },
              [](double x, double) { return sqrt_up(x); }) == 0);
}

TEST_CASE("the slow way is tight in every rounding mode of the caller") {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    constexpr auto down = direction::down, up = direction::up;
    CHECK(wrong(5, mode, mpfr_add, directed_add<down>, directed_add<up>) == 0);
    CHECK(wrong(6, mode, mpfr_mul, directed_mul<down>, directed_mul<up>) == 0);
    CHECK(wrong(7, mode, mpfr_div, directed_div<down>, directed_div<up>) == 0);
    oracle::binary const root = [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr, mpfr_rnd_t d) {
        return mpfr_sqrt(r, x, d);
    };
    CHECK(wrong(
              8, mode, root, [](double x, double) { return directed_sqrt<direction::down>(x); },
              [](double x, double) { return directed_sqrt<direction::up>(x); }) == 0);
}

TEST_CASE("directed operations at the ends of the range") {
    constexpr double max = std::numeric_limits<double>::max(),
                     inf = std::numeric_limits<double>::infinity();
    constexpr double tiny = std::numeric_limits<double>::denorm_min();
    CHECK(add_down(max, max) == max);
    CHECK(add_up(max, max) == inf);
    CHECK(add_down(-max, -max) == -inf);
    CHECK(add_up(-max, -max) == -max);
    CHECK(add_up(max, tiny) == inf);
    CHECK(add_down(max, tiny) == max);
    CHECK(add_down(-inf, max) == -inf);
    CHECK(add_up(inf, -max) == inf);
    CHECK(mul_down(max, 2.0) == max);
    CHECK(mul_up(max, 2.0) == inf);
    CHECK(mul_down(tiny, 0.5) == 0.0);
    CHECK(mul_up(tiny, 0.5) == tiny);
    CHECK(mul_down(-tiny, tiny) == -tiny);
    CHECK(std::isnan(add_up(std::nan(""), 1.0)));
    CHECK(div_up(tiny, 3.0) == tiny);
    CHECK(div_down(1.0, inf) == 0.0);
    CHECK(sqrt_down(0.0) == 0.0);
    CHECK(sqrt_up(inf) == inf);
}

TEST_CASE("steps between floats") {
    constexpr double max = std::numeric_limits<double>::max(),
                     inf = std::numeric_limits<double>::infinity();
    static_assert(next_up(0.0) == std::numeric_limits<double>::denorm_min());
    static_assert(next_down(0.0) == -std::numeric_limits<double>::denorm_min());
    static_assert(next_up(-0.0) == std::numeric_limits<double>::denorm_min());
    static_assert(next_down(inf) == max && next_up(max) == inf && next_up(inf) == inf);
    static_assert(step(1.0, 2) == 1.0 + 2 * std::numeric_limits<double>::epsilon());
    static_assert(step(-inf, 1) == -max && step(max, 5) == inf);
    CHECK(std::isnan(step(std::nan(""), 3)));
    oracle::inputs in{9};
    for (int i = 0; i < 10'000; ++i) {
        double const x = in.any();
        CHECK(next_up(x) == std::nextafter(x, inf));
        CHECK(next_down(x) == std::nextafter(x, -inf));
    }
}

TEST_CASE("with_rounding clears flush-to-zero and puts everything back") {
    unsigned const before = read_mxcsr();
    write_mxcsr(before | mxcsr_flush | 0x2000);
    unsigned const mine = read_mxcsr();
    {
        with_rounding<direction::up> const mode;
        CHECK((read_mxcsr() & (mxcsr_flush | mxcsr_rounding)) == 0x4000);
    }
    unsigned const after = read_mxcsr();
    double const product = directed_mul<direction::up>(opaque(1e-200), 1e-200);
    write_mxcsr(before);
    CHECK(after == mine);
    CHECK(product == std::numeric_limits<double>::denorm_min()); // the slow way does not see FTZ
}

#if !defined(__AVX512F__)
TEST_CASE("pairs of products are tight in every rounding mode of the caller") {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    oracle::inputs in{10};
    for (int i = 0; i < 60'000; ++i) {
        double const a = in.mixed(), b = in.mixed();
        double const c = in.magnitude(-500, 500), d = in.magnitude(-500, 500);
        std::fesetround(mode);
        __m128d const p = mul_up_pair(_mm_set_pd(c, a), _mm_set_pd(d, b));
        std::fesetround(FE_TONEAREST);
        REQUIRE(_mm_cvtsd_f64(p) == oracle::at(mpfr_mul, a, b).above);
        REQUIRE(_mm_cvtsd_f64(_mm_unpackhi_pd(p, p)) == oracle::at(mpfr_mul, c, d).above);
    }
}
#endif
