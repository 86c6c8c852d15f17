// SPDX-License-Identifier: MIT
// Random containment of the functions of any interval type against MPFR: for boxes X of every shape
// and points t in them, f(t) must lie in F(X). A template over the type, so that one oracle serves
// all.
#ifndef SIVID_TESTS_LAWS_CONTAINMENT_HPP
#define SIVID_TESTS_LAWS_CONTAINMENT_HPP

#include "support/oracle.hpp"

#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace laws {

/// Inputs a function: SIVID_CONTAINMENT_COUNT if it is set, else `usual`.
inline std::size_t containment_count(std::size_t usual) {
    char const* const text = std::getenv("SIVID_CONTAINMENT_COUNT");
    return text != nullptr ? static_cast<std::size_t>(std::strtoull(text, nullptr, 10)) : usual;
}

/// A random argument: an interval and one of its members.
struct argument {
    double lo, hi, member;
};

inline argument random_argument(oracle::inputs& in, double a) {
    double b = a;
    switch (in.below(8)) {
    case 0:
    case 1:
    case 2:
        break; // a point
    case 3:
        b = oracle::inputs::moved(a, static_cast<int>(in.below(5)));
        break;
    case 4:
        b = a + in.uniform(0.0, 1e-6) * (a < 0.0 ? -a : a);
        break;
    case 5:
        b = a + in.uniform(0.0, 8.0);
        break;
    case 6:
        b = in.mixed();
        break;
    default:
        b = in.below(2) == 0 ? std::numeric_limits<double>::infinity()
                             : -std::numeric_limits<double>::infinity();
    }
    if (!(a <= b)) {
        double const swap = a;
        a = b;
        b = swap;
    }
    argument x{a, b, a};
    bool const low_open = a == -std::numeric_limits<double>::infinity();
    switch (in.below(5)) {
    case 0:
        x.member = low_open ? b : a;
        break;
    case 1:
        x.member = b < std::numeric_limits<double>::infinity() ? b : a;
        break;
    case 2:
        x.member = in.mixed();
        break;
    case 3:
        x.member = oracle::inputs::moved(low_open ? b : a, low_open ? -3 : 3);
        break;
    default:
        x.member = in.uniform(low_open ? b - 10.0 : a, b < 1e308 ? b : a + 10.0);
        break;
    }
    if (!(x.member >= a && x.member <= b && x.member - x.member == 0.0))
        x.member = low_open ? b : a;
    if (!(x.member >= a && x.member <= b)) x.member = b;
    return x;
}

struct misses {
    std::size_t inputs = 0, count = 0;
    std::string first; ///< one failure, with exact inputs

    void note(char const* name, double lo, double hi, double x, double y, double got_lo,
              double got_hi) {
        ++count;
        if (!first.empty()) return;
        char text[400];
        std::snprintf(text, sizeof text, "%s of [%a, %a] at (%a, %a) gave [%a, %a]", name, lo, hi,
                      x, y, got_lo, got_hi);
        first = text;
    }
};

/// One lane each of a fresh argument; `draw` gives the left end or the point.
template <class I, class Draw>
I random_lanes(oracle::inputs& in, Draw const& draw, argument (&x)[64]) {
    using t = sivid::interval_traits<I>;
    for (std::size_t lane = 0; lane < t::lanes; ++lane) x[lane] = random_argument(in, draw(in));
    if constexpr (t::lanes == 1) {
        return t::bounds(x[0].lo, x[0].hi);
    } else {
        return t::from_lanes([&](std::size_t lane) { return x[lane].lo; },
                             [&](std::size_t lane) { return x[lane].hi; });
    }
}

/// f(t) in F(X) for `count` random X; points where f is not defined are not tested.
template <class I, class Function>
misses contained(char const* name, std::size_t count, std::uint64_t seed, oracle::unary exact,
                 Function const& f) {
    using t = sivid::interval_traits<I>;
    static_assert(t::lanes <= 64);
    oracle::inputs in{seed};
    misses m;
    argument x[64];
    while (m.inputs < count) {
        I const got = f(random_lanes<I>(
            in, [](oracle::inputs& i) { return i.mixed(); }, x));
        for (std::size_t lane = 0; lane < t::lanes; ++lane, ++m.inputs) {
            oracle::value const v = oracle::at(exact, x[lane].member);
            if (!v.defined() || (v.below != v.below)) continue;
            if (v.below == v.above && v.below - v.below != 0.0) continue; // a pole
            double const lo = t::lower(got, lane), hi = t::upper(got, lane);
            if (!v.in(lo, hi)) m.note(name, x[lane].lo, x[lane].hi, x[lane].member, 0.0, lo, hi);
        }
    }
    return m;
}

/// The same for two arguments.
template <class I, class Function>
misses contained(char const* name, std::size_t count, std::uint64_t seed, oracle::binary exact,
                 Function const& f) {
    using t = sivid::interval_traits<I>;
    static_assert(t::lanes <= 64);
    oracle::inputs in{seed};
    misses m;
    argument x[64], y[64];
    auto const draw = [](oracle::inputs& i) { return i.mixed(); };
    while (m.inputs < count) {
        I const a = random_lanes<I>(in, draw, x), b = random_lanes<I>(in, draw, y);
        I const got = f(a, b);
        for (std::size_t lane = 0; lane < t::lanes; ++lane, ++m.inputs) {
            oracle::value const v = oracle::at(exact, x[lane].member, y[lane].member);
            if (!v.defined()) continue;
            if (v.below == v.above && v.below - v.below != 0.0) continue; // not a number of the set
            double const lo = t::lower(got, lane), hi = t::upper(got, lane);
            if (!v.in(lo, hi))
                m.note(name, x[lane].lo, x[lane].hi, x[lane].member, y[lane].member, lo, hi);
        }
    }
    return m;
}

