// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CURVE_DETAIL_PRINCIPAL_SHAPES_HPP
#define SIVID_PAVING_CURVE_DETAIL_PRINCIPAL_SHAPES_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

/// @file
/// Doubles without proof: which shapes to take. What is proved of them is proved of whatever they
/// are.

namespace sivid::paving_detail {

/// Chebyshev's nodes in [-1, 1].
inline std::vector<double> chebyshev_nodes(std::size_t n) {
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) {
        x.push_back(
            std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n)));
    }
    return x;
}

/// Coefficients of Chebyshev's polynomials of what has these values at their nodes.
inline std::vector<double> chebyshev_coefficients(std::vector<double> const& values) {
    auto const n = values.size();
    std::vector<double> c(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            c[k] += values[i] * std::cos(std::numbers::pi * static_cast<double>(k) *
                                         (static_cast<double>(i) + 0.5) / static_cast<double>(n));
        }
        c[k] *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
    }
    return c;
}

/// The same by powers, up to a degree; what is nothing beside the rest is left out.
inline std::vector<double> by_powers(std::vector<double> const& chebyshev, std::size_t degree) {
    std::vector<double> result(degree + 1, 0.0), before{1.0}, now{0.0, 1.0};
    double most = 0;
    for (double const c : chebyshev) most = std::max(most, std::abs(c));
    for (std::size_t k = 0; k < std::min(chebyshev.size(), degree + 1); ++k) {
        double const c = std::abs(chebyshev[k]) > 1e-13 * most ? chebyshev[k] : 0;
        auto const& t = k == 0 ? before : now;
        for (std::size_t i = 0; i < t.size(); ++i) result[i] += c * t[i];
        if (k == 0) continue;
        std::vector<double> next(now.size() + 1, 0.0);
        for (std::size_t i = 0; i < now.size(); ++i) next[i + 1] += 2 * now[i];
        for (std::size_t i = 0; i < before.size(); ++i) next[i] -= before[i];
        before = std::exchange(now, std::move(next));
    }
    return result;
}

/// Sum of c_k x^k for any numbers, in half of the steps where only odd or only even powers stand.
/// @param none  (k) -> whether c_k is 0
template <class T, class None>
[[nodiscard]] T horner(std::vector<T> const& c, None const& none, T const& x) {
    auto const every = [&](std::size_t first) {
        for (std::size_t k = first; k < c.size(); k += 2) {
            if (!none(k)) return false;
        }
        return true;
    };
    bool const odd = every(0), even = !odd && every(1);
    std::size_t const step = odd || even ? 2 : 1, low = odd ? 1 : 0;
    if (c.size() <= low) return T(c.at(0));
    auto const z = step == 2 ? x * x : x;
    std::size_t k = low + (c.size() - 1 - low) / step * step;
    T sum = c[k];
    while (k > low) {
        k -= step;
        sum = sum * z + c[k];
    }
    return odd ? sum * x : sum;
}

} // namespace sivid::paving_detail

#endif
