// SPDX-License-Identifier: MIT
// Random containment of the functions of interval types against MPFR: for intervals X of every
// shape and points t in them, f(t) must lie in F(X). A template over the types, so that one value
// of MPFR serves all of them.
#ifndef SIVID_TESTS_LAWS_CONTAINMENT_HPP
#define SIVID_TESTS_LAWS_CONTAINMENT_HPP

#include "support/further_functions.hpp"
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

/// Arguments that are drawn at a time; a multiple of every number of lanes up to it.
inline constexpr std::size_t batch = 64;

/// The intervals x[k], x[k + 1], ... in the lanes.
template <class I>
I lanes_from(argument const* x) {
    using t = sivid::interval_traits<I>;
    if constexpr (requires { t::all_lanes; })
        return t::from_lanes([x](std::size_t lane) { return x[lane].lo; },
                             [x](std::size_t lane) { return x[lane].hi; });
    else
        return t::bounds(x[0].lo, x[0].hi);
}

/// f(t) (f(s, t)) in F(X) (F(X, Y)) of each type for the members of a batch; `exact` is NaN where
/// nothing is asked.
template <class I, int Arity, class Function>
void check_batch(misses& m, char const* name, Function const& f, argument const* x,
                 argument const* y, oracle::value const* exact) {
    using t = sivid::interval_traits<I>;
    static_assert(batch % t::lanes == 0);
    for (std::size_t k = 0; k < batch; k += t::lanes) {
        I const got = [&] {
            if constexpr (Arity == 1)
                return f(lanes_from<I>(x + k));
            else
                return f(lanes_from<I>(x + k), lanes_from<I>(y + k));
        }();
        for (std::size_t lane = 0; lane < t::lanes; ++lane) {
            std::size_t const i = k + lane;
            double const lo = t::lower(got, lane), hi = t::upper(got, lane);
            if (exact[i].defined() && !exact[i].in(lo, hi))
                m.note(name, x[i].lo, x[i].hi, x[i].member, y[i].member, lo, hi);
        }
    }
}

/// A pole, or not a number of the set of the reals, if both bounds are the same infinity.
inline oracle::value finite(oracle::value v) {
    if (v.below == v.above && v.below - v.below != 0.0)
        v.below = v.above = sivid::detail::not_a_number;
    return v;
}

/// Until `count` members at which the function is defined were checked: one exact value serves all
/// types. @param exact  of (batch of x, batch of y, i)
template <int Arity, class... I, class Exact, class Function>
misses contained_batches(char const* name, std::size_t count, std::uint64_t seed,
                         Exact const& exact, Function const& f) {
    oracle::inputs in{seed};
    misses m;
    argument x[batch], y[batch];
    oracle::value v[batch];
    while (m.inputs < count) {
        for (auto& a : x) a = random_argument(in, in.mixed());
        for (auto& a : y) a = random_argument(in, in.mixed());
        for (std::size_t i = 0; i < batch; ++i) {
            v[i] = finite(exact(x[i].member, y[i].member));
            if (v[i].defined()) ++m.inputs;
        }
        (check_batch<I, Arity>(m, name, f, x, y, v), ...);
    }
    return m;
}

/// For a function of one argument, and of two.
template <class... I, class Function>
misses contained(char const* name, std::size_t count, std::uint64_t seed, oracle::unary exact,
                 Function const& f) {
    return contained_batches<1, I...>(
        name, count, seed, [exact](double x, double) { return oracle::at(exact, x); }, f);
}
template <class... I, class Function>
misses contained(char const* name, std::size_t count, std::uint64_t seed, oracle::binary exact,
                 Function const& f) {
    return contained_batches<2, I...>(
        name, count, seed, [exact](double x, double y) { return oracle::at(exact, x, y); }, f);
}

/// The traits of the argument of a generic function.
template <class I>
using of = sivid::interval_traits<I>;

