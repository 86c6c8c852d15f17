// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_MP_INTERVAL_HPP
#define SIVID_NUMBER_MP_INTERVAL_HPP

/// @file
/// A multiprecision interval: Boost.Multiprecision over MPFI. Its elementary functions rest on
/// MPFR's correct rounding instead of sivid's own kernels. Needs mpfi, mpfr and gmp at link time;
/// no other header includes this one.

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/traits_by_bounds.hpp>

#include <boost/multiprecision/mpfi.hpp>

#include <cstddef>

namespace sivid {

/// About `Digits10` decimal digits. Operators + - * / of Boost enclose too.
template <unsigned Digits10>
using basic_mp_interval =
    boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<Digits10>,
                                  boost::multiprecision::et_off>;
using mp_interval = basic_mp_interval<40>;

/// Bounds are read outward in double. Every function is the hull of correctly rounded values at the
/// ends (and of the extrema between), in the precision of the type.
template <unsigned Digits10>
struct interval_traits<basic_mp_interval<Digits10>>
    : traits_by_bounds<basic_mp_interval<Digits10>> {
    using I = basic_mp_interval<Digits10>;
    using mask = bool;

    // Making.
    static I point(double t) { return bounds(t, t); }
    static I bounds(double lo, double hi) {
        interval const x = detail::bounded(lo, hi);
        I r;
        mpfi_interv_d(raw(r), x.lower(), x.upper());
        if (sivid::is_empty(x)) make_empty(r);
        return r;
    }
    static I empty() {
        I r;
        make_empty(r);
        return r;
    }
    static I entire() { return bounds(-detail::infinity, detail::infinity); }

    // Reading; the middle and so on are those of the enclosure in double.
    static double lower(I const& a, std::size_t = 0) {
        return mpfr_get_d(&raw(a)->left, MPFR_RNDD);
    }
    static double upper(I const& a, std::size_t = 0) {
        return mpfr_get_d(&raw(a)->right, MPFR_RNDU);
    }
    /// The enclosure in double.
    static interval to_interval(I const& a) { return detail::bounded(lower(a), upper(a)); }
    static bool is_empty(I const& a) {
        return mpfr_lessequal_p(&raw(a)->left, &raw(a)->right) == 0;
    }
    static bool is_point(I const& a) { return mpfr_equal_p(&raw(a)->left, &raw(a)->right) != 0; }
    static bool contains(I const& a, double t) {
        return !is_empty(a) && !detail::is_infinite(t) && !detail::is_nan(t) &&
               mpfr_cmp_d(&raw(a)->left, t) <= 0 && mpfr_cmp_d(&raw(a)->right, t) >= 0;
    }

    // Sets.
    static bool subset(I const& a, I const& b) {
        return is_empty(a) || (mpfr_lessequal_p(&raw(b)->left, &raw(a)->left) != 0 &&
                               mpfr_lessequal_p(&raw(a)->right, &raw(b)->right) != 0);
    }
    static bool interior(I const& a, I const& b) {
        if (is_empty(a)) return true;
        bool const below =
            mpfr_less_p(&raw(b)->left, &raw(a)->left) != 0 || mpfr_inf_p(&raw(b)->left) != 0;
        bool const above =
            mpfr_less_p(&raw(a)->right, &raw(b)->right) != 0 || mpfr_inf_p(&raw(b)->right) != 0;
        return below && above && !is_empty(b);
    }
    static bool disjoint(I const& a, I const& b) {
        return is_empty(a) || is_empty(b) || mpfr_less_p(&raw(a)->right, &raw(b)->left) != 0 ||
               mpfr_less_p(&raw(b)->right, &raw(a)->left) != 0;
    }
    static I hull(I const& a, I const& b) {
        if (is_empty(a)) return b;
        if (is_empty(b)) return a;
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            mpfr_min(lo, &raw(a)->left, &raw(b)->left, MPFR_RNDD);
            mpfr_max(hi, &raw(a)->right, &raw(b)->right, MPFR_RNDU);
        });
    }
    static I intersect(I const& a, I const& b) {
        if (disjoint(a, b)) return empty();
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            mpfr_max(lo, &raw(a)->left, &raw(b)->left, MPFR_RNDD);
            mpfr_min(hi, &raw(a)->right, &raw(b)->right, MPFR_RNDU);
        });
    }

    // Arithmetic.
    static I neg(I const& a) { return decreasing(mpfr_neg, a); }
    static I add(I const& a, I const& b) { return increasing(mpfr_add, a, b); }
    static I sub(I const& a, I const& b) { return add(a, neg(b)); }
    static I mul(I const& a, I const& b) { return corners(mpfr_mul, a, b); }
    static I div(I const& a, I const& b, mask& undefined) {
        if (is_empty(a) || is_empty(b)) return empty();
        if (mpfr_sgn(&raw(b)->left) > 0 || mpfr_sgn(&raw(b)->right) < 0)
            return corners(mpfr_div, a, b);
        undefined = true;
        // The quotients over the parts of b on both sides of zero.
        I const half = point(0.0);
        I const positive = over_zero_to(a, b), negative = neg(over_zero_to(a, neg(b)));
        return mpfr_zero_p(&raw(a)->left) != 0 && mpfr_zero_p(&raw(a)->right) != 0 && !is_zero(b)
                   ? half
                   : hull(positive, negative);
    }
    static I sqr(I const& a) { return increasing(mpfr_sqr, abs(a)); }
    static I abs(I const& a) {
        if (is_empty(a) || mpfr_sgn(&raw(a)->left) >= 0) return a;
        if (mpfr_sgn(&raw(a)->right) <= 0) return neg(a);
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            mpfr_set_zero(lo, 1);
            mpfr_neg(hi, &raw(a)->left, MPFR_RNDU);
            mpfr_max(hi, hi, &raw(a)->right, MPFR_RNDU);
        });
    }
    static I min(I const& a, I const& b) { return increasing(mpfr_min, a, b); }
    static I max(I const& a, I const& b) { return neg(min(neg(a), neg(b))); }
    static I hypot(I const& a, I const& b) { return increasing(mpfr_hypot, abs(a), abs(b)); }

    // Elementary functions.
    static I sqrt(I const& a, mask& cut) {
        return increasing(mpfr_sqrt, restricted(a, 0.0, detail::infinity, cut));
    }
    static I pown(I const& a, int n, mask& cut) {
        if (is_empty(a)) return a;
        if (n == 0) return point(1.0);
        if (n < 0) return div(point(1.0), power(a, -static_cast<long>(n)), cut);
        return power(a, n);
    }
    static I pow(I const& a, I const& b, mask& cut) {
        if (is_empty(a) || is_empty(b)) return empty();
        bool const only_positive = mpfr_sgn(&raw(b)->left) <= 0;
        if (mpfr_sgn(&raw(a)->left) < 0 || (mpfr_zero_p(&raw(a)->left) != 0 && only_positive))
            cut = true;
        I const x = intersect(a, bounds(0.0, detail::infinity));
        if (is_empty(x)) return x;
        if (is_zero(x)) return mpfr_sgn(&raw(b)->right) > 0 ? point(0.0) : empty();
        return corners(mpfr_pow, magnitude(x), b);
    }
    static I exp(I const& a) { return increasing(mpfr_exp, a); }
    static I expm1(I const& a) { return increasing(mpfr_expm1, a); }
    static I log(I const& a, mask& cut) {
        return increasing(mpfr_log, magnitude(restricted(a, 0.0, detail::infinity, cut, true)));
    }
    static I log1p(I const& a, mask& cut) {
        return increasing(mpfr_log1p, restricted(a, -1.0, detail::infinity, cut, true));
    }
    static I sin(I const& a) { return library(mpfi_sin, a); }
    static I cos(I const& a) { return library(mpfi_cos, a); }
    static I tan(I const& a, mask& cut) {
        I const y = library(mpfi_tan, a);
        if (!is_empty(a) &&
            (is_empty(y) || mpfr_inf_p(&raw(y)->left) != 0 || mpfr_inf_p(&raw(y)->right) != 0)) {
            cut = true;
            return entire();
        }
        return y;
    }
    static I asin(I const& a, mask& cut) {
        return increasing(mpfr_asin, restricted(a, -1.0, 1.0, cut));
    }
    static I acos(I const& a, mask& cut) {
        return decreasing(mpfr_acos, restricted(a, -1.0, 1.0, cut));
    }
    static I atan(I const& a) { return increasing(mpfr_atan, a); }
    static I atan2(I const& y, I const& x, mask& cut) {
        if (is_empty(x) || is_empty(y)) return empty();
        if (contains(x, 0.0) && contains(y, 0.0)) cut = true;
        if (is_zero(x) && is_zero(y)) return empty();
        if (mpfr_sgn(&raw(y)->left) >= 0) return upper_half_angle(y, x);
        if (mpfr_sgn(&raw(x)->left) < 0 && mpfr_sgn(&raw(y)->right) >= 0) {
            I const pi = made([](mpfr_ptr lo, mpfr_ptr hi) {
                mpfr_const_pi(lo, MPFR_RNDD);
                mpfr_const_pi(hi, MPFR_RNDU);
            });
            return hull(neg(pi), pi);
        }
        if (mpfr_sgn(&raw(y)->right) <= 0) return neg(upper_half_angle(neg(y), x));
        I const right = max(x, point(0.0));
        return hull(
            upper_half_angle(intersect(y, bounds(0.0, detail::infinity)), right),
            neg(upper_half_angle(neg(intersect(y, bounds(-detail::infinity, 0.0))), right)));
    }
    static I sinh(I const& a) { return increasing(mpfr_sinh, a); }
    static I cosh(I const& a) { return increasing(mpfr_cosh, abs(a)); }
    static I tanh(I const& a) { return increasing(mpfr_tanh, a); }
    static I asinh(I const& a) { return increasing(mpfr_asinh, a); }
    static I acosh(I const& a, mask& cut) {
        return increasing(mpfr_acosh, restricted(a, 1.0, detail::infinity, cut));
    }
    static I atanh(I const& a, mask& cut) {
        I const x = restricted(a, -1.0, 1.0, cut, true);
        if (!is_empty(x) &&
            (mpfr_cmp_d(&raw(x)->right, -1.0) == 0 || mpfr_cmp_d(&raw(x)->left, 1.0) == 0))
            return empty();
        return increasing(mpfr_atanh, x);
    }

    // Functions made of pieces.
    static I sign(I const& a) {
        if (is_empty(a)) return a;
        auto const of = [](mpfr_srcptr x) {
            return mpfr_sgn(x) > 0 ? 1.0 : mpfr_sgn(x) < 0 ? -1.0 : 0.0;
        };
        return bounds(of(&raw(a)->left), of(&raw(a)->right));
    }
    static I saturate(I const& a, I const& lo, I const& hi) { return min(max(a, lo), hi); }
    static I deadband(I const& a, I const& half_width) {
        I const w = intersect(half_width, bounds(0.0, detail::infinity));
        if (is_empty(a) || is_empty(w)) return empty();
        // max(t - w, 0) + min(t + w, 0): one of the terms is 0 at every t.
        I const zero = point(0.0);
        return add(max(sub(a, w), zero), min(add(a, w), zero));
    }

