// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_FUNCTIONS_AT_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_FUNCTIONS_AT_HPP

/// @file
/// Bounds of elementary functions at one number, from which those of intervals are made: results of
/// glibc, moved outward, or sivid's own functions (detail/machine.hpp tells which).
///
/// For each function f: `f_at::down(x) <= f(x) <= f_at::up(x)`, and both at once by
/// `f_at::both(x)`, all in round-to-nearest. Known values and ranges are the caller's part.

#include <sivid/number/rounding/detail/excess.hpp>

#if SIVID_TRUSTS_LIBRARY
#include <sivid/number/rounding.hpp>

#include <cmath>
#else
#include <sivid/number/elementary/detail/own_functions.hpp>
#endif

namespace sivid::detail {

#if SIVID_TRUSTS_LIBRARY

struct bounds_at {
    double lower, upper;
};

/// The library's function, kept between the changes of the rounding mode around it, and moved
/// outward by `Excess` floats.
/// @given  round-to-nearest is set
template <auto const& Function, int Excess>
struct by_library {
    template <class... X>
    [[gnu::always_inline]] static double plain(X... x) noexcept {
        return pinned(Function(pinned(x)...));
    }
    template <class... X>
    [[gnu::always_inline]] static double down(X... x) noexcept {
        return step(plain(x...), -Excess);
    }
    template <class... X>
    [[gnu::always_inline]] static double up(X... x) noexcept {
        return step(plain(x...), Excess);
    }
    template <class... X>
    [[gnu::always_inline]] static bounds_at both(X... x) noexcept {
        double const y = plain(x...);
        return {step(y, -Excess), step(y, Excess)};
    }
};

inline constexpr auto library_exp = [](double x) { return std::exp(x); };
inline constexpr auto library_expm1 = [](double x) { return std::expm1(x); };
inline constexpr auto library_log = [](double x) { return std::log(x); };
inline constexpr auto library_log1p = [](double x) { return std::log1p(x); };
inline constexpr auto library_sin = [](double x) { return std::sin(x); };
inline constexpr auto library_cos = [](double x) { return std::cos(x); };
inline constexpr auto library_tan = [](double x) { return std::tan(x); };
inline constexpr auto library_asin = [](double x) { return std::asin(x); };
inline constexpr auto library_acos = [](double x) { return std::acos(x); };
inline constexpr auto library_atan = [](double x) { return std::atan(x); };
inline constexpr auto library_sinh = [](double x) { return std::sinh(x); };
inline constexpr auto library_cosh = [](double x) { return std::cosh(x); };
inline constexpr auto library_tanh = [](double x) { return std::tanh(x); };
inline constexpr auto library_asinh = [](double x) { return std::asinh(x); };
inline constexpr auto library_acosh = [](double x) { return std::acosh(x); };
inline constexpr auto library_atanh = [](double x) { return std::atanh(x); };
inline constexpr auto library_atan2 = [](double y, double x) { return std::atan2(y, x); };
inline constexpr auto library_pow = [](double x, double y) { return std::pow(x, y); };

using exp_at = by_library<library_exp, excess::exp>;
using expm1_at = by_library<library_expm1, excess::expm1>;
using log_at = by_library<library_log, excess::log>;
using log1p_at = by_library<library_log1p, excess::log1p>;
using sin_at = by_library<library_sin, excess::sin>;
using cos_at = by_library<library_cos, excess::cos>;
using tan_at = by_library<library_tan, excess::tan>;
using asin_at = by_library<library_asin, excess::asin>;
using acos_at = by_library<library_acos, excess::acos>;
using atan_at = by_library<library_atan, excess::atan>;
using sinh_at = by_library<library_sinh, excess::sinh>;
using cosh_at = by_library<library_cosh, excess::cosh>;
using tanh_at = by_library<library_tanh, excess::tanh>;
using asinh_at = by_library<library_asinh, excess::asinh>;
using acosh_at = by_library<library_acosh, excess::acosh>;
using atanh_at = by_library<library_atanh, excess::atanh>;
/// Of (x, y) finite and not zero, y > 0.
using atan2_at = by_library<library_atan2, excess::atan2>;
/// Of x > 0 other than 1, both finite.
using pow_at = by_library<library_pow, excess::pow>;

#else

using own::bounds_at;
using exp_at = own::exp;
using expm1_at = own::expm1;
using log_at = own::log;
using log1p_at = own::log1p;
using sin_at = own::sin;
using cos_at = own::cos;
using tan_at = own::tan;
using asin_at = own::asin;
using acos_at = own::acos;
using atan_at = own::atan;
using sinh_at = own::sinh;
using cosh_at = own::cosh;
using tanh_at = own::tanh;
using asinh_at = own::asinh;
using acosh_at = own::acosh;
using atanh_at = own::atanh;
using atan2_at = own::atan2;
using pow_at = own::pow;

#endif

} // namespace sivid::detail

#endif
