// SPDX-License-Identifier: MIT
// What series leave out, at orders so low that it is most of the value: each operation and random
// formulas on states that use their own tails to the ends, in 100 digits.
#include <sivid/model/series/detail/series_tail.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/sweep.hpp"

#include <sivid/model/series/taylor_arithmetic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

constexpr std::size_t most_orders = 6;
using ps = support::power_series<most_orders>;

struct given {
    double t = 0;
    std::array<double, 2> p{};
    std::array<std::array<interval, most_orders>, 2> x;
    std::array<double, 2> rho{};
};
given random_given(draws& d, double radius) {
    given g;
    g.t = d.uniform(0, 2);
    for (std::size_t i = 0; i < 2; ++i) {
        g.p[i] = d.uniform(-2, 2);
        for (auto& c : g.x[i]) c = d.interval(-2, 2, radius);
        g.rho[i] = d.below(3) == 0 ? 0 : std::pow(10.0, d.uniform(-4, -1));
    }
    return g;
}

/// Bounds of the tail of a formula's only output; not finite where nothing is known.
template <class T>
struct bounded {
    tape program;
    series<T> s;
    series_tail<T> tail;

    bounded(graph const& g, node_id root, given const& where, std::size_t orders, double h)
        : program(g, {root}), s(program, most_orders), tail(program, most_orders) {
        using A = arithmetic_of<T>;
        using C = typename T::scalar;
        s.set_parameters(std::vector<T>{A::point(where.p[0]), A::point(where.p[1])});
        s.start(A::point(where.t));
        auto const coefficient = [&](std::size_t i, std::size_t k) {
            return A::enclose(where.x[i][k]);
        };
        for (std::size_t k = 0; k < orders; ++k) s.advance(k, coefficient, coefficient);
        if (!usable()) return;
        tail.measure(s, orders, C(h), true);
        tail.propagate({C(where.rho[0]), C(where.rho[1])},
                       [&](std::size_t i) { return coefficient(i, 1); });
    }
    [[nodiscard]] bool usable() const {
        using side_by_side = typename T::side_by_side;
        return tail.covers() && !side_by_side::any(s.undefined()) &&
               !side_by_side::any(s.kinked()) && program.output_varies(0);
    }
};

/// How many values were compared; `sharp` becomes the largest share of a bound that was used.
int compare(draws& d, support::formula const& f, given const& where, double& sharp) {
    using T = taylor_model<double>;
    graph g;
    auto const root = support::recorded_if_defined(f, g);
    if (!root) return 0;
    std::size_t const orders = 1 + d.below(most_orders - 1);
    double const h = std::pow(10.0, d.uniform(-2.5, 0));
    bounded<T> const b(g, *root, where, orders, h);
    if (!b.usable()) return 0;
    double const bound = b.tail.tail(b.program.output(0));
    if (!std::isfinite(bound)) return 0;
    int compared = 0;
    for (int round = 0; round < 4; ++round) {
        std::array<ps, 2> x; // the coefficients that the series knows
        std::array<double, 2> end{};
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t k = 0; k < orders; ++k) x[i].c[k] = d.in(where.x[i][k]);
            end[i] = d.coin() ? where.rho[i] : -where.rho[i];
        }
        double const s = d.coin() ? h : h * d.uniform(0.1, 1);
        mp const share = pow(mp(s) / mp(h), static_cast<int>(orders));
        try {
            auto const check = [](support::formula::term const& n, auto const& u, auto const& v) {
                if constexpr (std::is_same_v<std::decay_t<decltype(u)>, mp>) {
                    support::require_defined(n, u, v, true);
                } else {
                    support::require_defined(n, u.c[0], v.c[0], true);
                }
            };
            auto const known = support::values<ps>(
                                   f,
                                   [&](operation op, std::size_t i) -> ps {
                                       ps q;
                                       if (op == operation::constant) q.c[0] = where.p[i];
                                       if (op == operation::time) {
                                           q.c[0] = where.t;
                                           q.c[1] = 1;
                                       }
                                       return op == operation::state ? x[i] : q;
                                   },
                                   check)
                                   .back();
            mp polynomial = 0;
            for (std::size_t k = orders; k-- > 0;) polynomial = polynomial * mp(s) + known.c[k];
            mp const value = support::values<mp>(
                                 f,
                                 [&](operation op, std::size_t i) -> mp {
                                     if (op == operation::constant) return where.p[i];
                                     if (op == operation::time) return mp(where.t) + mp(s);
                                     mp sum = mp(end[i]) * share;
                                     mp power = 1;
                                     for (std::size_t k = 0; k < orders; ++k) {
                                         sum += x[i].c[k] * power;
                                         power *= s;
                                     }
                                     return sum;
                                 },
                                 check)
                                 .back();
            mp const tail = abs(value - polynomial);
            ++compared;
            if (bound > 0) {
                sharp = std::max(sharp, static_cast<double>(tail / (mp(bound) * share)));
            }
            if (tail > mp(bound) * share + mp(1e-30) * (1 + abs(value))) {
                CAPTURE(orders, h, s, bound, tail.str(20), value.str(20));
                CHECK(tail <= mp(bound) * share);
            }
        } catch (support::not_defined const&) {
            // Somewhere in terms that the result does not need.
        } catch (support::too_large const&) {
        }
    }
    return compared;
}

} // namespace

