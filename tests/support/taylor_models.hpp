// SPDX-License-Identifier: MIT
// Taylor models against exact numbers: polynomials of rationals, and point values of 50 digits.
#ifndef SIVID_TESTS_SUPPORT_TAYLOR_MODELS_HPP
#define SIVID_TESTS_SUPPORT_TAYLOR_MODELS_HPP

#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <sivid/number/taylor_model.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace support {

using rational =
    multiprecision::number<multiprecision::cpp_rational_backend, multiprecision::et_off>;

/// The tables of a model's monomials.
template <std::size_t N, std::size_t D>
constexpr auto const& monomials_of(sivid::taylor_model<N, D> const&) {
    return sivid::monomials<N, D>::data;
}

/// A polynomial with exact coefficients.
template <std::size_t N>
using exact_polynomial = std::map<std::array<std::uint8_t, N>, rational>;

template <std::size_t N, std::size_t D>
exact_polynomial<N> exact(sivid::taylor_model<N, D> const& a) {
    exact_polynomial<N> p;
    for (std::size_t i = 0; i < a.terms; ++i) {
        if (a.c[i] != 0) p[monomials_of(a).exponents[i]] = rational(a.c[i]);
    }
    return p;
}
template <std::size_t N>
exact_polynomial<N> sum(exact_polynomial<N> a, exact_polynomial<N> const& b,
                        rational const& factor = 1) {
    for (auto const& [e, c] : b) a[e] += factor * c;
    return a;
}
template <std::size_t N>
exact_polynomial<N> product(exact_polynomial<N> const& a, exact_polynomial<N> const& b) {
    exact_polynomial<N> result;
    for (auto const& [e, c] : a) {
        for (auto const& [f, d] : b) {
            auto g = e;
            for (std::size_t v = 0; v < N; ++v) g[v] = static_cast<std::uint8_t>(e[v] + f[v]);
            result[g] += c * d;
        }
    }
    return result;
}
/// \f$ \sum_\alpha |c_\alpha| \f$
template <std::size_t N>
rational size(exact_polynomial<N> const& a) {
    rational s = 0;
    for (auto const& term : a) s += multiprecision::abs(term.second);
    return s;
}
/// Whether the radius covers the difference of all coefficients: of what was rounded and of what
/// was cut off.
template <std::size_t N, std::size_t D>
bool covers(sivid::taylor_model<N, D> const& a, exact_polynomial<N> const& p) {
    return size(sum(exact(a), p, rational(-1))) <= rational(a.r);
}

/// Value of the polynomial of a model.
template <class T, std::size_t N, std::size_t D>
T value(sivid::taylor_model<N, D> const& a, std::vector<double> const& q) {
    T total = 0;
    for (std::size_t i = 0; i < a.terms; ++i) {
        if (a.c[i] == 0) continue;
        T term = a.c[i];
        for (std::size_t v = 0; v < N; ++v) {
            for (std::size_t k = 0; k < monomials_of(a).exponents[i][v]; ++k) term *= T(q[v]);
        }
        total += term;
    }
    return total;
}
/// x within the model at q; `slack` (relative) is for numbers x that are not exact.
template <class T, std::size_t N, std::size_t D>
bool holds(sivid::taylor_model<N, D> const& a, std::vector<double> const& q, T const& x,
           double slack = 0) {
    if (!std::isfinite(a.r)) return true;
    T const room = T(a.r) + T(slack) * (1 + multiprecision::abs(x));
    return multiprecision::abs(x - value<T>(a, q)) <= room;
}

/// A point of \f$ [-1,1]^N \f$ with short coordinates, often a corner.
inline std::vector<double> short_point(draws& d, std::size_t n) {
    std::vector<double> q(n);
    bool const corner = d.coin();
    for (auto& x : q) {
        x = corner ? (d.coin() ? 1.0 : -1.0) : (static_cast<double>(d.below(17)) - 8) / 8;
    }
    return q;
}

/// Coefficients up to `size`, falling by `decay` a degree.
template <std::size_t N, std::size_t D>
sivid::taylor_model<N, D> random_model(draws& d, double size, double decay, double radius) {
    sivid::taylor_model<N, D> a;
    for (std::size_t i = 0; i < a.terms; ++i) {
        double const s = size * std::pow(decay, static_cast<double>(monomials_of(a).degree[i]));
        a.c[i] = d.below(5) == 0 ? 0 : d.uniform(-s, s);
    }
    a.r = d.below(3) == 0 ? 0 : d.uniform(0, radius);
    a.finish();
    return a;
}
/// A function of the model at q: the polynomial plus a part of the radius that is exact.
template <class T, std::size_t N, std::size_t D>
T member(draws& d, sivid::taylor_model<N, D> const& a, std::vector<double> const& q) {
    static constexpr double parts[] = {-1, 1, -1, 1, 0.5, 0};
    return value<T>(a, q) + T(parts[d.below(6)]) * T(a.r);
}

/// A convolution of orders 0 to k with all members at the ends of their radii, with the same signs:
/// nothing may be missing from the radius, and no more than roundings added.
/// @param convolve  (a, b, k) -> models, each the sum of a[j] b[k - j]
template <std::size_t N, std::size_t D, class Convolve>
void check_radii_of_orders(std::size_t k, Convolve const& convolve) {
    using model = sivid::taylor_model<N, D>;
    std::vector<model> a, b;
    rational most = 0;
    for (std::size_t j = 0; j <= k; ++j) {
        a.push_back(model::constant(1.0 + static_cast<double>(j)));
        b.push_back(model::constant(2.0));
        a.back().r = 0.5;
        b.back().r = 0.25;
        most += rational(1.5 + static_cast<double>(j)) * rational(2.25);
    }
    for (model const& result : convolve(a, b, k)) {
        REQUIRE(rational(result.c[0]) + rational(result.r) >= most);
        REQUIRE(rational(result.c[0]) + rational(result.r) <= most * rational(1 + 1e-12));
    }
}

} // namespace support

#endif
