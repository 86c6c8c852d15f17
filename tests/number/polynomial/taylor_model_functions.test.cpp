// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

/// A random model whose values lie in [lo, hi], often up to its ends.
template <std::size_t N, std::size_t D>
support::sized_model<N, D> within(draws& d, double lo, double hi, double radius_share) {
    auto a = support::random_model<N, D>(d, 1, 0.8, 0);
    a.c()[0] = 0;
    a.r() = radius_share;
    a.finish();
    auto const values = range(a);
    // affine map of the range into [lo, hi]
    double const centre = 0.5 * (lo + hi) - (hi - lo) * mid(values) / width(values);
    auto b = scaled(a, 0.999999 * (hi - lo) / width(values));
    b.c()[0] = centre;
    b.finish();
    return b;
}

struct function {
    std::string name;
    double lo, hi; ///< where it is tried; the ends are close to those of the domain
    std::function<mp(mp const&)> exact;
    /// by a template that is instantiated below
    int which;
};

std::vector<function> const functions = {
    {"reciprocal", 1e-3, 2, [](mp const& x) { return mp(1 / x); }, 0},
    {"reciprocal", -5, -0.5, [](mp const& x) { return mp(1 / x); }, 0},
    {"sqrt", 1e-4, 3, [](mp const& x) { return mp(sqrt(x)); }, 1},
    {"sqrt", 2, 3, [](mp const& x) { return mp(sqrt(x)); }, 1},
    {"exp", -8, 8, [](mp const& x) { return mp(exp(x)); }, 2},
    {"exp", -0.5, 0.5, [](mp const& x) { return mp(exp(x)); }, 2},
    {"log", 1e-3, 4, [](mp const& x) { return mp(log(x)); }, 3},
    {"log", 3, 5, [](mp const& x) { return mp(log(x)); }, 3},
    {"sin", -4, 5, [](mp const& x) { return mp(sin(x)); }, 4},
    {"sin", 1, 1.5, [](mp const& x) { return mp(sin(x)); }, 4},
    {"cos", -4, 5, [](mp const& x) { return mp(cos(x)); }, 5},
    {"cos", -0.1, 0.3, [](mp const& x) { return mp(cos(x)); }, 5},
    {"tan", -1.56, 1.5, [](mp const& x) { return mp(tan(x)); }, 6},
    {"tan", 0.2, 0.6, [](mp const& x) { return mp(tan(x)); }, 6},
    {"atan", -30, 20, [](mp const& x) { return mp(atan(x)); }, 7},
    {"atan", -0.2, 0.7, [](mp const& x) { return mp(atan(x)); }, 7},
    {"tanh", -6, 4, [](mp const& x) { return mp(tanh(x)); }, 8},
    {"tanh", -0.2, 0.7, [](mp const& x) { return mp(tanh(x)); }, 8},
    {"tanh", -2, 2, [](mp const& x) { return mp(tanh(x)); }, 8},
    {"1 - tanh^2", -4, 3, [](mp const& x) { return mp(1 / (cosh(x) * cosh(x))); }, 9},
    {"1 - tanh^2", 0.1, 0.6, [](mp const& x) { return mp(1 / (cosh(x) * cosh(x))); }, 9},
};

taylor_model<double> image(int which, taylor_model<double> const& s, bool& undefined) {
    constexpr univariate by_series[] = {univariate::exp,  univariate::log,         univariate::sin,
                                        univariate::cos,  univariate::tan,         univariate::atan,
                                        univariate::tanh, univariate::sech_squared};
    if (which == 0) return reciprocal(s, undefined);
    if (which == 1) return sqrt(s, undefined);
    return apply(by_series[which - 2], s, undefined);
}

template <std::size_t N, std::size_t D>
void check(std::uint64_t seed, int trials) {
    draws d(seed);
    int defined = 0;
    for (auto const& f : functions) {
        for (int trial = 0; trial < trials; ++trial) {
            // ranges from a point-like one to the whole of [lo, hi]
            double const share = trial == 0 ? 1 : std::pow(10, -d.uniform(0, 6));
            double const lo = f.lo + d.uniform(0, 1) * (1 - share) * (f.hi - f.lo);
            auto const s = within<N, D>(d, lo, lo + share * (f.hi - f.lo), d.coin() ? 0 : 0.2);
            bool undefined = false;
            auto const y = image(f.which, s, undefined);
            if (undefined) {
                REQUIRE_FALSE(std::isfinite(y.r()));
                continue;
            }
            ++defined;
            for (int sample = 0; sample < 12; ++sample) {
                auto const q = support::short_point(d, N);
                auto const x = support::member<mp>(d, s, q);
                CAPTURE(f.name, N, D, trial, share, y.r());
                REQUIRE(support::holds(y, q, f.exact(x), 1e-40));
            }
        }
    }
    REQUIRE(defined > trials * static_cast<int>(functions.size()) * 3 / 4);
}

/// s is a constant up to rounding: the image is a number up to rounding.
template <std::size_t N, std::size_t D>
void check_sharp() {
    for (auto const& f : functions) {
        double const x = f.lo + 0.625 * (f.hi - f.lo);
        bool undefined = false;
        auto const y = image(f.which, support::sized_model<N, D>::constant(x), undefined);
        REQUIRE_FALSE(undefined);
        CAPTURE(f.name, y.r(), y.c()[0]);
        REQUIRE(y.r() <= 1e-14 * std::abs(y.c()[0]) + 1e-15);
    }
}

} // namespace

TEST_CASE("elementary functions of Taylor models contain the functions of members") {
    check<2, 3>(21, 40);
    check<1, 6>(22, 20);
    check<3, 1>(23, 40);
}

