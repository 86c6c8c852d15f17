// SPDX-License-Identifier: MIT
// Laws that every interval type obeys, as one template over the type: lanes are compared by their
// bounds.
//     for (auto const& failure : laws::all<my_interval>(1000, seed)) FAIL(failure);
#ifndef SIVID_TESTS_LAWS_LAWS_HPP
#define SIVID_TESTS_LAWS_LAWS_HPP

#include "laws/containment.hpp"
#include "support/further_functions.hpp"

#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

namespace laws {

/// Bounds of one lane, or of a set that the test computes.
struct range {
    double lo, hi;
    bool empty() const { return !(lo <= hi); }
    bool in(range const& other) const { return empty() || (other.lo <= lo && hi <= other.hi); }
    bool same(range const& other) const {
        return (empty() && other.empty()) || (lo == other.lo && hi == other.hi);
    }
};

template <class I>
range lane_of(I const& x, std::size_t lane) {
    return {sivid::interval_traits<I>::lower(x, lane), sivid::interval_traits<I>::upper(x, lane)};
}

template <class I>
class suite {
public:
    using t = sivid::interval_traits<I>;
    using mask = typename t::mask;

    explicit suite(std::uint64_t seed) : in_{seed} {}

    std::vector<std::string> run(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            neutral_elements(any());
            sets(any(), any(), any());
            arithmetic(any(), any());
            exact_arithmetic(small(), small(), small());
            isotonicity();
        }
        empties();
        return {failures_.begin(), failures_.end()};
    }

private:
    template <class Range>
    I make(Range const& lane_range) {
        range r[64];
        for (std::size_t lane = 0; lane < t::lanes; ++lane) r[lane] = lane_range();
        if constexpr (t::lanes == 1)
            return t::bounds(r[0].lo, r[0].hi);
        else
            return t::from_lanes([&](std::size_t k) { return r[k].lo; },
                                 [&](std::size_t k) { return r[k].hi; });
    }
    /// Any shape of interval, any magnitude, sometimes unbounded.
    I any() {
        return make([&] {
            argument const x = random_argument(in_, in_.mixed());
            return range{x.lo, x.hi};
        });
    }
    /// Small whole bounds: sums and products are exact.
    I small() {
        return make([&] {
            double const a = static_cast<double>(in_.below(2001)) - 1000.0;
            return range{a, a + static_cast<double>(in_.below(500))};
        });
    }
    /// A part of x.
    I part(I const& x) {
        std::size_t lane = 0;
        return make([&] {
            range const r = lane_of(x, lane++);
            auto const inside = [&] {
                double const lo = r.lo < -1e300 ? -1e300 : r.lo, hi = r.hi > 1e300 ? 1e300 : r.hi;
                double const y = in_.below(3) == 0 ? lo : in_.uniform(lo, hi);
                return y >= r.lo && y <= r.hi ? y : r.lo < -1e300 ? r.hi : r.lo;
            };
            double const a = inside(), b = inside();
            return range{a < b ? a : b, a < b ? b : a};
        });
    }

    void fail(char const* law, I const& x, std::size_t lane, I const& left, I const& right) {
        char text[300];
        std::snprintf(text, sizeof text, "%s: x = [%a, %a], [%a, %a] against [%a, %a]", law,
                      t::lower(x, lane), t::upper(x, lane), t::lower(left, lane),
                      t::upper(left, lane), t::lower(right, lane), t::upper(right, lane));
        if (failures_.size() < 20) failures_.insert(text);
    }
    void same(char const* law, I const& x, I const& left, I const& right) {
        for (std::size_t lane = 0; lane < t::lanes; ++lane)
            if (!lane_of(left, lane).same(lane_of(right, lane)))
                return fail(law, x, lane, left, right);
    }
    /// left is in right; `floats` of rounding are forgiven at each end.
    void inside(char const* law, I const& x, I const& left, I const& right, int floats = 0) {
        for (std::size_t lane = 0; lane < t::lanes; ++lane) {
            range r = lane_of(right, lane);
            if (floats > 0) {
                r.lo = sivid::detail::step(r.lo, -floats);
                r.hi = sivid::detail::step(r.hi, floats);
            }
            if (!lane_of(left, lane).in(r)) return fail(law, x, lane, left, right);
        }
    }
    /// Of every lane, or of none.
    void every(char const* law, I const& x, bool holds) {
        if (!holds) fail(law, x, 0, x, x);
    }

