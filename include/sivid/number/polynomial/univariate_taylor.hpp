// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_UNIVARIATE_TAYLOR_HPP
#define SIVID_NUMBER_POLYNOMIAL_UNIVARIATE_TAYLOR_HPP

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval_traits.hpp>

#include <cstddef>

namespace sivid {

/// Functions of one variable whose Taylor coefficients are known here.
enum class univariate { exp, log, sin, cos, tan, atan, tanh, sech_squared, reciprocal, sqrt };

/// Encloses \f$ f^{(k)}(x)/k! \f$ for k = 0 .. order at every x in the interval.
/// @param y          gets the order + 1 enclosures
/// @param undefined  set where f is not defined (or not smooth) on all of x
/// @ref  recurrences as in Griewank and Walther 2008, table 13.2
inline void taylor_coefficients(univariate f, interval const& x, std::size_t order, interval* y,
                                bool& undefined) {
    using T = interval_traits<interval>;
    auto const number = [](std::size_t k) { return T::point(static_cast<double>(k)); };
    auto const over = [&](interval const& a, std::size_t k) {
        return T::div(a, number(k), undefined);
    };
    auto const square = [&](std::size_t k) { // coefficient k of y^2
        interval sum = T::point(0.0);
        for (std::size_t j = 0; j <= k; ++j) sum = T::add(sum, T::mul(y[j], y[k - j]));
        return k == 0 ? T::sqr(y[0]) : sum;
    };
    switch (f) {
    case univariate::exp:
        y[0] = T::exp(x);
        for (std::size_t k = 1; k <= order; ++k) y[k] = over(y[k - 1], k);
        break;
    case univariate::log: { // (-1)^(k+1) / (k x^k)
        y[0] = T::log(x, undefined);
        if (!(x.lower() > 0)) undefined = true;
        interval power = T::point(-1.0);
        for (std::size_t k = 1; k <= order; ++k) {
            power = T::neg(T::div(power, x, undefined));
            y[k] = over(power, k);
        }
        break;
    }
    case univariate::sin:
    case univariate::cos:
        y[0] = f == univariate::sin ? T::sin(x) : T::cos(x);
        if (order >= 1) y[1] = f == univariate::sin ? T::cos(x) : T::neg(T::sin(x));
        for (std::size_t k = 2; k <= order; ++k) y[k] = T::neg(over(y[k - 2], k * (k - 1)));
        break;
    case univariate::tan: // y' = 1 + y^2
        y[0] = T::tan(x, undefined);
        for (std::size_t k = 0; k < order; ++k) {
            y[k + 1] = over(k == 0 ? T::add(T::point(1.0), square(k)) : square(k), k + 1);
        }
        break;
    case univariate::tanh: // y' = 1 - y^2; all but the value have the slope as a factor
        y[0] = T::tanh(x);
        for (std::size_t k = 0; k < order; ++k) {
            y[k + 1] = over(k == 0 ? number_detail::tanh_slope(x) : T::neg(square(k)), k + 1);
        }
        break;
    case univariate::sech_squared: // 1 - tanh^2; each square needs the tangents before it alone
        taylor_coefficients(univariate::tanh, x, order, y, undefined);
        for (std::size_t k = order; k > 0; --k) y[k] = T::neg(square(k));
        y[0] = number_detail::tanh_slope(x);
        break;
    case univariate::atan: { // y' (1 + x^2) = 1, with (1 + (x+s)^2) = w0 + 2 x s + s^2
        y[0] = T::atan(x);
        auto const w0 = T::add(T::point(1.0), T::sqr(x));
        interval before = T::point(0.0), last = before; // y'_{k-2}, y'_{k-1}
        for (std::size_t k = 0; k < order; ++k) { // z = y', z_k w0 = [k=0] - 2 x z_{k-1} - z_{k-2}
            interval sum = T::point(k == 0 ? 1.0 : 0.0);
            if (k >= 1) sum = T::sub(sum, T::mul(T::mul(number(2), x), last));
            if (k >= 2) sum = T::sub(sum, before);
            before = last;
            last = T::div(sum, w0, undefined);
            y[k + 1] = over(last, k + 1);
        }
        break;
    }
    case univariate::reciprocal: // (-1)^k / x^(k+1)
        y[0] = T::div(T::point(1.0), x, undefined);
        for (std::size_t k = 1; k <= order; ++k) y[k] = T::neg(T::mul(y[k - 1], y[0]));
        break;
    case univariate::sqrt: // y_k = y_{k-1} (3/2 - k) / (k x)
        y[0] = T::sqrt(x, undefined);
        for (std::size_t k = 1; k <= order; ++k) {
            auto const factor = T::point(1.5 - static_cast<double>(k));
            y[k] = over(T::div(T::mul(y[k - 1], factor), x, undefined), k);
        }
        break;
    }
}

} // namespace sivid

#endif
