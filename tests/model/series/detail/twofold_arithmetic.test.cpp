// SPDX-License-Identifier: MIT
// Recurrences in twice the digits against power series of 100 digits that are computed otherwise.
#include "support/catch.hpp"
#include "support/formulas.hpp"

#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/detail/twofold_arithmetic.hpp>
#include <sivid/model/series/series.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

constexpr std::size_t K = 7;
using ps = support::power_series<K>;

mp middle(twofold const& a) { return mp(a.head()) + mp(a.tail()); }
bool holds(twofold const& a, mp const& x) {
    if (!std::isfinite(a.radius())) return true;
    return abs(x - middle(a)) <= mp(a.radius()) + 1e-38 * (1 + abs(x));
}

/// Coefficients of the states, parameters and time, with tails and radii.
struct given {
    twofold t;
    std::vector<twofold> p;
    std::array<std::array<twofold, K + 1>, 2> x;
};
twofold draw(draws& d, double radius) {
    double const head = d.uniform(-2, 2);
    return twofold(head, head * d.uniform(-1, 1) * 1e-16, d.coin() ? radius : 0);
}
mp member(draws& d, twofold const& a) {
    return middle(a) + mp(a.radius()) * (static_cast<int>(d.below(3)) - 1);
}

struct tally {
    int compared = 0;
    int sharp = 0; ///< with 28 digits or more
};

tally compare(draws& d, support::formula const& f, double radius) {
    tally result;
    graph g;
    auto const root = support::recorded_if_defined(f, g);
    if (!root) return result;
    tape const program(g, {*root});
    given in;
    in.t = draw(d, radius);
    for (std::size_t i = 0; i < 2; ++i) {
        in.p.push_back(draw(d, radius));
        for (auto& c : in.x[i]) c = draw(d, radius);
    }
    series<twofold> s(program, K);
    s.set_parameters(in.p);
    s.start(in.t);
    auto const coefficient = [&](std::size_t i, std::size_t k) { return in.x[i][k]; };
    for (std::size_t k = 0; k <= K; ++k) s.advance(k, coefficient, coefficient);
    if (s.undefined() || s.kinked()) return result;
    for (int round = 0; round < 2; ++round) {
        ps t = member(d, in.t);
        t.c[1] = 1;
        std::array<ps, 2> p, x;
        for (std::size_t i = 0; i < 2; ++i) {
            p[i] = member(d, in.p[i]);
            for (std::size_t k = 0; k <= K; ++k) x[i].c[k] = member(d, in.x[i][k]);
        }
        try {
            auto const exact =
                support::values<ps>(
                    f,
                    [&](operation op, std::size_t i) {
                        return op == operation::time ? t : op == operation::state ? x[i] : p[i];
                    },
                    support::require_smooth<ps>)
                    .back();
            for (std::size_t k = 0; k <= K; ++k) {
                if (abs(exact.c[k]) > 1e6) break;
                bool const stored = k == 0 || program.output_varies(0);
                twofold const c = stored ? s.output(0, k) : twofold(0.0);
                CAPTURE(k, exact.c[k].str(25), c.head(), c.tail(), c.radius());
                REQUIRE(holds(c, exact.c[k]));
                ++result.compared;
                result.sharp += c.radius() <= 1e-28 * (1 + std::abs(c.head())) ? 1 : 0;
            }
        } catch (support::not_defined const&) {
        } catch (support::too_large const&) {
        }
    }
    return result;
}

} // namespace

TEST_CASE("series in twice the digits: each operation") {
    draws d(171);
    for (int i = static_cast<int>(operation::neg); i <= static_cast<int>(operation::max); ++i) {
        auto const op = static_cast<operation>(i);
        tally all;
        support::for_each_use(op, {3, 4, -2}, [&](support::formula const& f) {
            for (int draw = 0; draw < 12; ++draw) {
                auto const found = compare(d, f, draw < 8 ? 0 : 1e-3);
                all.compared += found.compared;
                all.sharp += found.sharp;
            }
        });
        CAPTURE(std::string(name(op)), all.compared, all.sharp);
        CHECK(all.compared > 100);
        bool const elementary = op == operation::exp || op == operation::log ||
                                op == operation::sin || op == operation::cos ||
                                op == operation::tan || op == operation::atan ||
                                op == operation::tanh;
        if (!elementary) CHECK(2 * all.sharp > all.compared);
    }
}

TEST_CASE("series in twice the digits: composed formulas") {
    draws d(172);
    int compared = 0;
    for (int round = 0; round < 600; ++round) {
        auto const f = support::random_formula(d, 2 + d.below(6), d.coin());
        compared += compare(d, f, round % 3 == 0 ? 1e-3 : 0.0).compared;
    }
    CHECK(compared > 1500);
}

TEST_CASE("kinks, jumps and domains in twice the digits") {
    using A = arithmetic_of<twofold>;
    twofold const about_zero(0.0, 0.0, 1.0), low(-2.0), high(2.0);
    CHECK(A::sign_of(about_zero).neither);
    CHECK(A::sign_of(low).negative);
    CHECK(A::sign_of(high).positive);
    CHECK(contains(A::sign(about_zero).bounds(), -1.0));
    CHECK(contains(A::sign(about_zero).bounds(), 1.0));
    CHECK(A::abs(low).head() == 2);
    CHECK(contains(A::abs(about_zero).bounds(), 0.0));
    CHECK(contains(A::abs(about_zero).bounds(), 1.0));
    CHECK(A::min(low, high).head() == -2);
    CHECK(A::max(low, high).head() == 2);
    CHECK(contains(A::max(about_zero, twofold(0.5)).bounds(), 0.5));
    CHECK(contains(A::max(about_zero, twofold(0.5)).bounds(), 1.0));
    bool undefined = false;
    (void)A::log(about_zero, undefined);
    CHECK(undefined);
}