    static I quotient(I const& a, I const& b) {
        mask m{};
        return t::div(a, b, m);
    }

    void neutral_elements(I const& x) {
        I const zero = t::point(0.0), one = t::point(1.0);
        same("x + 0 = x", x, t::add(x, zero), x);
        same("0 + x = x", x, t::add(zero, x), x);
        same("x - 0 = x", x, t::sub(x, zero), x);
        same("1 x = x", x, t::mul(one, x), x);
        same("x 1 = x", x, t::mul(x, one), x);
        same("x / 1 = x", x, quotient(x, one), x);
        same("0 x = 0", x, t::mul(zero, x), zero);
        same("-(-x) = x", x, t::neg(t::neg(x)), x);
        same("-x = 0 - x", x, t::neg(x), t::sub(zero, x));
        same("(-1) x = -x", x, t::mul(t::point(-1.0), x), t::neg(x));
        same("hull(x, x) = x", x, t::hull(x, x), x);
        same("hull(x, empty) = x", x, t::hull(x, t::empty()), x);
        same("intersect(x, x) = x", x, t::intersect(x, x), x);
        same("intersect(x, entire) = x", x, t::intersect(x, t::entire()), x);
        same("min(x, x) = x", x, t::min(x, x), x);
        same("max(x, x) = x", x, t::max(x, x), x);
        same("|-x| = |x|", x, t::abs(t::neg(x)), t::abs(x));
        same("(-x)^2 = x^2", x, t::sqr(t::neg(x)), t::sqr(x));
        inside("x^2 in x x", x, t::sqr(x), t::mul(x, x));
        inside("0 in x - x", x, zero, t::sub(x, x));
        mask m{};
        same("x^1 = x", x, t::pown(x, 1, m), x);
        same("x^0 = 1", x, t::pown(x, 0, m), one);
        if constexpr (support::has_further_functions<I>) {
            same("x limited to everything = x", x,
                 t::saturate(x, t::point(-1e308), t::point(1e308)),
                 t::max(t::min(x, t::point(1e308)), t::point(-1e308)));
            same("no dead band", x, t::deadband(x, zero), x);
        }
        inside("sign in [-1, 1]", x, t::sign(x), t::bounds(-1.0, 1.0));
        same("|x| = max(x, -x) where x has one sign", x, t::abs(t::abs(x)), t::abs(x));
    }

    void sets(I const& x, I const& y, I const& z) {
        same("hull commutes", x, t::hull(x, y), t::hull(y, x));
        same("intersection commutes", x, t::intersect(x, y), t::intersect(y, x));
        same("hull associates", x, t::hull(x, t::hull(y, z)), t::hull(t::hull(x, y), z));
        same("intersection associates", x, t::intersect(x, t::intersect(y, z)),
             t::intersect(t::intersect(x, y), z));
        inside("x in hull(x, y)", x, x, t::hull(x, y));
        inside("intersect(x, y) in x", x, t::intersect(x, y), x);
        same("intersect(x, hull(x, y)) = x", x, t::intersect(x, t::hull(x, y)), x);
        same("hull(x, intersect(x, y)) = x", x, t::hull(x, t::intersect(x, y)), x);
        same("min and max commute", x, t::hull(t::min(x, y), t::max(x, y)),
             t::hull(t::min(y, x), t::max(y, x)));
        same("min(x, y) + max(x, y) has the bounds of x + y", x, t::add(t::min(x, y), t::max(x, y)),
             t::add(x, y));
        for (std::size_t lane = 0; lane < t::lanes; ++lane) {
            range const a = lane_of(x, lane), b = lane_of(y, lane),
                        c = lane_of(t::intersect(x, y), lane);
            every("the intersection has the greater lower bound", x,
                  c.empty() ? a.hi < b.lo || b.hi < a.lo
                            : c.same({a.lo > b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi}));
        }
    }

