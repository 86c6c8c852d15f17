// SPDX-License-Identifier: MIT
// Taylor models whose sizes are values against exact numbers: polynomials of rationals, and point
// values of 100 digits.
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

/// A model of one size, for tests that are written for it. Goes wherever a model goes.
template <std::size_t N, std::size_t D>
struct sized_model : sivid::taylor_model<double> {
    using base = sivid::taylor_model<double>;
    using basis = sivid::monomials<N, D>;

    static sivid::model_shape<double> const& size() { return sivid::model_shape<double>::of(N, D); }
    sized_model() : base(size()) {}
    sized_model(base const& a) : base(sivid::in_shape(a, size())) {} // NOLINT: a number is one, too
    template <class X>
    static sized_model constant(X const& x) {
        return base::constant(x);
    }
    static sized_model variable(std::size_t v, double centre, double slope) {
        return base::variable(size(), v, centre, slope);
    }
};
template <std::size_t N, std::size_t D>
constexpr auto const& monomials_of(sized_model<N, D> const&) {
    return sivid::monomials<N, D>::data;
}

/// A polynomial with exact coefficients, by exponents without zeros at their end.
using any_polynomial = std::map<std::vector<std::uint8_t>, rational>;

inline any_polynomial exact(sivid::taylor_model<double> const& a) {
    any_polynomial p;
    for (std::size_t i = 0; i < a.terms(); ++i) {
        auto const* const from = a.space().exponents(i);
        std::vector<std::uint8_t> e(from, from + a.space().variables());
        while (!e.empty() && e.back() == 0) e.pop_back();
        if (a.c(i) != 0) p[e] = rational(a.c(i));
    }
    return p;
}
inline any_polynomial sum(any_polynomial a, any_polynomial const& b, rational const& factor = 1) {
    for (auto const& [e, c] : b) a[e] += factor * c;
    return a;
}
inline any_polynomial product(any_polynomial const& a, any_polynomial const& b) {
    any_polynomial result;
    for (auto const& [e, c] : a) {
        for (auto const& [f, d] : b) {
            auto g = e.size() < f.size() ? f : e;
            for (std::size_t v = 0; v < g.size(); ++v) {
                g[v] = static_cast<std::uint8_t>((v < e.size() ? e[v] : 0) +
                                                 (v < f.size() ? f[v] : 0));
            }
            result[g] += c * d;
        }
    }
    return result;
}
/// \f$ \sum_\alpha |c_\alpha| \f$
inline rational size(any_polynomial const& a) {
    rational s = 0;
    for (auto const& term : a) s += multiprecision::abs(term.second);
    return s;
}
/// Whether the radius covers the difference of all coefficients: of what was rounded and of what
/// was cut off.
inline bool covers(sivid::taylor_model<double> const& a, any_polynomial const& p) {
    return size(sum(exact(a), p, rational(-1))) <= rational(a.r());
}

/// Value of the polynomial of a model.
template <class T>
T value(sivid::taylor_model<double> const& a, std::vector<double> const& q) {
    T total = 0;
    for (std::size_t i = 0; i < a.terms(); ++i) {
        if (a.c(i) == 0) continue;
        T term = a.c(i);
        for (std::size_t v = 0; v < a.space().variables(); ++v) {
            for (std::size_t k = 0; k < a.space().exponents(i)[v]; ++k) term *= T(q[v]);
        }
        total += term;
    }
    return total;
}
/// x within the model at q; `slack` (relative) is for numbers x that are not exact.
template <class T>
bool holds(sivid::taylor_model<double> const& a, std::vector<double> const& q, T const& x,
           double slack = 0) {
    if (!std::isfinite(a.r())) return true;
    T const room = T(a.r()) + T(slack) * (1 + multiprecision::abs(x));
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
inline sivid::taylor_model<double> random_model(draws& d, sivid::model_shape<double> const& shape,
                                                double size, double decay, double radius) {
    sivid::taylor_model<double> a(shape);
    for (std::size_t i = 0; i < a.terms(); ++i) {
        double const s = size * std::pow(decay, static_cast<double>(a.space().degree_of(i)));
        a.c(i) = d.below(5) == 0 ? 0 : d.uniform(-s, s);
    }
    a.r() = d.below(3) == 0 ? 0 : d.uniform(0, radius);
    a.finish();
    return a;
}
template <std::size_t N, std::size_t D>
sized_model<N, D> random_model(draws& d, double size, double decay, double radius) {
    return random_model(d, sized_model<N, D>::size(), size, decay, radius);
}
/// A function of the model at q: the polynomial plus a part of the radius that is exact.
template <class T>
T member(draws& d, sivid::taylor_model<double> const& a, std::vector<double> const& q) {
    static constexpr double parts[] = {-1, 1, -1, 1, 0.5, 0};
    return value<T>(a, q) + T(parts[d.below(6)]) * T(a.r());
}

/// A convolution of orders 0 to k with all members at the ends of their radii, with the same signs:
/// nothing may be missing from the radius, and no more than roundings added.
/// @param convolve  (a, b, k) -> models, each the sum of a[j] b[k - j]
template <class Convolve>
void check_radii_of_orders(sivid::model_shape<double> const& shape, std::size_t k,
                           Convolve const& convolve) {
    using model = sivid::taylor_model<double>;
    std::vector<model> a, b;
    rational most = 0;
    for (std::size_t j = 0; j <= k; ++j) {
        a.push_back(sivid::in_shape(model::constant(1.0 + static_cast<double>(j)), shape));
        b.push_back(sivid::in_shape(model::constant(2.0), shape));
        a.back().r() = 0.5;
        b.back().r() = 0.25;
        most += rational(1.5 + static_cast<double>(j)) * rational(2.25);
    }
    for (model const& result : convolve(a, b, k)) {
        REQUIRE(rational(result.c(0)) + rational(result.r()) >= most);
        REQUIRE(rational(result.c(0)) + rational(result.r()) <= most * rational(1 + 1e-12));
    }
}

} // namespace support

#endif