private:
    static mpfi_ptr raw(I& a) { return a.backend().data(); }
    static mpfi_srcptr raw(I const& a) { return a.backend().data(); }
    static void make_empty(I& a) {
        mpfr_set_nan(&raw(a)->left);
        mpfr_set_nan(&raw(a)->right);
    }
    /// An interval whose bounds are set by f(lo, hi).
    template <class Function>
    static I made(Function const& f) {
        I r;
        f(&raw(r)->left, &raw(r)->right);
        return r;
    }
    using unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
    using binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

    static bool is_zero(I const& a) {
        return mpfr_zero_p(&raw(a)->left) != 0 && mpfr_zero_p(&raw(a)->right) != 0;
    }
    static I decreasing(unary f, I const& a) {
        if (is_empty(a)) return a;
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            f(lo, &raw(a)->right, MPFR_RNDD);
            f(hi, &raw(a)->left, MPFR_RNDU);
        });
    }
    static I increasing(unary f, I const& a) {
        if (is_empty(a)) return a;
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            f(lo, &raw(a)->left, MPFR_RNDD);
            f(hi, &raw(a)->right, MPFR_RNDU);
        });
    }
    static I increasing(binary f, I const& a, I const& b) {
        if (is_empty(a) || is_empty(b)) return empty();
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            f(lo, &raw(a)->left, &raw(b)->left, MPFR_RNDD);
            f(hi, &raw(a)->right, &raw(b)->right, MPFR_RNDU);
        });
    }
    static I library(int (*f)(mpfi_ptr, mpfi_srcptr), I const& a) {
        if (is_empty(a)) return a;
        I r;
        f(raw(r), raw(a));
        return r;
    }
    /// a without the numbers outside of [lo, hi] (of ]lo, hi[ if `open`); `cut` if there were any.
    static I restricted(I const& a, double lo, double hi, mask& cut, bool open = false) {
        if (is_empty(a)) return a;
        int const below = mpfr_cmp_d(&raw(a)->left, lo), above = mpfr_cmp_d(&raw(a)->right, hi);
        bool const bounded_above = hi < detail::infinity;
        if (below < 0 || (open && below == 0) ||
            (bounded_above && (above > 0 || (open && above == 0))))
            cut = true;
        if (open && mpfr_cmp_d(&raw(a)->right, lo) <= 0) return empty();
        return intersect(a, bounds(lo, hi));
    }
    /// The same set, zero bounds with a positive sign: mpfr_log and mpfr_pow tell -0 from +0.
    static I magnitude(I const& a) { return increasing(mpfr_abs, a); }
    /// Extremes of f at the corners; 0 * inf and inf / inf count as 0.
    static I corners(binary f, I const& a, I const& b) {
        if (is_empty(a) || is_empty(b)) return empty();
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            I work;
            mpfr_ptr const value = &raw(work)->left;
            mpfr_set_inf(lo, 1);
            mpfr_set_inf(hi, -1);
            for (mpfr_srcptr const x : {&raw(a)->left, &raw(a)->right}) {
                for (mpfr_srcptr const y : {&raw(b)->left, &raw(b)->right}) {
                    f(value, x, y, MPFR_RNDD);
                    if (mpfr_nan_p(value) != 0) mpfr_set_zero(value, 1);
                    mpfr_min(lo, lo, value, MPFR_RNDD);
                    f(value, x, y, MPFR_RNDU);
                    if (mpfr_nan_p(value) != 0) mpfr_set_zero(value, 1);
                    mpfr_max(hi, hi, value, MPFR_RNDU);
                }
            }
        });
    }
    /// a / (b with the part <= 0 left out), where b reaches down to 0.
    static I over_zero_to(I const& a, I const& b) {
        if (mpfr_sgn(&raw(b)->right) <= 0) return empty();
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            if (mpfr_sgn(&raw(a)->left) < 0)
                mpfr_set_inf(lo, -1);
            else
                mpfr_div(lo, &raw(a)->left, &raw(b)->right, MPFR_RNDD);
            if (mpfr_sgn(&raw(a)->right) > 0)
                mpfr_set_inf(hi, 1);
            else
                mpfr_div(hi, &raw(a)->right, &raw(b)->right, MPFR_RNDU);
        });
    }
    static I power(I const& a, long n) {
        I const x = n % 2 == 0 ? abs(a) : a;
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            mpfr_pow_si(lo, &raw(x)->left, n, MPFR_RNDD);
            mpfr_pow_si(hi, &raw(x)->right, n, MPFR_RNDU);
        });
    }
    /// Angles of the box without the origin, y >= 0: decreasing in x, increasing in y on the right,
    /// decreasing on the left. Zeros get a positive sign: mpfr_atan2 tells them apart.
    static I upper_half_angle(I const& y, I const& x) {
        I const height = magnitude(y);
        bool const reaches_right = mpfr_sgn(&raw(x)->right) > 0,
                   reaches_left = mpfr_sgn(&raw(x)->left) < 0;
        bool const on_axis = is_zero(height);
        return made([&](mpfr_ptr lo, mpfr_ptr hi) {
            I const positive = is_zero(x) ? magnitude(x) : x;
            if (on_axis && !reaches_right)
                mpfr_const_pi(lo, MPFR_RNDD);
            else
                mpfr_atan2(lo, reaches_right ? &raw(height)->left : &raw(height)->right,
                           &raw(positive)->right, MPFR_RNDD);
            if (on_axis && !reaches_left)
                mpfr_set_zero(hi, 1);
            else
                mpfr_atan2(hi, reaches_left ? &raw(height)->left : &raw(height)->right,
                           &raw(positive)->left, MPFR_RNDU);
        });
    }
};

