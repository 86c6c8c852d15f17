// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

struct function {
    std::string name;
    univariate f;
    double lo, hi; ///< where it is tried
    std::function<mp(mp const&)> exact;
};
std::vector<function> const functions = {
    {"exp", univariate::exp, -6, 6, [](mp const& x) { return mp(exp(x)); }},
    {"log", univariate::log, 1e-3, 9, [](mp const& x) { return mp(log(x)); }},
    {"sin", univariate::sin, -8, 8, [](mp const& x) { return mp(sin(x)); }},
    {"cos", univariate::cos, -8, 8, [](mp const& x) { return mp(cos(x)); }},
    {"tan", univariate::tan, -1.5, 1.5, [](mp const& x) { return mp(tan(x)); }},
    {"atan", univariate::atan, -20, 20, [](mp const& x) { return mp(atan(x)); }},
    {"tanh", univariate::tanh, -9, 9, [](mp const& x) { return mp(tanh(x)); }},
    {"1 - tanh^2", univariate::sech_squared, -9, 9,
     [](mp const& x) { return mp(1 / (cosh(x) * cosh(x))); }},
};

/// The largest |f - p| of some samples, the ends among them.
mp largest_error(function const& f, near_minimax const& p, double about, interval const& range,
                 draws& d) {
    mp most = 0;
    for (int sample = 0; sample < 60; ++sample) {
        mp const x = sample == 0   ? mp(range.lower())
                     : sample == 1 ? mp(range.upper())
                                   : mp(d.in(range));
        mp sum = 0;
        for (std::size_t k = p.degree() + 1; k-- > 0;) sum = sum * (x - about) + p[k];
        most = std::max(most, mp(abs(f.exact(x) - sum)));
    }
    return most;
}

} // namespace

TEST_CASE("the error of a near-minimax polynomial is bounded, and hardly more than what it is") {
    draws d(5);
    for (auto const& f : functions) {
        for (std::size_t degree = 1; degree <= most_near_minimax_degree; ++degree) {
            for (int trial = 0; trial < 24; ++trial) {
                double const share = trial == 0 ? 1 : std::pow(10, -d.uniform(0, 5));
                double const length = share * (f.hi - f.lo);
                double const lo = f.lo + d.uniform(0, 1) * (1 - share) * (f.hi - f.lo);
                interval const range(lo, std::min(lo + length, f.hi));
                double const about = d.in(range);
                near_minimax const p(f.f, about, range, degree);
                CAPTURE(f.name, degree, lo, length, p.error());
                REQUIRE(p.degree() == degree);
                REQUIRE(std::isfinite(p.error()));
                auto const seen = largest_error(f, p, about, range, d);
                REQUIRE(seen <= p.error());
                double const rounding = 1e-12 * (1 + std::abs(static_cast<double>(f.exact(lo))));
                if (share < 0.1) REQUIRE(p.error() <= 4 * static_cast<double>(seen) + rounding);
            }
        }
    }
}

TEST_CASE("near-minimax polynomials of functions that saturate are worth more than Taylor's") {
    for (double const reach : {1.0, 2.0, 4.0}) {
        auto const x = interval_traits<interval>::bounds(-reach, reach);
        for (auto const f : {univariate::tanh, univariate::atan}) {
            std::vector<interval> y(5);
            bool undefined = false;
            taylor_coefficients(f, x, 4, y.data(), undefined);
            CHECK(near_minimax(f, 0, x, 3).error() < 0.1 * mag(y[4]) * std::pow(reach, 4));
        }
    }
    CHECK(near_minimax(univariate::tanh, 0, interval(-2, 2), 3).error() < 0.15);
}

TEST_CASE("where a function is not smooth there is no polynomial") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    auto const error = [](univariate f, double lo, double hi) {
        return near_minimax(f, lo, interval_traits<interval>::bounds(lo, hi), 3).error();
    };
    CHECK(error(univariate::log, 0, 1) == infinite);
    CHECK(error(univariate::log, -1, 1) == infinite);
    CHECK(error(univariate::tan, 1, 2) == infinite);
    CHECK(error(univariate::sin, 1, infinite) == infinite);
    CHECK(error(univariate::exp, 0, 1e6) == infinite);
    CHECK(error(univariate::sin, 1, 1) == infinite); // nothing to interpolate between
    CHECK(near_minimax(univariate::sin, 0, interval(0, 1), 99).degree() ==
          most_near_minimax_degree);
}
