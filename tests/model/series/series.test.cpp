// SPDX-License-Identifier: MIT
// Each recurrence, order by order, against power series in 100 digits that are computed otherwise.
#include <sivid/model/series/series.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"
#include "support/sweep.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <string>

using namespace sivid;
using support::between;
using support::draws;
using support::encloses;
using support::mp;

namespace {

constexpr std::size_t K = 9;
using ps = support::power_series<K>;

/// Coefficients of the two states (which serve as inputs too), as boxes, and what t, p are.
struct given {
    interval t;
    box p = box(2);
    std::array<std::array<interval, K + 1>, 2> x;
};
given random_given(draws& d, double radius) {
    given g;
    g.t = d.interval(0, 2, radius);
    for (std::size_t i = 0; i < 2; ++i) {
        g.p[i] = d.interval(-2, 2, radius);
        for (auto& c : g.x[i]) c = d.interval(-2, 2, radius);
    }
    return g;
}
/// A member of the given boxes, as power series.
struct member {
    ps t;
    std::array<ps, 2> p, x;
};
member random_member(draws& d, given const& g) {
    member m;
    m.t.c[0] = d.in(g.t);
    m.t.c[1] = 1;
    for (std::size_t i = 0; i < 2; ++i) {
        m.p[i] = d.in(g.p[i]);
        for (std::size_t k = 0; k <= K; ++k) m.x[i].c[k] = d.in(g.x[i][k]);
    }
    return m;
}
series<interval> expanded(tape const& program, given const& g) {
    series<interval> s(program, K);
    s.set_parameters(g.p);
    s.start(g.t);
    auto const coefficient = [&g](std::size_t i, std::size_t k) { return g.x[i][k]; };
    for (std::size_t k = 0; k <= K; ++k) s.advance(k, coefficient, coefficient);
    return s;
}

/// @throws not_defined, too_large
ps exact_series(support::formula const& f, member const& m) {
    return support::values<ps>(
               f,
               [&](operation op, std::size_t i) -> ps {
                   return op == operation::time ? m.t : op == operation::state ? m.x[i] : m.p[i];
               },
               support::require_smooth<ps>)
        .back();
}

/// How many coefficients were compared.
int compare(draws& d, support::formula const& f, double radius) {
    graph g;
    auto const root = support::recorded_if_defined(f, g);
    if (!root) return 0;
    tape const program(g, {*root});
    auto const where = random_given(d, radius);
    auto const s = expanded(program, where);
    if (s.undefined() || s.kinked()) return 0;
    int compared = 0;
    for (int round = 0; round < 3; ++round) {
        try {
            auto const exact = exact_series(f, random_member(d, where));
            for (std::size_t k = 0; k <= K; ++k) {
                if (abs(exact.c[k]) > 1e30) break;
                // A node that does not vary has zeros above order 0, which the tape may not store.
                bool const stored = k == 0 || program.output_varies(0);
                interval const c = stored ? s.output(0, k) : interval(0.0);
                ++compared;
                // 100 digits; in composed formulas some 40 of them cancel.
                if (!encloses(c, exact.c[k], 1e-28)) {
                    CAPTURE(k, exact.c[k].str(20), c.lower(), c.upper());
                    CHECK(encloses(c, exact.c[k], 1e-28));
                }
            }
        } catch (support::not_defined const&) {
        } catch (support::too_large const&) {
        }
    }
    return compared;
}

} // namespace

TEST_CASE("each operation's recurrence, varying, constant and literal operands") {
    draws d(161);
    for (int i = static_cast<int>(operation::neg); i <= static_cast<int>(operation::max); ++i) {
        auto const op = static_cast<operation>(i);
        CAPTURE(std::string(name(op)));
        int compared = 0;
        support::for_each_use(op, {3, 4, 7, -1, -2, -5}, [&](support::formula const& f) {
            for (double const radius : {0.0, 0.0, 0.05, 0.3}) {
                for (int draw = 0; draw < 6; ++draw) compared += compare(d, f, radius);
            }
        });
        CHECK(compared > 200);
    }
}

TEST_CASE("large powers follow from half powers, also of what changes its sign") {
    draws d(171);
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    for (int const n : {3, 7, 8, 9, 10, 11, 12, 15, 24, 33}) {
        tape const program(g, {pown(x, n).in(g)});
        for (double const radius : {0.0, 0.01, 0.5}) {
            auto where = random_given(d, radius);
            if (n % 3 == 0) where.x[0][0] = d.interval(-0.2, 0.2, radius);
            auto const s = expanded(program, where);
            auto const direct = pown(where.x[0][0], n); // sharp: of even powers never below 0
            CHECK(s.output(0, 0).lower() == direct.lower());
            CHECK(s.output(0, 0).upper() == direct.upper());
            for (int sample = 0; sample < 5; ++sample) {
                auto const m = random_member(d, where);
                auto exact = m.x[0];
                for (int k = 1; k < n; ++k) exact = exact * m.x[0];
                for (std::size_t k = 0; k <= K; ++k) {
                    CAPTURE(n, radius, k);
                    REQUIRE(encloses(s.output(0, k), exact.c[k], 1e-28));
                    if (radius == 0) CHECK(rad(s.output(0, k)) <= 1e-9 * (1 + mag(s.output(0, k))));
                }
            }
        }
    }
}

