// SPDX-License-Identifier: MIT
// Pieces of code in which compilers broke interval arithmetic: each mixes directed operations with
// constants, plain operations on the same doubles, loops or changes of the rounding mode.
#ifndef SIVID_TESTS_CONFORMANCE_SHAPES_HPP
#define SIVID_TESTS_CONFORMANCE_SHAPES_HPP

#include "support/oracle.hpp"

#include <sivid/number/interval_traits.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace shapes {

using sivid::interval;

/// The two ways to compute with the vocabulary type.
struct by_traits {
    using t = sivid::interval_traits<interval>;
    static interval of(double x) { return t::point(x); }
    static interval add(interval const& a, interval const& b) { return t::add(a, b); }
    static interval sub(interval const& a, interval const& b) { return t::sub(a, b); }
    static interval mul(interval const& a, interval const& b) { return t::mul(a, b); }
    static interval div(interval const& a, interval const& b) {
        bool cut = false;
        return t::div(a, b, cut);
    }
    static interval neg(interval const& a) { return t::neg(a); }
};
struct by_operators {
    static interval of(double x) { return x; }
    static interval add(interval const& a, interval const& b) { return a + b; }
    static interval sub(interval const& a, interval const& b) { return a - b; }
    static interval mul(interval const& a, interval const& b) { return a * b; }
    static interval div(interval const& a, interval const& b) { return a / b; }
    static interval neg(interval const& a) { return -a; }
};

/// Counts the results that miss the exact value.
struct tally {
    std::size_t run = 0, missed = 0;
    void check(interval const& got, oracle::value exact) {
        ++run;
        if (!exact.in(sivid::lower(got), sivid::upper(got))) ++missed;
    }
    void check(bool holds) {
        ++run;
        if (!holds) ++missed;
    }
};

inline constexpr std::array<double, 6> constants{3.0, 0.1, -7.3, 1e-3, 4.1, 1.0 / 3.0};

template <class O>
void constant_operands(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-20, 20);
    t.check(O::add(O::of(x), O::of(0.1)), oracle::at(mpfr_add, x, 0.1));
    t.check(O::mul(O::of(x), O::of(4.1)), oracle::at(mpfr_mul, x, 4.1));
    t.check(O::div(O::of(x), O::of(3.0)), oracle::at(mpfr_div, x, 3.0));
    t.check(O::div(O::of(1.0), O::of(x)), oracle::at(mpfr_div, 1.0, x));
    t.check(O::div(O::of(1.0), O::of(3.0)), oracle::at(mpfr_div, 1.0, 3.0));
    t.check(O::mul(O::of(0.1), O::of(0.1)), oracle::at(mpfr_mul, 0.1, 0.1));
    t.check(O::add(O::of(0.1), O::of(0.2)), oracle::at(mpfr_add, 0.1, 0.2));
    t.check(O::sub(O::of(1e300), O::of(1e-300)), oracle::at(mpfr_sub, 1e300, 1e-300));
    t.check(O::mul(O::of(1e-200), O::of(1e-200)), oracle::at(mpfr_mul, 1e-200, 1e-200));
    t.check(O::mul(O::of(1e200), O::of(1e200)), oracle::at(mpfr_mul, 1e200, 1e200));
    t.check(sivid::sqrt(O::of(2.0)), oracle::at(mpfr_sqrt, 2.0));
    t.check(sivid::exp(O::of(1.5)), oracle::at(mpfr_exp, 1.5));
    t.check(sivid::sin(O::of(0.7)), oracle::at(mpfr_sin, 0.7));
    t.check(sivid::log(O::of(10.0)), oracle::at(mpfr_log, 10.0));
}

template <class O>
void loop_invariants(tally& t, oracle::inputs& in) {
    double const a = in.magnitude(-3, 3), b = in.magnitude(-3, 3);
    std::array<interval, 8> y;
    std::array<double, 8> x;
    for (auto& v : x) v = in.magnitude(-3, 3);
    for (std::size_t i = 0; i < x.size(); ++i) // a b does not change
        y[i] = O::add(O::mul(O::of(a), O::of(b)), O::of(x[i]));
    for (std::size_t i = 0; i < x.size(); ++i) {
        oracle::number u{a}, v{b}, w{x[i]}, r;
        oracle::value exact{};
        mpfr_fma(r.raw(), u.raw(), v.raw(), w.raw(), MPFR_RNDD);
        exact.below = mpfr_get_d(r.raw(), MPFR_RNDD);
        mpfr_fma(r.raw(), u.raw(), v.raw(), w.raw(), MPFR_RNDU);
        exact.above = mpfr_get_d(r.raw(), MPFR_RNDU);
        t.check(y[i], exact);
    }
}

template <class O>
void beside_plain(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-30, 30), y = in.magnitude(-30, 30);
    double const p = x * y, s = x + y, d = x - y, q = x / y;
    interval const ip = O::mul(O::of(x), O::of(y)), is = O::add(O::of(x), O::of(y));
    interval const id = O::sub(O::of(x), O::of(y)), iq = O::div(O::of(x), O::of(y));
    double const p2 = x * y, s2 = x + y, d2 = x - y, q2 = x / y;
    t.check(ip, oracle::at(mpfr_mul, x, y));
    t.check(is, oracle::at(mpfr_add, x, y));
    t.check(id, oracle::at(mpfr_sub, x, y));
    t.check(iq, oracle::at(mpfr_div, x, y));
    t.check(contains(ip, p) && contains(is, s) && contains(id, d) && contains(iq, q));
    t.check(contains(ip, p2) && contains(is, s2) && contains(id, d2) && contains(iq, q2));
    double const root = __builtin_sqrt(x < 0.0 ? -x : x);
    interval const iroot = sivid::sqrt(O::of(x < 0.0 ? -x : x));
    t.check(contains(iroot, root));
    t.check(iroot, oracle::at(mpfr_sqrt, x < 0.0 ? -x : x));
}