TEST_CASE("tails far from 0, where functions hardly change and their arguments do") {
    draws d(414);
    for (auto const op : {operation::tanh, operation::atan, operation::exp}) {
        CAPTURE(std::string(name(op)));
        int compared = 0;
        double sharp = 0;
        support::for_each_use(op, {3, 4, 7, -1, -2}, [&](support::formula const& f) {
            for (int draw = 0; draw < support::swept(120, 400); ++draw) {
                auto where = random_given(d, draw % 3 == 0 ? 0.05 : 0);
                double const fast = d.uniform(0.1, 20); // all of [0, h] stays on one side
                for (auto& x : where.x) {
                    double const away = d.uniform(4, 25);
                    x[0] = x[0] + interval(op == operation::exp || d.coin() ? -away : away);
                    x[1] = x[1] * interval(fast);
                }
                compared += compare(d, f, where, sharp);
            }
        });
        CHECK(compared > support::swept(150, 500));
        CHECK(sharp > 0.5);
    }
}

TEST_CASE(
    "tails of a saturated function: as small as the function's slope, however long the step") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    given where;
    where.x[0] = {interval(1e4), interval(1e3), interval(-500.0)}; // from 1e4 to 8.5e3 in [0, 3]
    where.x[1] = where.x[0];
    where.rho = {1e-3, 1e-3};
    for (auto const& e : {tanh(x), exp(-x)}) {
        bounded<taylor_model<double>> const b(g, e.in(g), where, 3, 3);
        REQUIRE(b.usable());
        CHECK(b.tail.tail(b.program.output(0)) < 1e-280);
    }
}

TEST_CASE("tails of each operation, at every order") {
    draws d(411);
    for (int i = static_cast<int>(operation::neg); i <= static_cast<int>(operation::max); ++i) {
        auto const op = static_cast<operation>(i);
        if (op == operation::tan) continue;
        CAPTURE(std::string(name(op)));
        int compared = 0;
        double sharp = 0;
        support::for_each_use(op, {3, 4, 7, -1, -2}, [&](support::formula const& f) {
            for (double const radius : {0.0, 0.0, 0.05}) {
                for (int draw = 0; draw < support::swept(8, 25); ++draw)
                    compared += compare(d, f, random_given(d, radius), sharp);
            }
        });
        CHECK(compared > support::swept(30, 100));
        // The bounds are met: an error of a factor 2 would be seen. (A sign has no tail.)
        if (op != operation::sign) CHECK(sharp > 0.5);
    }
}

TEST_CASE("tails of composed formulas") {
    draws d(412);
    int compared = 0;
    double sharp = 0;
    for (int round = 0; round < 3000; ++round) {
        auto const f = support::random_formula(d, 2 + d.below(5), d.coin());
        compared += compare(d, f, random_given(d, round % 3 == 0 ? 0.1 : 0.0), sharp);
    }
    CHECK(compared > 1500);
}

TEST_CASE("tails: nothing is known where a step may leave the domain, or meet a kink") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    given where;
    where.x[0] = {interval(1.0), interval(-4.0)};
    where.x[1] = where.x[0];
    auto const finite = [&](expression const& e, double h, double rho) {
        where.rho = {rho, rho};
        bounded<taylor_model<double>> const b(g, e.in(g), where, 2, h);
        return b.usable() && std::isfinite(b.tail.tail(b.program.output(0)));
    };
    for (auto const& e : {1 / x, sqrt(x), log(x), abs(x), max(x, 0), min(x, 0)}) {
        CHECK(finite(e, 0.1, 1e-3));
        CHECK_FALSE(finite(e, 0.25, 1e-3)); // x reaches 0
        CHECK_FALSE(finite(e, 0.1, 0.7));   // its tail does
        CHECK_FALSE(finite(e, 0.1, NAN));
    }
    for (auto const& e : {sin(x), cos(x), exp(x), atan(x), tanh(x), x * x, sqr(x), pown(x, 3)}) {
        CHECK(finite(e, 0.1, 1e-3));
        CHECK_FALSE(finite(e, 0.1, NAN));
    }
    CHECK_FALSE(finite(tan(x), 0.1, 0));
}

TEST_CASE("tails: lanes are those of single models") {
    draws d(413);
    using C = lanes<8>;
    int compared = 0;
    for (int round = 0; round < 150; ++round) {
        auto const f = support::random_formula(d, 5, d.coin());
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue;
        auto const where = random_given(d, 0);
        bounded<taylor_model<double>> const one(g, *root, where, 4, 0.05);
        bounded<taylor_model<C>> const eight(g, *root, where, 4, 0.05);
        if (!one.usable() || !eight.usable()) continue;
        double const a = one.tail.tail(one.program.output(0));
        double const b = eight.tail.tail(eight.program.output(0))[3];
        CAPTURE(a, b);
        CHECK(std::isfinite(a) == std::isfinite(b));
        if (!std::isfinite(a)) continue;
        // Single models bound their roundings otherwise, and radii are part of the sizes.
        CHECK(std::abs(a - b) <= 1e-8 * a + 1e-12);
        ++compared;
    }
    CHECK(compared > 30);
}
