// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_ARITHMETIC_HPP
#define SIVID_MODEL_ARITHMETIC_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sivid {

/// Plain floating point behind the names of `interval_traits`: simulation and fitting run the same
/// graph as the proofs. Nothing computed with it is a proof.
struct approximate_arithmetic {
    using value_type = double;
    using mask = bool;
    static constexpr std::size_t lanes = 1;

    static double point(double x) { return x; }
    static double neg(double a) { return -a; }
    static double add(double a, double b) { return a + b; }
    static double sub(double a, double b) { return a - b; }
    static double mul(double a, double b) { return a * b; }
    static double div(double a, double b, bool&) { return a / b; }
    static double sqr(double a) { return a * a; }
    static double pown(double a, int n, bool&) { return std::pow(a, n); }
    static double sqrt(double a, bool&) { return std::sqrt(a); }
    static double exp(double a) { return std::exp(a); }
    static double log(double a, bool&) { return std::log(a); }
    static double sin(double a) { return std::sin(a); }
    static double cos(double a) { return std::cos(a); }
    static double tan(double a, bool&) { return std::tan(a); }
    static double atan(double a) { return std::atan(a); }
    static double tanh(double a) { return std::tanh(a); }
    static double abs(double a) { return std::abs(a); }
    static double sign(double a) { return a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0; }
    static double min(double a, double b) { return std::min(a, b); }
    static double max(double a, double b) { return std::max(a, b); }
};

/// `interval_traits<I>` with the name of its value type, as the evaluators expect it.
template <class I>
struct proven_arithmetic : interval_traits<I> {
    using value_type = I;

    /// The sign as a set: [-1, 1] as soon as the argument touches 0. This is Filippov's value of a
    /// discontinuous right-hand side and Clarke's derivative of the absolute value.
    static I sign(I const& a) {
        using traits = interval_traits<I>;
        constexpr double tiny = std::numeric_limits<double>::denorm_min();
        return traits::sign(traits::add(a, traits::bounds(-tiny, tiny)));
    }
};

namespace model_detail {
template <class T>
struct arithmetic_for {
    using type = proven_arithmetic<T>;
};
template <>
struct arithmetic_for<double> {
    using type = approximate_arithmetic;
};
} // namespace model_detail

/// The arithmetic of a scalar type: proven for interval types, approximate for `double`.
template <class T>
using arithmetic_of = typename model_detail::arithmetic_for<T>::type;

} // namespace sivid

#endif