/// Every function of the concept with an MPFR counterpart, `count` inputs each.
template <class I>
std::vector<misses> all_contained(std::size_t count, std::uint64_t seed) {
    using t = sivid::interval_traits<I>;
    using mask = typename t::mask;
    std::vector<misses> all;
    auto const one = [&](char const* name, oracle::unary exact, auto const& f) {
        all.push_back(contained<I>(name, count, ++seed, exact, f));
    };
    auto const two = [&](char const* name, oracle::binary exact, auto const& f) {
        all.push_back(contained<I>(name, count, ++seed, exact, f));
    };
    two("add", mpfr_add, [](I const& a, I const& b) { return t::add(a, b); });
    two("sub", mpfr_sub, [](I const& a, I const& b) { return t::sub(a, b); });
    two("mul", mpfr_mul, [](I const& a, I const& b) { return t::mul(a, b); });
    two("div", mpfr_div, [](I const& a, I const& b) {
        mask m{};
        return t::div(a, b, m);
    });
    two("hypot", mpfr_hypot, [](I const& a, I const& b) { return t::hypot(a, b); });
    two("min", mpfr_min, [](I const& a, I const& b) { return t::min(a, b); });
    two("max", mpfr_max, [](I const& a, I const& b) { return t::max(a, b); });
    two(
        "atan2",
        [](mpfr_ptr r, mpfr_srcptr y, mpfr_srcptr x, mpfr_rnd_t d) {
            if (mpfr_zero_p(x) && mpfr_zero_p(y)) {
                mpfr_set_nan(r);
                return 0;
            }
            if (!mpfr_zero_p(y)) return mpfr_atan2(r, y, x, d);
            if (mpfr_sgn(x) > 0) return mpfr_set_zero(r, 1), 0; // 0 has no sign among the reals
            return mpfr_const_pi(r, d);
        },
        [](I const& a, I const& b) {
            mask m{};
            return t::atan2(a, b, m);
        });
    two(
        "pow",
        [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t d) {
            bool const defined = mpfr_sgn(x) > 0 || (mpfr_zero_p(x) && mpfr_sgn(y) > 0);
            if (!defined) {
                mpfr_set_nan(r);
                return 0;
            }
            return mpfr_pow(r, x, y, d);
        },
        [](I const& a, I const& b) {
            mask m{};
            return t::pow(a, b, m);
        });
    one("sqr", mpfr_sqr, [](I const& a) { return t::sqr(a); });
    one("sqrt", mpfr_sqrt, [](I const& a) {
        mask m{};
        return t::sqrt(a, m);
    });
    one(
        "abs", [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t d) { return mpfr_abs(r, x, d); },
        [](I const& a) { return t::abs(a); });
    one("exp", mpfr_exp, [](I const& a) { return t::exp(a); });
    one("expm1", mpfr_expm1, [](I const& a) { return t::expm1(a); });
    one("log", mpfr_log, [](I const& a) {
        mask m{};
        return t::log(a, m);
    });
    one("log1p", mpfr_log1p, [](I const& a) {
        mask m{};
        return t::log1p(a, m);
    });
    one("sin", mpfr_sin, [](I const& a) { return t::sin(a); });
    one("cos", mpfr_cos, [](I const& a) { return t::cos(a); });
    one("tan", mpfr_tan, [](I const& a) {
        mask m{};
        return t::tan(a, m);
    });
    one("asin", mpfr_asin, [](I const& a) {
        mask m{};
        return t::asin(a, m);
    });
    one("acos", mpfr_acos, [](I const& a) {
        mask m{};
        return t::acos(a, m);
    });
    one("atan", mpfr_atan, [](I const& a) { return t::atan(a); });
    one("sinh", mpfr_sinh, [](I const& a) { return t::sinh(a); });
    one("cosh", mpfr_cosh, [](I const& a) { return t::cosh(a); });
    one("tanh", mpfr_tanh, [](I const& a) { return t::tanh(a); });
    if constexpr (requires(I const& a) { t::asinh(a); }) {
        one("asinh", mpfr_asinh, [](I const& a) { return t::asinh(a); });
        one("acosh", mpfr_acosh, [](I const& a) {
            mask m{};
            return t::acosh(a, m);
        });
        one("atanh", mpfr_atanh, [](I const& a) {
            mask m{};
            return t::atanh(a, m);
        });
    }
    for (int const n : {-7, -2, -1, 1, 2, 3, 4, 5, 17, 1000}) {
        static thread_local int power;
        power = n;
        one(("pown " + std::to_string(n)).c_str(),
            [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t d) {
                if (mpfr_zero_p(x) && power < 0) {
                    mpfr_set_nan(r);
                    return 0;
                }
                return mpfr_pow_si(r, x, power, d);
            },
            [](I const& a) {
                mask m{};
                return t::pown(a, power, m);
            });
    }
    return all;
}

} // namespace laws

#endif