/// Every function of the types with an MPFR counterpart, `count` inputs each.
template <class... Is>
std::vector<misses> all_contained(std::size_t count, std::uint64_t seed) {
    std::vector<misses> all;
    auto const one = [&](char const* name, oracle::unary exact, auto const& f) {
        all.push_back(contained<Is...>(name, count, ++seed, exact, f));
    };
    auto const two = [&](char const* name, oracle::binary exact, auto const& f) {
        all.push_back(contained<Is...>(name, count, ++seed, exact, f));
    };
    two("add", mpfr_add, []<class I>(I const& a, I const& b) { return of<I>::add(a, b); });
    two("sub", mpfr_sub, []<class I>(I const& a, I const& b) { return of<I>::sub(a, b); });
    two("mul", mpfr_mul, []<class I>(I const& a, I const& b) { return of<I>::mul(a, b); });
    two("div", mpfr_div, []<class I>(I const& a, I const& b) {
        typename of<I>::mask m{};
        return of<I>::div(a, b, m);
    });
    two("min", mpfr_min, []<class I>(I const& a, I const& b) { return of<I>::min(a, b); });
    two("max", mpfr_max, []<class I>(I const& a, I const& b) { return of<I>::max(a, b); });
    one(
        "sign",
        [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t d) { return mpfr_set_si(r, mpfr_sgn(x), d); },
        []<class I>(I const& a) { return of<I>::sign(a); });
    one("sqr", mpfr_sqr, []<class I>(I const& a) { return of<I>::sqr(a); });
    one("sqrt", mpfr_sqrt, []<class I>(I const& a) {
        typename of<I>::mask m{};
        return of<I>::sqrt(a, m);
    });
    one(
        "abs", [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t d) { return mpfr_abs(r, x, d); },
        []<class I>(I const& a) { return of<I>::abs(a); });
    one("exp", mpfr_exp, []<class I>(I const& a) { return of<I>::exp(a); });
    one("log", mpfr_log, []<class I>(I const& a) {
        typename of<I>::mask m{};
        return of<I>::log(a, m);
    });
    one("sin", mpfr_sin, []<class I>(I const& a) { return of<I>::sin(a); });
    one("cos", mpfr_cos, []<class I>(I const& a) { return of<I>::cos(a); });
    one("tan", mpfr_tan, []<class I>(I const& a) {
        typename of<I>::mask m{};
        return of<I>::tan(a, m);
    });
    one("atan", mpfr_atan, []<class I>(I const& a) { return of<I>::atan(a); });
    one("tanh", mpfr_tanh, []<class I>(I const& a) { return of<I>::tanh(a); });
    if constexpr ((support::has_further_functions<Is> && ...)) {
        two("hypot", mpfr_hypot,
            []<class I>(I const& a, I const& b) { return of<I>::hypot(a, b); });
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
            []<class I>(I const& a, I const& b) {
                typename of<I>::mask m{};
                return of<I>::atan2(a, b, m);
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
            []<class I>(I const& a, I const& b) {
                typename of<I>::mask m{};
                return of<I>::pow(a, b, m);
            });
        two(
            "deadband",
            [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr w, mpfr_rnd_t d) {
                if (mpfr_sgn(w) < 0) {
                    mpfr_set_nan(r);
                    return 0;
                }
                if (mpfr_cmpabs(x, w) <= 0) return mpfr_set_zero(r, 1), 0;
                return mpfr_sgn(x) > 0 ? mpfr_sub(r, x, w, d) : mpfr_add(r, x, w, d);
            },
            []<class I>(I const& a, I const& b) { return of<I>::deadband(a, b); });
        two(
            "saturate below -1",
            [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t d) {
                mpfr_set_si(r, -1, d);
                mpfr_max(r, r, x, d);
                return mpfr_min(r, r, y, d);
            },
            []<class I>(I const& a, I const& b) {
                return of<I>::saturate(a, of<I>::point(-1.0), b);
            });
        two(
            "saturate above 2",
            [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t d) {
                mpfr_max(r, x, y, d);
                return mpfr_cmp_si(r, 2) > 0 ? mpfr_set_si(r, 2, d) : 0;
            },
            []<class I>(I const& a, I const& b) {
                return of<I>::saturate(a, b, of<I>::point(2.0));
            });
        one("expm1", mpfr_expm1, []<class I>(I const& a) { return of<I>::expm1(a); });
        one("log1p", mpfr_log1p, []<class I>(I const& a) {
            typename of<I>::mask m{};
            return of<I>::log1p(a, m);
        });
        one("asin", mpfr_asin, []<class I>(I const& a) {
            typename of<I>::mask m{};
            return of<I>::asin(a, m);
        });
        one("acos", mpfr_acos, []<class I>(I const& a) {
            typename of<I>::mask m{};
            return of<I>::acos(a, m);
        });
        one("sinh", mpfr_sinh, []<class I>(I const& a) { return of<I>::sinh(a); });
        one("cosh", mpfr_cosh, []<class I>(I const& a) { return of<I>::cosh(a); });
        one("asinh", mpfr_asinh, []<class I>(I const& a) { return of<I>::asinh(a); });
        one("acosh", mpfr_acosh, []<class I>(I const& a) {
            typename of<I>::mask m{};
            return of<I>::acosh(a, m);
        });
        one("atanh", mpfr_atanh, []<class I>(I const& a) {
            typename of<I>::mask m{};
            return of<I>::atanh(a, m);
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
            []<class I>(I const& a) {
                typename of<I>::mask m{};
                return of<I>::pown(a, power, m);
            });
    }
    return all;
}

} // namespace laws

#endif
