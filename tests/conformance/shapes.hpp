// SPDX-License-Identifier: MIT
// Pieces of code in which compilers broke interval arithmetic: each mixes directed operations with
// constants, plain operations on the same doubles, loops or changes of the rounding mode. Written
// once for every interval type; of a pack, every lane is checked.
#ifndef SIVID_TESTS_CONFORMANCE_SHAPES_HPP
#define SIVID_TESTS_CONFORMANCE_SHAPES_HPP

#include "support/further_functions.hpp"
#include "support/oracle.hpp"

#include <sivid/number/interval_traits.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace shapes {

/// The two ways to compute with an interval type. `rounds`: whether bounds are doubles.
template <class Interval>
struct by_traits {
    using I = Interval;
    using t = sivid::interval_traits<I>;
    static constexpr bool rounds = !requires(I const& x) { t::to_interval(x); };
    static I of(double x) { return t::point(x); }
    static I add(I const& a, I const& b) { return t::add(a, b); }
    static I sub(I const& a, I const& b) { return t::sub(a, b); }
    static I mul(I const& a, I const& b) { return t::mul(a, b); }
    static I div(I const& a, I const& b) {
        typename t::mask cut{};
        return t::div(a, b, cut);
    }
    static I neg(I const& a) { return t::neg(a); }
    static I sqrt(I const& a) {
        typename t::mask cut{};
        return t::sqrt(a, cut);
    }
    static I log(I const& a) {
        typename t::mask cut{};
        return t::log(a, cut);
    }
    static I exp(I const& a) { return t::exp(a); }
    static I sin(I const& a) { return t::sin(a); }
};
template <class Interval>
struct by_operators : by_traits<Interval> {
    using I = Interval;
    static I add(I const& a, I const& b) { return a + b; }
    static I sub(I const& a, I const& b) { return a - b; }
    static I mul(I const& a, I const& b) { return a * b; }
    static I div(I const& a, I const& b) { return a / b; }
    static I neg(I const& a) { return -a; }
};

/// Whether `holds(lower, upper)` in every lane.
template <class I, class Predicate>
bool every_lane(I const& x, Predicate const& holds) {
    using t = sivid::interval_traits<I>;
    for (std::size_t lane = 0; lane < t::lanes; ++lane)
        if (!holds(t::lower(x, lane), t::upper(x, lane))) return false;
    return true;
}
template <class I>
bool contains(I const& x, double y) {
    return every_lane(x, [y](double lo, double hi) { return lo <= y && y <= hi; });
}
template <class I>
bool same(I const& a, I const& b) {
    using t = sivid::interval_traits<I>;
    for (std::size_t lane = 0; lane < t::lanes; ++lane)
        if (t::lower(a, lane) != t::lower(b, lane) || t::upper(a, lane) != t::upper(b, lane))
            return false;
    return true;
}
template <class I>
bool meet(I const& a, I const& b) {
    using mask = typename sivid::interval_traits<I>::mask;
    return sivid::interval_traits<I>::disjoint(a, b) == mask{};
}