TEST_CASE("elementary functions of constants are sharp") { check_sharp<2, 3>(); }

TEST_CASE("the remainder falls with the power of the range") {
    using model = support::sized_model<1, 3>;
    for (auto const& f : functions) {
        double const x = f.lo + 0.625 * (f.hi - f.lo);
        bool undefined = false;
        double const r1 = image(f.which, model::variable(0, x, 1e-2 * std::abs(x)), undefined).r();
        double const r2 = image(f.which, model::variable(0, x, 1e-3 * std::abs(x)), undefined).r();
        REQUIRE_FALSE(undefined);
        CAPTURE(f.name, r1, r2);
        REQUIRE(r2 <= 1e-3 * r1 + 2e-14);
    }
}

TEST_CASE("over wide ranges little of a function that saturates is lost") {
    using model = support::sized_model<2, 3>;
    auto const s = model::variable(0, 0.1, 1.5) + model::variable(1, 0, 0.5);
    auto const lost = [&s](int which) {
        bool undefined = false;
        auto const y = image(which, s, undefined);
        REQUIRE_FALSE(undefined);
        return y.r();
    };
    CHECK(lost(8) < 0.2);  // Lagrange's remainder is 16, the best cubic is off by 0.07
    CHECK(lost(9) < 0.42); // Lagrange: 100; the best cubic is even, and off by 0.14
    CHECK(lost(7) < 0.12); // Lagrange: 48
    bool undefined = false;
    // Far out the range is what is known.
    CHECK(apply(univariate::tanh, scaled(s, 1e3), undefined).r() <= 1.001);
    CHECK(apply(univariate::sech_squared, scaled(s, 1e3), undefined).r() <= 0.501);
    CHECK_FALSE(undefined);
}

TEST_CASE("arguments at or beyond the end of a domain are reported") {
    using model = support::sized_model<1, 2>;
    auto const reports = [](int which, double centre, double slope, double radius) {
        bool undefined = false;
        auto const y = image(which, widened(model::variable(0, centre, slope), radius), undefined);
        return undefined && !std::isfinite(y.r());
    };
    for (int const which : {0, 1, 3}) { // 1/s, sqrt, log
        CAPTURE(which);
        REQUIRE(reports(which, 1, 1, 0));
        REQUIRE(reports(which, 1, 0.5, 0.5));
        REQUIRE(reports(which, 0, 0, 0));
        REQUIRE_FALSE(reports(which, 1, 0.5, 0.49));
        REQUIRE_FALSE(reports(which, 1, 0.999, 0));
        REQUIRE(reports(which, 1, 0, std::nan("")));
        REQUIRE(reports(which, 1, 0, HUGE_VAL));
    }
    REQUIRE(reports(1, -1, 0.5, 0));
    REQUIRE(reports(3, -1, 0.5, 0));
    REQUIRE(reports(6, 1.5, 0.1, 0)); // tan
    REQUIRE_FALSE(reports(6, 1.5, 0.05, 0));
}

TEST_CASE("a domain that only Bernstein's bounds keep clear of zero") {
    // 1.2 + q + q^2/2 >= 0.7; the norms alone would allow -0.3.
    using model = support::sized_model<1, 4>;
    auto const x = model::variable(0, 0, 1);
    auto const s = model::constant(1.2) + x + scaled(x * x, 0.5);
    REQUIRE(rough_range(s).lower() < 0);
    draws d(30);
    for (int const which : {0, 1, 3}) {
        bool undefined = false;
        auto const y = image(which, s, undefined);
        REQUIRE_FALSE(undefined);
        for (int sample = 0; sample < 200; ++sample) {
            std::vector<double> const q{d.uniform(-1, 1)};
            mp const v = support::value<mp>(s, q);
            mp const exact = which == 0 ? mp(1 / v) : which == 1 ? mp(sqrt(v)) : mp(log(v));
            REQUIRE(support::holds(y, q, exact, 1e-40));
        }
    }
}

TEST_CASE("square roots whose polynomial guess is negative somewhere") {
    // Far from the centre the binomial series of degree 4 turns negative: no bound may use that the
    // guess is positive.
    using model = support::sized_model<1, 4>;
    draws d(31);
    auto const x = model::variable(0, 0, 1);
    for (double const top : {3.0, 8.0, 20.0, 60.0}) {
        for (double const power : {1.0, 2.0}) {
            auto const t = power == 1.0 ? x * x : x * x * x * x;
            auto const s = model::constant(1.0) + scaled(t, top);
            bool undefined = false;
            auto const y = sqrt(s, undefined);
            if (undefined) continue;
            for (int sample = 0; sample < 40; ++sample) {
                std::vector<double> const q{sample == 0 ? 1.0 : d.uniform(-1, 1)};
                REQUIRE(support::holds(y, q, mp(sqrt(support::value<mp>(s, q))), 1e-40));
            }
        }
    }
}

TEST_CASE("tiny and huge arguments") {
    using model = support::sized_model<1, 2>;
    draws d(32);
    for (double const size : {1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300}) {
        auto const s = model::variable(0, size, 0.25 * size);
        for (int const which : {0, 1, 3}) {
            bool undefined = false;
            auto const y = image(which, s, undefined);
            if (undefined || !std::isfinite(y.r())) continue;
            for (double const q : {-1.0, 0.0, 0.5, 1.0}) {
                mp const v = support::value<mp>(s, {q});
                mp const exact = which == 0 ? mp(1 / v) : which == 1 ? mp(sqrt(v)) : mp(log(v));
                CAPTURE(size, which, q);
                mp const error = abs(exact - support::value<mp>(y, {q}));
                REQUIRE(error <= mp(y.r()));
            }
        }
    }
}
