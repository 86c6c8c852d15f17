// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <sivid/number/polynomial/taylor_model_functions.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

constexpr std::size_t order = 9;

using table = std::vector<std::pair<univariate, std::string>>;
table const functions = {{univariate::exp, "exp"},   {univariate::log, "log"},
                         {univariate::sin, "sin"},   {univariate::cos, "cos"},
                         {univariate::tan, "tan"},   {univariate::atan, "atan"},
                         {univariate::tanh, "tanh"}, {univariate::sech_squared, "1 - tanh^2"}};

template <std::size_t Order>
std::array<interval, Order + 1> coefficients(univariate f, interval const& x, bool& undefined) {
    std::array<interval, Order + 1> y;
    taylor_coefficients(f, x, Order, y.data(), undefined);
    return y;
}

/// \f$ f^{(k)}(x)/k! \f$, k = 0 .. order, each by a formula of its own (not a recurrence in k).
std::vector<mp> exact_coefficients(univariate f, mp const& x) {
    using namespace boost::multiprecision;
    std::vector<mp> y;
    mp factorial = 1;
    // tan^{(k)} = p_k(tan) with p_{k+1} = (1 + y^2) p_k'; the same for tanh with 1 - y^2.
    std::vector<mp> p{0, 1};
    if (f == univariate::sech_squared) p = {1, 0, -1}; // tanh' = 1 - tanh^2
    for (std::size_t k = 0; k <= order; ++k) {
        if (k > 0) factorial *= static_cast<unsigned>(k);
        switch (f) {
        case univariate::exp:
            y.push_back(exp(x) / factorial);
            break;
        case univariate::log:
            y.push_back(k == 0 ? mp(log(x))
                               : mp((k % 2 == 1 ? 1 : -1) /
                                    (static_cast<unsigned>(k) * pow(x, static_cast<int>(k)))));
            break;
        case univariate::sin:
        case univariate::cos: {
            std::size_t const phase = (k + (f == univariate::cos ? 1 : 0)) % 4;
            mp const value = phase % 2 == 0 ? mp(sin(x)) : mp(cos(x));
            y.push_back((phase >= 2 ? mp(-value) : value) / factorial);
            break;
        }
        case univariate::tan:
        case univariate::tanh:
        case univariate::sech_squared: {
            mp const v = f == univariate::tan ? mp(tan(x)) : mp(tanh(x));
            mp sum = 0;
            for (std::size_t j = p.size(); j-- > 0;) sum = sum * v + p[j];
            y.push_back(sum / factorial);
            std::vector<mp> next(p.size() + 1, mp(0));
            for (std::size_t j = 1; j < p.size(); ++j) {
                mp const d = p[j] * static_cast<unsigned>(j);
                next[j - 1] += d;
                next[j + 1] += f == univariate::tan ? d : mp(-d);
            }
            p = next;
            break;
        }
        case univariate::atan: { // sin(k a) / (k (1+x^2)^{k/2}) (-1)^{k-1}, a = angle of 1/x
            if (k == 0) {
                y.push_back(atan(x));
                break;
            }
            mp const angle = atan2(mp(1), x);
            mp const size = pow(sqrt(1 + x * x), static_cast<int>(k));
            mp const value =
                sin(static_cast<unsigned>(k) * angle) / (static_cast<unsigned>(k) * size);
            y.push_back(k % 2 == 1 ? value : mp(-value));
            break;
        }
        case univariate::reciprocal: {
            mp const size = 1 / pow(x, static_cast<int>(k) + 1);
            y.push_back(k % 2 == 1 ? mp(-size) : size);
            break;
        }
        case univariate::sqrt: { // binomial(1/2, k) x^(1/2 - k)
            mp value = sqrt(x);
            for (unsigned j = 0; j < k; ++j) value *= (mp(0.5) - j) / ((j + 1) * x);
            y.push_back(value);
            break;
        }
        }
    }
    return y;
}