/// Counts the results that miss the exact value.
struct tally {
    std::size_t run = 0, missed = 0;
    template <class I>
    void check(I const& got, oracle::value exact) {
        check(every_lane(got, [&](double lo, double hi) { return exact.in(lo, hi); }));
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
    t.check(O::sqrt(O::of(2.0)), oracle::at(mpfr_sqrt, 2.0));
    t.check(O::exp(O::of(1.5)), oracle::at(mpfr_exp, 1.5));
    t.check(O::sin(O::of(0.7)), oracle::at(mpfr_sin, 0.7));
    t.check(O::log(O::of(10.0)), oracle::at(mpfr_log, 10.0));
}

template <class O>
void loop_invariants(tally& t, oracle::inputs& in) {
    double const a = in.magnitude(-3, 3), b = in.magnitude(-3, 3);
    std::array<typename O::I, 8> y;
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
    auto const ip = O::mul(O::of(x), O::of(y)), is = O::add(O::of(x), O::of(y));
    auto const id = O::sub(O::of(x), O::of(y)), iq = O::div(O::of(x), O::of(y));
    double const p2 = x * y, s2 = x + y, d2 = x - y, q2 = x / y;
    t.check(ip, oracle::at(mpfr_mul, x, y));
    t.check(is, oracle::at(mpfr_add, x, y));
    t.check(id, oracle::at(mpfr_sub, x, y));
    t.check(iq, oracle::at(mpfr_div, x, y));
    t.check(contains(ip, p) && contains(is, s) && contains(id, d) && contains(iq, q));
    t.check(contains(ip, p2) && contains(is, s2) && contains(id, d2) && contains(iq, q2));
    double const root = __builtin_sqrt(x < 0.0 ? -x : x);
    auto const iroot = O::sqrt(O::of(x < 0.0 ? -x : x));
    t.check(contains(iroot, root));
    t.check(iroot, oracle::at(mpfr_sqrt, x < 0.0 ? -x : x));
}

template <class O>
void twice_enclosed(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-30, 30), y = in.magnitude(-30, 30);
    auto const a = O::mul(O::of(x), O::of(y));
    auto const b = O::neg(O::mul(O::of(-x), O::of(y)));
    auto const c = O::mul(O::of(y), O::of(x));
    t.check(meet(a, b) && meet(a, c) && meet(b, c));
    t.check(b, oracle::at(mpfr_mul, x, y));
    t.check(same(a, b) && same(a, c));
    double const p = x * y;
    t.check(every_lane(a, [p](double lo, double hi) {
        return lo == hi ? p == lo : oracle::inputs::moved(lo, 1) == hi;
    }));
    auto const direct = O::mul(O::of(4.1), O::of(x)),
               other = O::sub(O::of(0.0), O::mul(O::of(-4.1), O::of(x)));
    t.check(meet(direct, other));
}

template <class O>
void contraction(tally& t, oracle::inputs& in) {
    double const x = in.magnitude(-3, 3), y = in.magnitude(-3, 3), z = in.magnitude(-3, 3);
    double const p = x * y; // could be fused with what follows
    auto const s = O::add(O::of(p), O::of(z));
    t.check(s, oracle::at(mpfr_add, sivid::detail::opaque(p), z));
    auto const d = O::sub(O::of(p), O::of(x * z));
    t.check(d, oracle::at(mpfr_sub, sivid::detail::opaque(p), sivid::detail::opaque(x * z)));
}

template <class O>
void vector_loop(tally& t, oracle::inputs& in) {
    std::array<double, 16> x, y;
    std::array<typename O::I, 16> s, p;
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
    auto total = O::of(0.0);
    for (double const c : constants) {
        auto const q = O::div(O::of(x), O::of(c));
        t.check(q, oracle::at(mpfr_div, x, c));
        t.check(contains(q, x / c));
        total = O::add(total, q);
    }
    t.check(every_lane(total, [](double lo, double hi) { return lo <= hi; }));
}

template <class O>
void long_sum(tally& t, oracle::inputs& in) {
    oracle::number exact, x;
    mpfr_set_prec(exact.raw(), 400);
    mpfr_set_zero(exact.raw(), 1);
    auto sum = O::of(0.0);
    double plain = 0.0;
    for (int i = 0; i < 40; ++i) {
        double const v = in.magnitude(-40, 40);
        mpfr_set_d(x.raw(), v, MPFR_RNDN);
        mpfr_add(exact.raw(), exact.raw(), x.raw(), MPFR_RNDN); // no rounding in 400 bits
        sum = O::add(sum, O::of(v));
        plain += v;
    }
    t.check(sum, {mpfr_get_d(exact.raw(), MPFR_RNDD), mpfr_get_d(exact.raw(), MPFR_RNDU)});
    if (O::rounds) t.check(contains(sum, plain));
}

