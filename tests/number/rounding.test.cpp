// SPDX-License-Identifier: MIT
#include <sivid/number/rounding.hpp>

#include "support/catch.hpp"
#include "support/flushing.hpp"
#include "support/oracle.hpp"

#include <cfenv>
#include <cmath>
#include <limits>
#include <type_traits>

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

/// MPFR with the exponents of doubles, subnormals included.
class doubles_of_mpfr {
public:
    doubles_of_mpfr() : emin_{mpfr_get_emin()}, emax_{mpfr_get_emax()} {
        mpfr_inits2(53, a_, b_, r_, nullptr);
        mpfr_set_emin(-1073);
        mpfr_set_emax(1024);
    }
    ~doubles_of_mpfr() {
        mpfr_set_emin(emin_);
        mpfr_set_emax(emax_);
        mpfr_clears(a_, b_, r_, nullptr);
    }
    doubles_of_mpfr(doubles_of_mpfr const&) = delete;
    doubles_of_mpfr& operator=(doubles_of_mpfr const&) = delete;

    double operator()(oracle::binary f, double x, double y, mpfr_rnd_t mode) {
        mpfr_set_d(a_, x, MPFR_RNDN);
        mpfr_set_d(b_, y, MPFR_RNDN);
        int const inexact = f(r_, a_, b_, mode);
        mpfr_subnormalize(r_, inexact, mode);
        return mpfr_get_d(r_, mode);
    }

private:
    mpfr_exp_t emin_, emax_;
    mpfr_t a_, b_, r_;
};

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
#if SIVID_MACHINE_X86_64
    CHECK(wrong(5, mode, mpfr_add, directed_add<down>, directed_add<up>) == 0);
#endif
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

TEST_CASE("with_rounding clears flush-to-zero where it can, and puts everything back") {
    constexpr auto wanted = SIVID_MACHINE_X86_64 ? direction::up : direction::nearest;
    for (auto const flags : flushing::combinations()) {
        control_word inside{};
        flushing::word mine{}, after{};
        double product = 0.0;
        {
            flushing::state const s{flags};
            std::fesetround(FE_DOWNWARD);
            mine = flushing::read();
            {
                with_rounding<wanted> const mode;
                inside = read_control();
            }
            after = flushing::read();
            product = directed_mul<direction::up>(opaque(1e-200), 1e-200);
        }
        std::fesetround(FE_TONEAREST); // the x87 unit has a mode of its own
        CHECK((inside & (control_flush | control_rounding)) == rounding_bits(wanted));
        CHECK(after == mine);
        // The slow way does not see flushing.
        CHECK(product == std::numeric_limits<double>::denorm_min());
    }
}

TEST_CASE("rounding by integers is right at ties, subnormals and overflows") {
    // Both neighbours and the nearest, with the range of doubles, as MPFR has them.
    constexpr auto down = direction::down, up = direction::up, near = direction::nearest;
    static_assert(exactly_rounded_product<up>(0x1p-1074, 0.5) == 0x1p-1074);
    static_assert(exactly_rounded_product<near>(0x1p-1074, 0.5) == 0.0);       // a tie, to even
    static_assert(exactly_rounded_product<near>(0x3p-1074, 0.5) == 0x1p-1073); // likewise
    static_assert(exactly_rounded_product<down>(0x1p1023, 2.0) == 0x1.fffffffffffffp1023);
    static_assert(exactly_rounded_product<near>(0x1p1023, 2.0) ==
                  std::numeric_limits<double>::infinity());
    static_assert(exactly_rounded_product<up>(-0x1p1023, 2.0) == -0x1.fffffffffffffp1023);
    static_assert(exactly_rounded_quotient<down>(-0x1p-1074, 0x1p1000) == -0x1p-1074);
    static_assert(exactly_rounded_quotient<up>(0x1.fffffffffffffp-1022, 2.0) == 0x1p-1022);
    static_assert(exactly_rounded_quotient<down>(0x1.fffffffffffffp-1022, 2.0) ==
                  0x0.fffffffffffffp-1022);
    static_assert(exactly_rounded_root<down>(0x1p-1074) == 0x1p-537);
    static_assert(exactly_rounded_integer<up>(false, 0xffff'ffff'ffff'ffff) == 0x1p64);
    static_assert(exactly_rounded_integer<down>(false, (1ull << 53) + 1) == 0x1p53);
    static_assert(exactly_rounded_integer<up>(true, (1ull << 53) + 1) == -0x1p53);
    CHECK(std::signbit(exactly_rounded_product<up>(-0x1p-1074, 0.5)));
    CHECK(std::signbit(exactly_rounded_quotient<near>(0.0, -3.0)));
    CHECK(std::isnan(exactly_rounded_product<up>(opaque(0.0), INFINITY)));
    CHECK(std::isnan(exactly_rounded_root<up>(-0x1p-1074)));

    doubles_of_mpfr mpfr;
    oracle::inputs in{11};
    std::size_t wrong = 0;
    auto const compare = [&](double x, double y) {
        auto const one = [&](auto d, mpfr_rnd_t m) {
            constexpr direction D = decltype(d)::value;
            if (!same(exactly_rounded_product<D>(x, y), mpfr(mpfr_mul, x, y, m))) ++wrong;
            if (!same(exactly_rounded_quotient<D>(x, y), mpfr(mpfr_div, x, y, m))) ++wrong;
            oracle::binary const root = [](mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t to) {
                return mpfr_sqrt(r, a, to);
            };
            if (!same(exactly_rounded_root<D>(x), mpfr(root, x, y, m))) ++wrong;
        };
        one(std::integral_constant<direction, near>{}, MPFR_RNDN);
        one(std::integral_constant<direction, down>{}, MPFR_RNDD);
        one(std::integral_constant<direction, up>{}, MPFR_RNDU);
    };
    constexpr double inf = std::numeric_limits<double>::infinity();
    double const special[] = {0.0,       -0.0,      1.0,       -1.0,     2.0,
                              0x1p-1074, 0x3p-1074, 0x1p-1022, 0x1p-537, 0x0.fffffffffffffp-1022,
                              0x1p511,   0x1p1023,  inf,       -inf,     0x1.fffffffffffffp1023};
    for (double const x : special)
        for (double const y : special) compare(x, y);
    for (int i = 0; i < 20'000; ++i) compare(in.mixed(), in.mixed());
    for (int i = 0; i < 10'000; ++i) { // few bits and results among the subnormals: ties
        auto const few = [&](int scale) {
            return std::ldexp(static_cast<double>(1 + in.below(1u << 27)), scale);
        };
        double const x = few(-560 + static_cast<int>(in.below(40))), y = few(-540);
        compare(x, y);
        compare(x * 0x1p500, 0x1p30 / y);
        compare(x * y, y);
    }
    CHECK(wrong == 0);
}

#if SIVID_MACHINE_X86_64 && !defined(__AVX512F__)
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