template <class O>
void twice_enclosed(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-30, 30), y = in.magnitude(-30, 30);
    interval const a = O::mul(O::of(x), O::of(y));
    interval const b = O::neg(O::mul(O::of(-x), O::of(y)));
    interval const c = O::mul(O::of(y), O::of(x));
    t.check(!disjoint(a, b) && !disjoint(a, c) && !disjoint(b, c));
    t.check(b, oracle::at(mpfr_mul, x, y));
    t.check(lower(a) == lower(b) && upper(a) == upper(b) && equal(a, c));
    if (sivid::is_point(a))
        t.check(x * y == lower(a));
    else
        t.check(oracle::inputs::moved(lower(a), 1) == upper(a));
    interval const direct = O::mul(O::of(4.1), O::of(x)),
                   other = O::sub(O::of(0.0), O::mul(O::of(-4.1), O::of(x)));
    t.check(!disjoint(direct, other));
}

template <class O>
void contraction(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-3, 3), y = in.magnitude(-3, 3), z = in.magnitude(-3, 3);
    double const p = x * y; // could be fused with what follows
    interval const s = O::add(O::of(p), O::of(z));
    t.check(s, oracle::at(mpfr_add, sivid::detail::opaque(p), z));
    interval const d = O::sub(O::of(p), O::of(x * z));
    t.check(d, oracle::at(mpfr_sub, sivid::detail::opaque(p), sivid::detail::opaque(x * z)));
}

template <class O>
void vector_loop(tally& t, oracle::inputs& in) {
    std::array<double, 16> x, y;
    std::array<interval, 16> s, p;
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = in.magnitude(-8, 8);
        y[i] = in.magnitude(-8, 8);
    }
    for (std::size_t i = 0; i < x.size(); ++i) s[i] = O::add(O::of(x[i]), O::of(y[i]));
    for (std::size_t i = 0; i < x.size(); ++i) p[i] = O::mul(O::of(x[i]), O::of(y[i]));
    std::size_t const k = in.below(16);
    t.check(s[k], oracle::at(mpfr_add, x[k], y[k]));
    t.check(p[k], oracle::at(mpfr_mul, x[k], y[k]));
}

template <class O>
void constant_divisors(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-20, 20);
    interval total = O::of(0.0);
    for (double const c : constants) {
        interval const q = O::div(O::of(x), O::of(c));
        t.check(q, oracle::at(mpfr_div, x, c));
        t.check(contains(q, x / c));
        total = O::add(total, q);
    }
    t.check(!sivid::is_empty(total));
}

template <class O>
void long_sum(tally& t, oracle::inputs& in) {
    oracle::number exact, x;
    mpfr_set_prec(exact.raw(), 400);
    mpfr_set_zero(exact.raw(), 1);
    interval sum = O::of(0.0);
    double plain = 0.0;
    for (int i = 0; i < 40; ++i) {
        double const v = in.magnitude(-40, 40);
        mpfr_set_d(x.raw(), v, MPFR_RNDN);
        mpfr_add(exact.raw(), exact.raw(), x.raw(), MPFR_RNDN); // no rounding in 400 bits
        sum = O::add(sum, O::of(v));
        plain += v;
    }
    t.check(sum, {mpfr_get_d(exact.raw(), MPFR_RNDD), mpfr_get_d(exact.raw(), MPFR_RNDU)});
    t.check(contains(sum, plain));
}

template <class O>
void every_shape(tally& t, oracle::inputs& in) {
    constant_operands<O>(t, in);
    loop_invariants<O>(t, in);
    beside_plain<O>(t, in);
    twice_enclosed<O>(t, in);
    contraction<O>(t, in);
    vector_loop<O>(t, in);
    constant_divisors<O>(t, in);
    long_sum<O>(t, in);
}

/// One pass over functions that call the library, at one argument.
inline void library_functions(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-6, 6), positive = x < 0.0 ? -x : x;
    interval const i = x;
    t.check(sivid::exp(i), oracle::at(mpfr_exp, x));
    t.check(sivid::sin(i), oracle::at(mpfr_sin, x));
    t.check(sivid::cos(i), oracle::at(mpfr_cos, x));
    t.check(sivid::tan(i), oracle::at(mpfr_tan, x));
    t.check(sivid::atan(i), oracle::at(mpfr_atan, x));
    t.check(sivid::tanh(i), oracle::at(mpfr_tanh, x));
    t.check(sivid::sinh(i), oracle::at(mpfr_sinh, x));
    t.check(sivid::cosh(i), oracle::at(mpfr_cosh, x));
    t.check(sivid::log(interval{positive}), oracle::at(mpfr_log, positive));
    t.check(sivid::pown(i, 7), oracle::power(x, 7));
    t.check(sivid::expm1(i), oracle::at(mpfr_expm1, x));
}

// Defined in another translation unit, shapes_elsewhere.cpp, from the same inline functions.
interval product_elsewhere(double x, double y);
interval sum_elsewhere(double x, double y);
interval quotient_elsewhere(double x, double y);
interval sine_elsewhere(double x);
double plain_product_elsewhere(double x, double y);
void change_rounding_elsewhere(int mode);

} // namespace shapes

#endif