/// Different numbers in the lanes, beside a loop over the same doubles that invites vectors.
template <class O>
void lanes_beside_plain(tally& t, oracle::inputs& in) {
    using traits = sivid::interval_traits<typename O::I>;
    if constexpr (traits::lanes > 1) {
        constexpr std::size_t n = traits::lanes;
        std::array<double, n> x, y, p, s, q;
        for (std::size_t i = 0; i < n; ++i) {
            x[i] = in.magnitude(-30, 30);
            y[i] = in.magnitude(-30, 30);
        }
        for (std::size_t i = 0; i < n; ++i) {
            p[i] = x[i] * y[i];
            s[i] = x[i] + y[i];
            q[i] = x[i] / y[i];
        }
        auto const a = traits::from_lanes([&](std::size_t i) { return x[i]; },
                                          [&](std::size_t i) { return x[i]; });
        auto const b = traits::from_lanes([&](std::size_t i) { return y[i]; },
                                          [&](std::size_t i) { return y[i]; });
        auto const ip = O::mul(a, b), is = O::add(a, b), iq = O::div(a, b);
        auto const lane = [&](auto const& z, std::size_t i, oracle::value exact, double plain) {
            double const lo = traits::lower(z, i), hi = traits::upper(z, i);
            t.check(exact.in(lo, hi) && lo <= plain && plain <= hi);
        };
        std::size_t const i = in.below(n);
        lane(ip, i, oracle::at(mpfr_mul, x[i], y[i]), p[i]);
        lane(is, i, oracle::at(mpfr_add, x[i], y[i]), s[i]);
        lane(iq, i, oracle::at(mpfr_div, x[i], y[i]), q[i]);
    }
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
    lanes_beside_plain<O>(t, in);
}

/// One pass over functions that call the library or kernels of their own, at one argument.
template <class I>
void functions(tally& t, oracle::inputs& in) {
    using f = sivid::interval_traits<I>;
    typename f::mask cut{};
    double const x = in.magnitude(-6, 6), positive = x < 0.0 ? -x : x;
    [[maybe_unused]] double const y = in.uniform(-1.0, 1.0);
    I const i = f::point(x), p = f::point(positive);
    [[maybe_unused]] I const j = f::point(y);
    t.check(f::exp(i), oracle::at(mpfr_exp, x));
    t.check(f::sin(i), oracle::at(mpfr_sin, x));
    t.check(f::cos(i), oracle::at(mpfr_cos, x));
    t.check(f::tan(i, cut), oracle::at(mpfr_tan, x));
    t.check(f::atan(i), oracle::at(mpfr_atan, x));
    t.check(f::tanh(i), oracle::at(mpfr_tanh, x));
    t.check(f::log(p, cut), oracle::at(mpfr_log, positive));
    t.check(f::pown(i, 7, cut), oracle::power(x, 7));
    if constexpr (support::has_further_functions<I>) {
        t.check(f::sinh(i), oracle::at(mpfr_sinh, x));
        t.check(f::cosh(i), oracle::at(mpfr_cosh, x));
        t.check(f::log1p(p, cut), oracle::at(mpfr_log1p, positive));
        t.check(f::expm1(i), oracle::at(mpfr_expm1, x));
        t.check(f::asin(j, cut), oracle::at(mpfr_asin, y));
        t.check(f::acos(j, cut), oracle::at(mpfr_acos, y));
        t.check(f::atan2(i, j, cut), oracle::at(mpfr_atan2, x, y));
        t.check(f::hypot(i, j), oracle::at(mpfr_hypot, x, y));
        t.check(f::pow(p, j, cut), oracle::at(mpfr_pow, positive, y));
    }
    t.check(f::sqrt(p, cut), oracle::at(mpfr_sqrt, positive));
    t.check(f::sqr(i), oracle::at(mpfr_sqr, x));
}

// Defined in another translation unit, shapes_elsewhere.cpp, from the same inline functions.
template <class I>
I product_elsewhere(double x, double y);
template <class I>
I sum_elsewhere(double x, double y);
template <class I>
I quotient_elsewhere(double x, double y);
template <class I>
I sine_elsewhere(double x);
double plain_product_elsewhere(double x, double y);
void change_rounding_elsewhere(int mode);

} // namespace shapes

#endif
