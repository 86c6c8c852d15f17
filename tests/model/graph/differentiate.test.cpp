// SPDX-License-Identifier: MIT
// Derivatives against difference quotients in 100 digits, at points and over boxes.
#include <sivid/model/graph/differentiate.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;
using support::place;

namespace {

constexpr std::size_t variables = 4; // x0, x1, p0, p1

std::vector<node_id> leaves(graph& g) {
    return {g.leaf(operation::state, 0), g.leaf(operation::state, 1),
            g.leaf(operation::constant, 0), g.leaf(operation::constant, 1)};
}
/// The formula with one variable at a 100-digit value. @throws not_defined, too_large
mp at(support::formula const& f, place const& where, std::size_t variable, mp const& v) {
    return support::values<mp>(
               f,
               [&](operation op, std::size_t i) -> mp {
                   if (op == operation::time) return where.t;
                   if ((op == operation::state ? i : 2 + i) == variable) return v;
                   return op == operation::state ? where.x[i] : where.p[i];
               },
               [](auto const& n, mp const& a, mp const& b) {
                   support::require_defined(n, a, b, true);
               })
        .back();
}
double& coordinate(place& where, std::size_t v) { return v < 2 ? where.x[v] : where.p[v - 2]; }
interval const& side(support::place_box const& b, std::size_t v) {
    return v < 2 ? b.x[v] : b.p[v - 2];
}

/// Slopes between any two points of a box that differ in one variable are in the derivative over
/// the box: this is what the mean-value form rests on, across kinks too.
void slopes(std::uint64_t seed, int formulas, bool smooth) {
    draws d(seed);
    int compared = 0;
    for (int round = 0; round < formulas; ++round) {
        auto const f = support::random_formula(d, 2 + d.below(8), smooth);
        if (f.uses(operation::sign)) continue; // jumps: no derivative
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue;
        auto const gradient = differentiate(g, {*root}, leaves(g));
        for (int sample = 0; sample < 6; ++sample) {
            auto const box = support::random_places(d, 0.5);
            auto const found = support::evaluate(g, gradient[0], box);
            if (found.undefined || support::evaluate(g, {*root}, box).undefined) continue;
            auto where = support::random_place(d, box);
            auto const v = d.below(variables);
            double const a = coordinate(where, v);
            double const b = d.in(side(box, v));
            if (a == b) continue;
            try {
                mp const quotient = (at(f, where, v, b) - at(f, where, v, a)) / (mp(b) - mp(a));
                if (abs(quotient) > 1e25) continue;
                ++compared;
                if (!encloses(found.outputs[v], quotient, 1e-25)) {
                    CAPTURE(round, sample, v, a, b, quotient.str(20), found.outputs[v].lower(),
                            found.outputs[v].upper());
                    CHECK(encloses(found.outputs[v], quotient, 1e-25));
                }
            } catch (support::not_defined const&) {
            } catch (support::too_large const&) {
            }
        }
    }
    CHECK(compared > formulas / 2);
}

} // namespace

TEST_CASE("slopes over boxes are in the derivative, smooth formulas") { slopes(131, 1500, true); }
TEST_CASE("slopes over boxes are in the derivative, across kinks") { slopes(132, 1500, false); }
TEST_CASE("slopes over boxes, longer", "[.long]") {
    for (std::uint64_t seed = 1300; seed < 1330; ++seed) slopes(seed, 3000, seed % 2 == 0);
}

TEST_CASE("derivatives at points agree with central differences") {
    draws d(133);
    int compared = 0;
    for (int round = 0; round < 1000; ++round) {
        auto const f = support::random_formula(d, 2 + d.below(8), true);
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue;
        auto const gradient = differentiate(g, {*root}, leaves(g));
        auto box = support::random_places(d, 0);
        auto const where = support::random_place(d, box);
        auto const found = support::evaluate(g, gradient[0], box);
        if (found.undefined) continue;
        for (std::size_t v = 0; v < variables; ++v) {
            try {
                mp const x = side(box, v).lower();
                mp const h = 1e-16;
                mp const quotient = (at(f, where, v, x + h) - at(f, where, v, x - h)) / (2 * h);
                if (abs(quotient) > 1e6 || width(found.outputs[v]) > 1e-6) continue;
                ++compared;
                // The difference is off by h^2 times a third derivative.
                bool const good = encloses(found.outputs[v], quotient, 1e-20);
                if (!good) {
                    CAPTURE(round, v, quotient.str(20), found.outputs[v].lower(),
                            found.outputs[v].upper());
                    CHECK(good);
                }
            } catch (support::not_defined const&) {
            } catch (support::too_large const&) {
            }
        }
    }
    CHECK(compared > 1000);
}

TEST_CASE("generalised derivatives at a kink are the whole set") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    support::place_box origin;
    origin.x[0] = interval(0.0);
    origin.x[1] = interval(0.0);
    auto const range = [&](expression const& e, support::place_box const& where) {
        auto const d = differentiate(g, {e.in(g)}, {g.leaf(operation::state, 0)})[0][0];
        return support::evaluate(g, {d}, where).outputs[0];
    };
    CHECK(range(abs(x), origin).lower() <= -1);
    CHECK(range(abs(x), origin).upper() >= 1);
    CHECK(range(max(x, 0), origin).lower() <= 0);
    CHECK(range(max(x, 0), origin).upper() >= 1);
    CHECK(range(min(x, y), origin).lower() <= 0);
    CHECK(range(min(x, y), origin).upper() >= 1);
    CHECK(range(min(2 * x, 3 * x), origin).lower() <= 2);
    CHECK(range(min(2 * x, 3 * x), origin).upper() >= 3);
    auto away = origin;
    away.x[0] = support::between(1, 2);
    CHECK(range(abs(x), away).lower() == 1);
    CHECK(range(abs(-x), away).upper() == 1);
    CHECK(range(min(x, y), away).upper() == 0);
    CHECK(range(max(x, y), away).lower() == 1);
    CHECK(range(saturate(x, -3, 3), away).lower() == 1);
    CHECK(range(deadband(x, 4), away).upper() == 0);
}

TEST_CASE("structural zeros of a Jacobian are the literal zero") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    auto const d = differentiate(g, {sin(x).in(g), (x * y).in(g)},
                                 {g.leaf(operation::state, 0), g.leaf(operation::state, 1)});
    CHECK_FALSE(g.is(d[0][0], 0));
    CHECK(g.is(d[0][1], 0));
    CHECK(d[1][0] == y.in(g));
    CHECK(d[1][1] == x.in(g));
}