TEST_CASE("recurrences of composed formulas") {
    draws d(162);
    int compared = 0;
    for (int round = 0; round < support::swept(400, 1200); ++round) {
        auto const f = support::random_formula(d, 2 + d.below(7), d.coin());
        compared += compare(d, f, round % 3 == 0 ? 0.2 : 0.0);
    }
    CHECK(compared > support::swept(1000, 3000));
}

TEST_CASE("recurrences of composed formulas, longer", "[.long]") {
    for (std::uint64_t seed = 1600; seed < 1630; ++seed) {
        draws d(seed);
        int compared = 0;
        for (int round = 0; round < 3000; ++round) {
            compared += compare(d, support::random_formula(d, 2 + d.below(10), d.coin()),
                                round % 3 == 0 ? 0.2 : 0.0);
        }
        CHECK(compared > 3000);
    }
}

TEST_CASE("coefficients at points are tight") {
    // exp(sin t) + sqrt(1 + t^2) at t = 0.5: closed enough to say that widths are a few ulp.
    graph g;
    expression const t(g, g.leaf(operation::time, 0));
    tape const program(g, {(exp(sin(t)) + sqrt(1 + sqr(t)) + atan(t) + log(2 + t)).in(g)});
    given where;
    where.t = interval(0.5);
    auto const s = expanded(program, where);
    for (std::size_t k = 0; k <= K; ++k) {
        CAPTURE(k);
        CHECK(width(s.output(0, k)) < 1e-13);
    }
}

TEST_CASE("a function outside its domain is reported, at any order and for parameters") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const p(g, g.leaf(operation::constant, 0));
    given where;
    for (auto& c : where.x[0]) c = interval(1.0);
    where.x[0][0] = between(-1, 1);
    where.p[0] = between(-1, 1);
    auto const undefined = [&](expression const& e) {
        tape const program(g, {e.in(g)});
        return expanded(program, where).undefined();
    };
    CHECK(undefined(log(x)));
    CHECK(undefined(sqrt(x)));
    CHECK(undefined(1 / x));
    CHECK(undefined(x / p));
    CHECK(undefined(sqrt(p) * x));
    CHECK(undefined(log(p) + x));
    CHECK_FALSE(undefined(exp(x) / (2 + p)));
    where.x[0][0] = between(0, 1); // sqrt is defined at 0: its derivative is not, a kink
    CHECK_FALSE(undefined(sqrt(x)));
    // What an earlier expansion reported is forgotten.
    tape const program(g, {log(x).in(g)});
    series<interval> s(program, 1);
    s.set_parameters(where.p);
    auto const bad = [](std::size_t, std::size_t) { return between(-1, 1); };
    auto const good = [](std::size_t, std::size_t) { return between(1, 2); };
    s.start(interval(0.0));
    s.advance(0, bad, bad);
    CHECK(s.undefined());
    s.start(interval(0.0));
    s.advance(0, good, good);
    CHECK_FALSE(s.undefined());
}

TEST_CASE("kinks and jumps are reported") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    expression const p(g, g.leaf(operation::constant, 0));
    given where;
    for (auto& c : where.x[0]) c = interval(1.0);
    for (auto& c : where.x[1]) c = interval(1.0);
    where.x[0][0] = between(-1, 1);
    where.x[1][0] = between(2, 3);
    where.p[0] = between(-1, 1);
    auto const kinked = [&](expression const& e) {
        tape const program(g, {e.in(g)});
        return expanded(program, where).kinked();
    };
    auto const jumped = [&](expression const& e) {
        tape const program(g, {e.in(g)});
        return expanded(program, where).jumped();
    };
    CHECK(kinked(abs(x)));
    CHECK(kinked(max(x, 0)));
    CHECK(kinked(min(x, y - 2.5)));
    CHECK(kinked(sqrt(abs(x))));
    CHECK(kinked(sqrt(sqr(x))));
    CHECK_FALSE(kinked(sqrt(y)));
    CHECK_FALSE(kinked(abs(y)));
    CHECK_FALSE(kinked(min(x, y)));
    CHECK_FALSE(jumped(abs(x)));
    CHECK(jumped(sign(x)));
    CHECK_FALSE(jumped(sign(y)));
    CHECK(jumped(sign(p) + x)); // a parameter may sit on the jump as well
    CHECK(jumped(sign(x - p) * y));
}

TEST_CASE("series of doubles follow the enclosures") {
    draws d(163);
    int compared = 0;
    for (int round = 0; round < 300; ++round) {
        auto const f = support::random_formula(d, 5, true);
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue;
        tape const program(g, {*root});
        auto const where = random_given(d, 0);
        auto const proved = expanded(program, where);
        if (proved.undefined() || proved.kinked() || !program.output_varies(0)) continue;
        series<double> s(program, K);
        s.set_parameters(std::vector<double>{where.p[0].lower(), where.p[1].lower()});
        s.start(where.t.lower());
        auto const x = [&](std::size_t i, std::size_t k) { return where.x[i][k].lower(); };
        for (std::size_t k = 0; k <= K; ++k) {
            s.advance(k, x, x);
            auto const e = proved.output(0, k);
            if (!(width(e) < 1e-9) || !(mag(e) < 1e6)) continue;
            ++compared;
            CHECK(std::abs(s.output(0, k) - mid(e)) <= 1e-6 * (1 + mag(e)));
        }
    }
    CHECK(compared > 200);
}