    void arithmetic(I const& x, I const& y) {
        same("x + y = y + x", x, t::add(x, y), t::add(y, x));
        same("x y = y x", x, t::mul(x, y), t::mul(y, x));
        same("x - y = x + (-y)", x, t::sub(x, y), t::add(x, t::neg(y)));
        same("x - y = -(y - x)", x, t::sub(x, y), t::neg(t::sub(y, x)));
        same("x (-y) = -(x y)", x, t::mul(x, t::neg(y)), t::neg(t::mul(x, y)));
        inside("x in (x + y) - y", x, x, t::sub(t::add(x, y), y));
        mask cut{};
        I const q = t::div(t::mul(x, y), y, cut);
        if (cut == mask{}) inside("x in (x y) / y", x, x, q);
        I const root = t::sqrt(t::sqr(x), cut);
        inside("|x| in sqrt(x^2)", x, t::abs(x), root);
        if constexpr (support::has_further_functions<I>) {
            inside("|x| in hypot(x, y)'s hull with y", x, t::abs(x),
                   t::hull(t::hypot(x, y), t::bounds(0.0, 0.0)));
        }
    }

    void exact_arithmetic(I const& x, I const& y, I const& z) {
        inside("x (y + z) in x y + x z", x, t::mul(x, t::add(y, z)),
               t::add(t::mul(x, y), t::mul(x, z)));
        same("x + (y + z) = (x + y) + z", x, t::add(x, t::add(y, z)), t::add(t::add(x, y), z));
        same("x (y z) = (x y) z", x, t::mul(x, t::mul(y, z)), t::mul(t::mul(x, y), z));
        I const point = t::point(static_cast<double>(in_.below(100)));
        same("p (y + z) = p y + p z for a point p", x, t::mul(point, t::add(y, z)),
             t::add(t::mul(point, y), t::mul(point, z)));
        mask m{};
        same("x^2 = x x for x >= 0", x, t::pown(t::abs(x), 2, m), t::mul(t::abs(x), t::abs(x)));
        same("x^3 = x x^2", x, t::pown(x, 3, m), t::hull(t::pown(x, 3, m), t::empty()));
    }