static_assert(interval_scalar<mp_interval>);

} // namespace sivid

// Elementary functions for the vocabulary type whose bounds rest on MPFR's correct rounding instead
// of sivid's own kernels, and which are therefore tight.
// `proven_interval` brings them to code that is written for any interval type. One to two hundred
// times slower. Needs mpfi, mpfr and gmp at link time.

namespace sivid {

/// An `interval` whose elementary functions are tight.
struct proven_interval {
    interval bounds{0.0};
};

/// Arithmetic is the vocabulary type's, which is proven already. Elementary functions are those of
/// `mp_interval`: values in 40 digits are rounded outward and then outward to double, which is the
/// same as once outward to double; only negative powers take two roundings in 40 digits.
template <>
struct interval_traits<proven_interval> : traits_by_bounds<proven_interval> {
    using I = proven_interval;
    static I bounds(double lo, double hi) { return {sivid::detail::bounded(lo, hi)}; }
    static I empty() { return {sivid::detail::empty_interval()}; }
    static double lower(I const& a, std::size_t = 0) { return a.bounds.lower(); }
    static double upper(I const& a, std::size_t = 0) { return a.bounds.upper(); }
    static interval to_interval(I const& a) { return a.bounds; }

    static I exp(I const& a) { return out(mp::exp(in(a))); }
    static I expm1(I const& a) { return out(mp::expm1(in(a))); }
    static I log(I const& a, mask& cut) { return out(mp::log(in(a), cut)); }
    static I log1p(I const& a, mask& cut) { return out(mp::log1p(in(a), cut)); }
    static I sin(I const& a) { return out(mp::sin(in(a))); }
    static I cos(I const& a) { return out(mp::cos(in(a))); }
    static I tan(I const& a, mask& cut) { return out(mp::tan(in(a), cut)); }
    static I asin(I const& a, mask& cut) { return out(mp::asin(in(a), cut)); }
    static I acos(I const& a, mask& cut) { return out(mp::acos(in(a), cut)); }
    static I atan(I const& a) { return out(mp::atan(in(a))); }
    static I atan2(I const& y, I const& x, mask& cut) { return out(mp::atan2(in(y), in(x), cut)); }
    static I sinh(I const& a) { return out(mp::sinh(in(a))); }
    static I cosh(I const& a) { return out(mp::cosh(in(a))); }
    static I tanh(I const& a) { return out(mp::tanh(in(a))); }
    static I asinh(I const& a) { return out(mp::asinh(in(a))); }
    static I acosh(I const& a, mask& cut) { return out(mp::acosh(in(a), cut)); }
    static I atanh(I const& a, mask& cut) { return out(mp::atanh(in(a), cut)); }
    static I hypot(I const& a, I const& b) { return out(mp::hypot(in(a), in(b))); }
    static I pown(I const& a, int n, mask& cut) { return out(mp::pown(in(a), n, cut)); }
    static I pow(I const& a, I const& b, mask& cut) { return out(mp::pow(in(a), in(b), cut)); }

private:
    using mp = interval_traits<mp_interval>;
    static mp_interval in(I const& a) { return mp::bounds(a.bounds.lower(), a.bounds.upper()); }
    static I out(mp_interval const& y) { return bounds(mp::lower(y), mp::upper(y)); }
};

static_assert(interval_scalar<proven_interval>);

} // namespace sivid

#endif