interval somewhere(draws& d, univariate f, double radius) {
    if (f == univariate::log || f == univariate::reciprocal || f == univariate::sqrt) {
        double const c = std::exp(d.uniform(-8, 8));
        double const r = c * d.uniform(0, std::fmin(radius, 0.999));
        return interval_traits<interval>::bounds(c - r, c + r);
    }
    if (f == univariate::tan) {
        double const c = d.uniform(-1.5, 1.5);
        double const r = std::fmin(radius, 1.57 - std::abs(c)) * d.uniform(0, 1);
        return interval_traits<interval>::bounds(c - r, c + r);
    }
    if (f == univariate::exp || f == univariate::tanh || f == univariate::sech_squared)
        return d.interval(-20, 20, radius);
    return d.interval(-200, 200, radius);
}

} // namespace

TEST_CASE("Taylor coefficients of elementary functions enclose the derivatives") {
    draws d(11);
    for (auto const& [f, name] : functions) {
        INFO(name);
        for (double const radius : {0.0, 1e-6, 0.3, 2.0}) {
            for (int trial = 0; trial < 12; ++trial) {
                auto const x = somewhere(d, f, radius);
                bool undefined = false;
                auto const y = coefficients<order>(f, x, undefined);
                CAPTURE(radius, lower(x), upper(x));
                REQUIRE_FALSE(undefined);
                for (int sample = 0; sample < 3; ++sample) {
                    auto const exact = exact_coefficients(f, mp(d.in(x)));
                    for (std::size_t k = 0; k <= order; ++k) {
                        CAPTURE(k);
                        // 100 digits, of which cancellation may take some: far below a double's ulp
                        REQUIRE(support::encloses(y[k], exact[k], 1e-35));
                    }
                }
            }
        }
    }
}

TEST_CASE("Taylor coefficients at a point are sharp") {
    for (auto const& [f, name] : functions) {
        INFO(name);
        bool undefined = false;
        auto const y = coefficients<order>(f, interval(0.75), undefined);
        auto const exact = exact_coefficients(f, mp(0.75));
        REQUIRE_FALSE(undefined);
        for (std::size_t k = 0; k <= order; ++k) {
            CAPTURE(k);
            REQUIRE(width(y[k]) <= 1e-13 * (0.1 + std::abs(static_cast<double>(exact[k]))));
        }
    }
}

TEST_CASE("Taylor coefficients report where a function is not smooth") {
    auto const reports = [](univariate f, double lo, double hi) {
        bool undefined = false;
        (void)coefficients<3>(f, interval_traits<interval>::bounds(lo, hi), undefined);
        return undefined;
    };
    REQUIRE(reports(univariate::log, 0.0, 1.0));
    REQUIRE(reports(univariate::log, -1.0, 1.0));
    REQUIRE(reports(univariate::log, -2.0, -1.0));
    REQUIRE_FALSE(reports(univariate::log, 1e-300, 1.0));
    REQUIRE(reports(univariate::tan, 1.5, 1.6));
    REQUIRE(reports(univariate::tan, -4.0, 4.0));
    REQUIRE_FALSE(reports(univariate::tan, -1.57, 1.57));
    for (auto const f :
         {univariate::exp, univariate::sin, univariate::cos, univariate::atan, univariate::tanh}) {
        REQUIRE_FALSE(reports(f, -1e300, 1e300));
    }
}

TEST_CASE("order 0 is the function alone") {
    bool undefined = false;
    auto const all = interval_traits<interval>::entire();
    REQUIRE(upper(coefficients<0>(univariate::sin, all, undefined)[0]) == 1.0);
    REQUIRE(upper(coefficients<0>(univariate::tanh, all, undefined)[0]) == 1.0);
    REQUIRE(upper(coefficients<0>(univariate::atan, all, undefined)[0]) < 1.5708);
    REQUIRE_FALSE(undefined);
}
