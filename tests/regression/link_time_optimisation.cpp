// SPDX-License-Identifier: MIT
// g++ 12 with -flto lost sin and cos of packs: `wave(bounds const&)` only handed members of its
// argument on, by value, to a function that turned out to be free of side effects while linking;
// g++ then took the argument itself for unread and dropped the stores to it. Every function of
// every type at run-time points against the C library's long double; built and run with link-time
// optimisation by link_time_optimisation.cmake.
#include <sivid/number/guard.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack.hpp>

#include <cmath>
#include <cstdio>

using namespace sivid;

namespace {

int missed = 0;
long checked = 0;

/// f over t and g in long double, at 200 points of [from, to] and on the intervals between them.
template <class T, class F, class G>
[[gnu::noinline]] void check(char const* type, char const* name, double from, double to, F const& f,
                             G const& g) {
    int here = 0;
    double const step = (to - from) / 200;
    for (int i = 0; i < 200; ++i) {
        double const x = detail::opaque(from + step * i), y = detail::opaque(from + step * (i + 1));
        for (double const end : {x, y}) {
            auto const result = f(T::bounds(x, end));
            for (double const t : {x, end}) {
                long double const exact = g(static_cast<long double>(t));
                for (std::size_t lane = 0; lane < T::lanes; ++lane, ++checked)
                    if (!(T::lower(result, lane) <= exact && exact <= T::upper(result, lane)) &&
                        here++ < 2)
                        std::printf("  %s of %s: f(%.17g) = %.21Lg is not in [%.17g, %.17g]\n",
                                    name, type, t, exact, T::lower(result, lane),
                                    T::upper(result, lane));
            }
        }
    }
    missed += here;
}

template <class T>
[[gnu::noinline]] void check_all(char const* type) {
    using I = decltype(T::point(0.0));
    typename T::mask cut{};
    using L = long double;
#define SIVID_CHECK(name, from, to, call, exact)                                                   \
    check<T>(                                                                                      \
        type, name, from, to, [&](I const& x) { return call; }, [](L x) { return exact; })
    SIVID_CHECK("exp", -20.3, 20.7, T::exp(x), expl(x));
    SIVID_CHECK("log", 0.01, 90.1, T::log(x, cut), logl(x));
    SIVID_CHECK("sin", 0.01, 6.3, T::sin(x), sinl(x));
    SIVID_CHECK("cos", 0.01, 6.3, T::cos(x), cosl(x));
    SIVID_CHECK("tan", -1.5, 1.5, T::tan(x, cut), tanl(x));
    SIVID_CHECK("atan", -9.1, 9.3, T::atan(x), atanl(x));
    SIVID_CHECK("tanh", -3.1, 3.3, T::tanh(x), tanhl(x));
    if constexpr (requires(I const& x) { T::expm1(x); }) { // packs have what models are made of
        SIVID_CHECK("expm1", -3.3, 3.7, T::expm1(x), expm1l(x));
        SIVID_CHECK("log1p", -0.99, 90.1, T::log1p(x, cut), log1pl(x));
        SIVID_CHECK("asin", -0.99, 0.99, T::asin(x, cut), asinl(x));
        SIVID_CHECK("acos", -0.99, 0.99, T::acos(x, cut), acosl(x));
        SIVID_CHECK("sinh", -9.1, 9.3, T::sinh(x), sinhl(x));
        SIVID_CHECK("cosh", -9.1, 9.3, T::cosh(x), coshl(x));
        SIVID_CHECK("asinh", -9.1, 9.3, T::asinh(x), asinhl(x));
        SIVID_CHECK("acosh", 1.01, 9.3, T::acosh(x, cut), acoshl(x));
        SIVID_CHECK("atanh", -0.99, 0.99, T::atanh(x, cut), atanhl(x));
        SIVID_CHECK("pow", 0.01, 9.3, T::pow(x, T::point(0.3), cut), powl(x, static_cast<L>(0.3)));
        SIVID_CHECK("atan2", 0.01, 9.3, T::atan2(x, T::point(0.3), cut),
                    atan2l(x, static_cast<L>(0.3)));
        SIVID_CHECK("hypot", 0.01, 9.3, T::hypot(x, T::point(0.3)), hypotl(x, static_cast<L>(0.3)));
    }
    SIVID_CHECK("sqrt", 0.01, 9.3, T::sqrt(x, cut), sqrtl(x));
    SIVID_CHECK("pown", 0.01, 9.3, T::pown(x, 5, cut), x * x * x * x * x);
    SIVID_CHECK("pown", 0.01, 9.3, T::pown(x, -3, cut), 1 / (x * x * x));
    SIVID_CHECK("add", -9.1, 9.3, T::add(x, T::point(0.3)), x + static_cast<L>(0.3));
    SIVID_CHECK("mul", -9.1, 9.3, T::mul(x, T::point(0.3)), x * static_cast<L>(0.3));
    SIVID_CHECK("div", -9.1, 9.3, T::div(x, T::point(0.3), cut), x / static_cast<L>(0.3));
#undef SIVID_CHECK
}

} // namespace

int main() {
    if (!pack_supported()) return 77;
    check_all<interval_traits<interval>>("interval");
    check_all<interval_traits<pack<1>>>("pack<1>");
    check_all<interval_traits<pack<2>>>("pack<2>");
    check_all<interval_traits<pack<4>>>("pack<4>");
    check_all<interval_traits<pack<8>>>("pack<8>");
    try {
        require_sound_environment();
        if (missed > 0) std::printf("the guard accepts what misses\n");
    } catch (unsound_environment const& e) {
        ++missed;
        std::printf("refused: %s\n", e.what());
    }
    std::printf("%ld checks, %d missed\n", checked, missed);
    return missed == 0 && checked > 100'000 ? 0 : 1;
}
