// SPDX-License-Identifier: MIT
// References for sensitivities: the variational equation beside the states, its Jacobian by dual
// numbers in extended precision through the systems' own formulas, so that neither finite
// differences nor the library's derivatives have a part in it.
#ifndef SIVID_TESTS_SUPPORT_VARIATIONAL_REFERENCE_HPP
#define SIVID_TESTS_SUPPORT_VARIATIONAL_REFERENCE_HPP

#include "support/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

/// A number and its derivatives; without derivatives a constant.
class dual {
public:
    extended value = 0;
    std::vector<extended> d;

    dual(extended v = 0) : value(v) {} // also from double and int
    dual(extended v, std::size_t variables, std::size_t which) : value(v), d(variables) {
        d[which] = 1;
    }

    friend dual operator+(dual const& a, dual const& b) {
        return join(a.value + b.value, a, 1, b, 1);
    }
    friend dual operator-(dual const& a, dual const& b) {
        return join(a.value - b.value, a, 1, b, -1);
    }
    friend dual operator*(dual const& a, dual const& b) {
        return join(a.value * b.value, a, b.value, b, a.value);
    }
    friend dual operator/(dual const& a, dual const& b) {
        return join(a.value / b.value, a, 1 / b.value, b, -a.value / (b.value * b.value));
    }
    friend dual operator-(dual const& a) { return chain(-a.value, a, -1); }
    friend dual sqr(dual const& a) { return a * a; }
    friend dual pown(dual const& a, int n) {
        return chain(std::pow(a.value, n), a, n * std::pow(a.value, n - 1));
    }
    friend dual sqrt(dual const& a) {
        auto const y = std::sqrt(a.value);
        return chain(y, a, 1 / (2 * y));
    }
    friend dual exp(dual const& a) { return chain(std::exp(a.value), a, std::exp(a.value)); }
    friend dual log(dual const& a) { return chain(std::log(a.value), a, 1 / a.value); }
    friend dual sin(dual const& a) { return chain(std::sin(a.value), a, std::cos(a.value)); }
    friend dual cos(dual const& a) { return chain(std::cos(a.value), a, -std::sin(a.value)); }
    friend dual tan(dual const& a) {
        auto const y = std::tan(a.value);
        return chain(y, a, 1 + y * y);
    }
    friend dual atan(dual const& a) {
        return chain(std::atan(a.value), a, 1 / (1 + a.value * a.value));
    }
    friend dual tanh(dual const& a) {
        auto const y = std::tanh(a.value);
        return chain(y, a, 1 - y * y);
    }
    friend dual abs(dual const& a) { return a.value < 0 ? -a : a; }
    friend dual min(dual const& a, dual const& b) { return b.value < a.value ? b : a; }
    friend dual max(dual const& a, dual const& b) { return a.value < b.value ? b : a; }

private:
    static dual chain(extended v, dual const& a, extended slope) {
        dual r(v);
        for (auto const x : a.d) r.d.push_back(slope * x);
        return r;
    }
    static dual join(extended v, dual const& a, extended by_a, dual const& b, extended by_b) {
        dual r(v);
        r.d.resize(std::max(a.d.size(), b.d.size()));
        for (std::size_t k = 0; k < a.d.size(); ++k) r.d[k] += by_a * a.d[k];
        for (std::size_t k = 0; k < b.d.size(); ++k) r.d[k] += by_b * b.d[k];
        return r;
    }
};

struct reference_sensitivity {
    extended_state x;
    std::vector<extended_state> s; ///< [i][c], c an initial state or n + a parameter
};

using dual_rate = rate_on<dual>;

/// States and \f$ \partial x / \partial (x_0, p) \f$ at the `times`.
/// @param kinks  the derivatives of the right-hand side may jump
std::vector<reference_sensitivity>
reference_sensitivities(dual_rate const& rate, extended_state const& x0, extended_state const& p,
                        double from, std::vector<double> const& times,
                        std::vector<sivid::sampled_signal> const& inputs = {},
                        extended tolerance = 1e-16L, bool kinks = false);

} // namespace support

#endif
