// SPDX-License-Identifier: MIT
// The oracle for Taylor coefficients: truncated power series of 100-digit numbers. Functions go
// through their derivatives at the constant term and Horner's rule, not through the recurrences
// that the library uses.
#ifndef SIVID_TESTS_SUPPORT_POWER_SERIES_HPP
#define SIVID_TESTS_SUPPORT_POWER_SERIES_HPP

#include "support/real_functions.hpp"

#include <sivid/number/interval.hpp>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

namespace multiprecision = boost::multiprecision;
using mp = multiprecision::number<multiprecision::cpp_bin_float<100>, multiprecision::et_off>;

/// x in [lo - slack, hi + slack], compared exactly; slack is relative to 1 + |x|.
inline bool encloses(sivid::interval const& e, mp const& x, double slack = 0) {
    mp const room = slack * (1 + multiprecision::abs(x));
    return mp(e.lower()) <= x + room && x - room <= mp(e.upper());
}

template <>
inline constexpr bool is_real<mp> = true;

/// \f$ \sum_{k \le K} c_k \tau^k \f$
template <std::size_t K>
struct power_series {
    std::array<mp, K + 1> c{};

    power_series() = default;
    power_series(mp const& a) { c[0] = a; }
    power_series(double a) { c[0] = a; }
    power_series(int a) { c[0] = a; }

    friend power_series operator-(power_series a) {
        for (auto& v : a.c) v = -v;
        return a;
    }
    friend power_series operator+(power_series a, power_series const& b) {
        for (std::size_t k = 0; k <= K; ++k) a.c[k] += b.c[k];
        return a;
    }
    friend power_series operator-(power_series a, power_series const& b) {
        for (std::size_t k = 0; k <= K; ++k) a.c[k] -= b.c[k];
        return a;
    }
    friend power_series operator*(power_series const& a, power_series const& b) {
        power_series r;
        for (std::size_t i = 0; i <= K; ++i) {
            for (std::size_t j = 0; i + j <= K; ++j) r.c[i + j] += a.c[i] * b.c[j];
        }
        return r;
    }
    friend power_series operator/(power_series const& a, power_series const& b) {
        std::array<mp, K + 1> d; // derivatives of 1/s over factorials
        d[0] = 1 / b.c[0];
        for (std::size_t k = 1; k <= K; ++k) d[k] = -d[k - 1] / b.c[0];
        return a * b.composed(d);
    }

    /// \f$ \sum_k d_k (a - a_0)^k \f$
    [[nodiscard]] power_series composed(std::array<mp, K + 1> const& d) const {
        power_series step = *this;
        step.c[0] = 0;
        power_series r = d[K];
        for (std::size_t k = K; k-- > 0;) r = r * step + power_series(d[k]);
        return r;
    }

    friend power_series sqr(power_series const& a) { return a * a; }
    friend power_series pown(power_series const& a, int n) {
        power_series r = 1;
        for (int i = 0; i < (n < 0 ? -n : n); ++i) r = r * a;
        return n < 0 ? power_series(1) / r : r;
    }
    friend power_series exp(power_series const& a) {
        std::array<mp, K + 1> d;
        d[0] = multiprecision::exp(a.c[0]);
        for (std::size_t k = 1; k <= K; ++k) d[k] = d[k - 1] / k;
        return a.composed(d);
    }
    friend power_series log(power_series const& a) {
        std::array<mp, K + 1> d;
        d[0] = multiprecision::log(a.c[0]);
        mp power = -1;
        for (std::size_t k = 1; k <= K; ++k) {
            power = -power / a.c[0];
            d[k] = power / k;
        }
        return a.composed(d);
    }
    friend power_series sqrt(power_series const& a) {
        std::array<mp, K + 1> d;
        d[0] = multiprecision::sqrt(a.c[0]);
        for (std::size_t k = 1; k <= K; ++k) {
            d[k] = d[k - 1] * (mp(0.5) - mp(k - 1)) / (k * a.c[0]);
        }
        return a.composed(d);
    }
    friend power_series sin(power_series const& a) { return wave(a, 0); }
    friend power_series cos(power_series const& a) { return wave(a, 1); }
    friend power_series tan(power_series const& a) { return sin(a) / cos(a); }
    friend power_series tanh(power_series const& a) {
        if (a.c[0] > 0) return -tanh(-a); // so that the exponential is below 1
        auto const e = exp(a + a);
        return (e - 1) / (e + 1);
    }
    friend power_series atan(power_series const& a) {
        // The k-th derivative over k! is (-1)^(k-1) sin(k theta) / (k r^k), theta = pi/2 - atan a.
        std::array<mp, K + 1> d;
        d[0] = multiprecision::atan(a.c[0]);
        mp const theta = boost::math::constants::half_pi<mp>() - d[0];
        mp const r = multiprecision::sqrt(mp(1 + a.c[0] * a.c[0]));
        mp scale = -1;
        for (std::size_t k = 1; k <= K; ++k) {
            scale = -scale / r;
            d[k] = scale * multiprecision::sin(mp(k * theta)) / k;
        }
        return a.composed(d);
    }
    friend power_series abs(power_series const& a) { return a.c[0] < 0 ? -a : a; }
    friend power_series sign(power_series const& a) { return real::sign(a.c[0]); }
    friend power_series min(power_series const& a, power_series const& b) {
        return b.c[0] < a.c[0] ? b : a;
    }
    friend power_series max(power_series const& a, power_series const& b) {
        return a.c[0] < b.c[0] ? b : a;
    }
    friend power_series saturate(power_series const& a, power_series const& lo,
                                 power_series const& hi) {
        return min(max(a, lo), hi);
    }

private:
    static power_series wave(power_series const& a, std::size_t quarter) {
        mp const s = multiprecision::sin(a.c[0]);
        mp const c = multiprecision::cos(a.c[0]);
        std::array<mp, 4> const cycle{s, c, -s, -c};
        std::array<mp, K + 1> d;
        mp factorial = 1;
        for (std::size_t k = 0; k <= K; ++k) {
            if (k > 0) factorial *= k;
            d[k] = cycle[(k + quarter) % 4] / factorial;
        }
        return a.composed(d);
    }
};

/// Taylor coefficients 0 .. K of the solution of x' = rate(t, x, p, u) through `x0` at `t0`, by
/// Picard iteration: each round fixes one more coefficient.
/// @param input  t as a series -> the inputs as series
template <std::size_t K, class Rate, class Input>
std::vector<power_series<K>> solution_series(Rate const& rate, mp const& t0,
                                             std::vector<mp> const& x0, std::vector<mp> const& p,
                                             Input const& input) {
    using ps = power_series<K>;
    ps t = t0;
    if constexpr (K > 0) t.c[1] = 1;
    std::vector<ps> const parameters(p.begin(), p.end());
    std::vector<ps> const start(x0.begin(), x0.end());
    auto x = start;
    std::vector<ps> const u = input(t);
    for (std::size_t round = 0; round < K; ++round) {
        std::vector<ps> const f = rate(t, x, parameters, u);
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t k = 0; k < K; ++k) x[i].c[k + 1] = f[i].c[k] / (k + 1);
        }
    }
    return x;
}
template <std::size_t K, class Rate>
std::vector<power_series<K>> solution_series(Rate const& rate, mp const& t0,
                                             std::vector<mp> const& x0, std::vector<mp> const& p) {
    return solution_series<K>(rate, t0, x0, p,
                              [](auto const&) { return std::vector<power_series<K>>{}; });
}

} // namespace support

#endif
