// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_ARITHMETIC_HPP
#define SIVID_MODEL_GRAPH_ARITHMETIC_HPP

#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sivid {

/// A constant of a model: a proven enclosure, and the double nearest to it for simulation.
struct literal {
    interval enclosure;
    double nearest = 0;
};

/// Where a value is known to be positive, negative, or neither; one flag per lane.
template <class Mask>
struct decided_sign {
    Mask positive{}, negative{}, neither{};
};

/// Sums of products, one operation after the other.
template <class A>
class plain_accumulator {
    using value_type = typename A::value_type;

public:
    plain_accumulator() = default;
    /// Where the result will go does not matter here.
    explicit plain_accumulator(value_type& /*place*/) {}
    /// Adds a times a small integer.
    void add(value_type const& a, double factor = 1) {
        sum_ = factor == -1 ? A::sub(sum_, a) : A::add(sum_, times(a, factor));
    }
    void add_product(value_type const& a, value_type const& b, double factor = 1) {
        add(A::mul(a, b), factor);
    }
    void add_square(value_type const& a, double factor = 1) { add(A::sqr(a), factor); }
    [[nodiscard]] value_type const& result() const { return sum_; }
    void result_into(value_type& a) const { a = sum_; }

private:
    static value_type times(value_type const& a, double factor) {
        return factor == 1 ? a : A::mul(A::point(factor), a);
    }
    value_type sum_ = A::point(0.0);
};

namespace model_detail {
/// \f$ a^n \f$ by squaring: at most 2 log2 |n| products, and a division for n < 0.
template <class A>
typename A::value_type power_by_products(typename A::value_type a, int n,
                                         typename A::mask& undefined) {
    auto k = n < 0 ? 0u - static_cast<unsigned>(n) : static_cast<unsigned>(n);
    if (k == 0) return A::point(1.0);
    for (; k % 2 == 0; k /= 2) a = A::sqr(a);
    auto result = a;
    while (k /= 2) {
        a = A::sqr(a);
        if (k % 2 == 1) result = A::mul(result, a);
    }
    return n < 0 ? A::div(A::point(1.0), result, undefined) : result;
}
} // namespace model_detail

/// Plain floating point behind the names of `interval_traits`: simulation and fitting run the same
/// graph as the proofs. Nothing computed with it is a proof.
struct approximate_arithmetic {
    using value_type = double;
    using mask = bool;
    static constexpr std::size_t lanes = 1;
    static constexpr bool keeps_reciprocals = false;
    static constexpr bool keeps_rows = false;
    using accumulator = plain_accumulator<approximate_arithmetic>;

    static double point(double x) { return x; }
    static double enclose(literal const& l) { return l.nearest; }
    static double enclose(interval const& x) { return mid(x); }
    static decided_sign<bool> sign_of(double a) { return {a > 0, a < 0, !(a > 0) && !(a < 0)}; }
    static double select(bool m, double a, double b) { return m ? a : b; }
    static double neg(double a) { return -a; }
    static double add(double a, double b) { return a + b; }
    static double sub(double a, double b) { return a - b; }
    static double mul(double a, double b) { return a * b; }
    static double div(double a, double b, bool&) { return a / b; }
    static double over(double a, std::size_t k) { return a / static_cast<double>(k); }
    static double sqr(double a) { return a * a; }
    static double pown(double a, int n, bool& undefined) {
        return model_detail::power_by_products<approximate_arithmetic>(a, n, undefined);
    }
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
    using accumulator = plain_accumulator<proven_arithmetic>;
    /// Whether division by a series' first coefficient is done by its stored reciprocal.
    static constexpr bool keeps_reciprocals = false;
    static constexpr bool keeps_rows = false;

    static I enclose(interval const& x) { return interval_traits<I>::bounds(x.lower(), x.upper()); }
    static I enclose(literal const& l) { return enclose(l.enclosure); }
    /// a divided by a natural number.
    static I over(I const& a, std::size_t k) {
        typename interval_traits<I>::mask never{};
        return interval_traits<I>::div(a, interval_traits<I>::point(static_cast<double>(k)), never);
    }
    static decided_sign<typename interval_traits<I>::mask> sign_of(I const& a) {
        using traits = interval_traits<I>;
        using mask = typename traits::mask;
        decided_sign<mask> s;
        for (std::size_t l = 0; l < traits::lanes; ++l) {
            auto const bit = static_cast<mask>(mask{1} << l);
            auto& where = traits::lower(a, l) > 0   ? s.positive
                          : traits::upper(a, l) < 0 ? s.negative
                                                    : s.neither;
            where = static_cast<mask>(where | bit);
        }
        return s;
    }
    static I select(typename interval_traits<I>::mask m, I const& a, I const& b) {
        if constexpr (interval_traits<I>::lanes == 1) {
            return m ? a : b;
        } else {
            I result = b;
            for (std::size_t l = 0; l < interval_traits<I>::lanes; ++l) {
                if (((m >> l) & 1U) != 0) result.set(l, a[l]);
            }
            return result;
        }
    }

    /// The sign as a set: [-1, 1] as soon as the argument touches 0. This is Filippov's value of a
    /// discontinuous right-hand side and Clarke's derivative of the absolute value.
    static I sign(I const& a) {
        using traits = interval_traits<I>;
        constexpr double tiny = std::numeric_limits<double>::denorm_min();
        return traits::sign(traits::add(a, traits::bounds(-tiny, tiny)));
    }
    static I tanh_slope(I const& a) { return number_detail::tanh_slope(a); }
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

/// 1 - tanh^2 of a, where the arithmetic knows it by itself: the square would count twice what tanh
/// has lost over a wide range, and far from 0 the difference would be what tanh was rounded by.
/// @returns  false where it does not
template <class A, class T>
bool find_tanh_slope(T const& a, T& result) {
    if constexpr (requires { A::tanh_slope(a); }) {
        result = A::tanh_slope(a);
        return true;
    }
    return false;
}
} // namespace model_detail

/// The arithmetic of a scalar type: proven for interval types, approximate for `double`.
template <class T>
using arithmetic_of = typename model_detail::arithmetic_for<T>::type;

} // namespace sivid

#endif