    /// Bounds come from rounded values at the ends; a library that is not monotone to the last
    /// float is forgiven the widening of two ends.
    void isotonicity() {
        I const x = any(), y = any(), a = part(x), b = part(y);
        mask m{};
        inside("isotone +", a, t::add(a, b), t::add(x, y));
        inside("isotone -", a, t::sub(a, b), t::sub(x, y));
        inside("isotone *", a, t::mul(a, b), t::mul(x, y));
        inside("isotone /", a, t::div(a, b, m), t::div(x, y, m));
        inside("isotone sqr", a, t::sqr(a), t::sqr(x));
        inside("isotone sqrt", a, t::sqrt(a, m), t::sqrt(x, m));
        inside("isotone abs", a, t::abs(a), t::abs(x));
        inside("isotone min", a, t::min(a, b), t::min(x, y));
        inside("isotone max", a, t::max(a, b), t::max(x, y));
        inside("isotone neg", a, t::neg(a), t::neg(x));
        inside("isotone sign", a, t::sign(a), t::sign(x));
        inside("isotone hull", a, t::hull(a, b), t::hull(x, y));
        inside("isotone intersect", a, t::intersect(a, b), t::intersect(x, y));
        constexpr int slack = 12;
        inside("isotone exp", a, t::exp(a), t::exp(x), slack);
        inside("isotone log", a, t::log(a, m), t::log(x, m), slack);
        inside("isotone sin", a, t::sin(a), t::sin(x), slack);
        inside("isotone cos", a, t::cos(a), t::cos(x), slack);
        inside("isotone tan", a, t::tan(a, m), t::tan(x, m), slack);
        inside("isotone atan", a, t::atan(a), t::atan(x), slack);
        inside("isotone tanh", a, t::tanh(a), t::tanh(x), slack);
        if constexpr (support::has_further_functions<I>) {
            inside("isotone saturate", a, t::saturate(a, b, b), t::saturate(x, y, y));
            inside("isotone deadband", a, t::deadband(a, t::abs(b)), t::deadband(x, t::abs(y)));
            inside("isotone hypot", a, t::hypot(a, b), t::hypot(x, y), slack);
            inside("isotone expm1", a, t::expm1(a), t::expm1(x), slack);
            inside("isotone log1p", a, t::log1p(a, m), t::log1p(x, m), slack);
            inside("isotone asin", a, t::asin(a, m), t::asin(x, m), slack);
            inside("isotone acos", a, t::acos(a, m), t::acos(x, m), slack);
            inside("isotone sinh", a, t::sinh(a), t::sinh(x), slack);
            inside("isotone cosh", a, t::cosh(a), t::cosh(x), slack);
            inside("isotone atan2", a, t::atan2(a, b, m), t::atan2(x, y, m), slack);
            inside("isotone pow", a, t::pow(a, b, m), t::pow(x, y, m), slack);
        }
        for (int const n : {-3, -2, 3, 4, 7})
            inside("isotone pown", a, t::pown(a, n, m), t::pown(x, n, m), slack);
    }

    void empties() {
        I const none = t::empty(), all = t::entire();
        mask m{};
        for (I const& y :
             {t::add(none, all), t::sub(all, none), t::mul(none, all), t::div(all, none, m),
              t::sqr(none), t::sqrt(none, m), t::exp(none), t::log(none, m), t::sin(none),
              t::cos(none), t::tan(none, m), t::atan(none), t::tanh(none), t::abs(none),
              t::min(none, all), t::max(all, none), t::pown(none, 2, m), t::intersect(none, all),
              t::sign(none)})
            same("a function of the empty set is empty", none, y, none);
        if constexpr (support::has_further_functions<I>) {
            for (I const& y : {t::pow(none, all, m), t::atan2(none, all, m), t::hypot(none, all)})
                same("a function of the empty set is empty", none, y, none);
        }
        every("the empty set cuts no domain", none, m == mask{});
        same("empty by bounds", none, t::bounds(1.0, 0.0), none);
        same("empty by NaN", none, t::bounds(0.0, sivid::detail::not_a_number), none);
        mask cut{};
        static_cast<void>(t::sqrt(t::bounds(-1.0, 4.0), cut));
        every("a cut domain is reported", none, cut != mask{});
        cut = mask{};
        static_cast<void>(t::log(t::bounds(0.0, 4.0), cut));
        every("log cuts 0", none, cut != mask{});
        cut = mask{};
        static_cast<void>(t::sqrt(t::bounds(0.0, 4.0), cut));
        static_cast<void>(t::log(t::bounds(1.0, 4.0), cut));
        static_cast<void>(t::div(t::bounds(0.0, 4.0), t::bounds(1.0, 2.0), cut));
        static_cast<void>(t::tan(t::bounds(-1.0, 1.0), cut));
        every("no cut where there is none", none, cut == mask{});
    }

    oracle::inputs in_;
    std::set<std::string> failures_;
};

/// The failures of every law over `count` random inputs; none if all is well.
template <class I>
std::vector<std::string> all(std::size_t count, std::uint64_t seed) {
    return suite<I>{seed}.run(count);
}

} // namespace laws

#endif
