// SPDX-License-Identifier: MIT
// Every rewriting rule, by random formulas before and after: the graph's interval value over a box
// contains the formula's exact value at each point of the box; where the formula is undefined the
// graph says so.
#include <sivid/model/graph/graph.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"
#include "support/sweep.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;

namespace {

void sweep(std::uint64_t seed, int formulas) {
    draws d(seed);
    int compared = 0;
    int undefined_found = 0;
    for (int round = 0; round < formulas; ++round) {
        auto const f = support::random_formula(d, 2 + d.below(10), false);
        graph g;
        auto const root = support::recorded_if_defined(f, g);
        if (!root) continue; // a constant without a value, refused while it is written
        for (int sample = 0; sample < 8; ++sample) {
            auto const where = support::random_places(d, 0.5);
            auto const found = support::evaluate(g, {*root}, where);
            for (int member = 0; member < 4; ++member) {
                try {
                    auto const exact = support::exact_value(f, support::random_place(d, where));
                    ++compared;
                    if (!encloses(found.outputs[0], exact)) {
                        CAPTURE(round, sample, found.outputs[0].lower(), found.outputs[0].upper());
                        CHECK(encloses(found.outputs[0], exact));
                    }
                } catch (support::not_defined const&) {
                    ++undefined_found;
                    // The formula may be undefined in a term that its result does not use.
                    continue;
                } catch (support::too_large const&) {
                }
            }
        }
    }
    CHECK(compared > 8 * formulas);
    CHECK(undefined_found > 0);
}

} // namespace

TEST_CASE("rewritten formulas enclose what was written") { sweep(101, 1500); }
TEST_CASE("rewritten formulas enclose what was written, longer", "[.long]") {
    for (std::uint64_t seed = 1000; seed < 1000 + support::swept(12U, 40U); ++seed)
        sweep(seed, 3000);
}

TEST_CASE("rewriting never enlarges the domain") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    support::place_box where;
    where.x[0] = support::between(-1, 1);
    where.x[1] = interval(2.0);
    auto const undefined = [&](expression const& e) {
        return support::evaluate(g, {e.in(g)}, where).undefined;
    };
    CHECK(undefined(0 * log(x)));
    CHECK(undefined(log(x) * 0));
    CHECK(undefined(sqrt(x) - sqrt(x)));
    CHECK(undefined(0 * (y / x)));
    CHECK(undefined(0 / x));
    CHECK(undefined(x / x));
    CHECK(undefined(pown(log(x), 0)));
    CHECK(undefined(pown(pown(log(x), 0), 0)));
    CHECK(undefined(pown(-sqrt(x), 0) - pown(-sqrt(x), 0)));
    CHECK(undefined(pown(x, -2) * 0));
    CHECK(undefined(abs(sqrt(x))));
    CHECK(undefined(min(log(x), log(x))));
    CHECK(undefined(min(max(sqrt(x), 0.5), 0.5)));
    CHECK(undefined(0 * tan(2 * x)));
    CHECK_FALSE(undefined(0 * x));
    CHECK_FALSE(undefined(x - x));
    CHECK_FALSE(undefined(pown(x, 0)));
    CHECK_FALSE(undefined(0 * exp(x) + atan(x) * tanh(x)));
    CHECK_FALSE(undefined(sqrt(y)));
}

TEST_CASE("what rewriting is for: tight values") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    support::place_box where;
    where.x[0] = support::between(-1, 2);
    auto const range = [&](expression const& e) {
        return support::evaluate(g, {e.in(g)}, where).outputs[0];
    };
    CHECK(range(x * x).lower() == 0);
    CHECK(range((-x) * x).upper() == 0);
    CHECK(range(x - x).upper() == 0);
    CHECK(range(x + -x).lower() == 0);
    CHECK(range(pown(x, 2)).lower() == 0);
    CHECK(range(abs(-x)).upper() == 2);
    CHECK(range(0 * x).upper() == 0);
    CHECK(range(min(x, x)).lower() == -1);
    // A dead band of no width, which an effect leaves where it does not act.
    CHECK(deadband(x, 0.0).in(g) == x.in(g));
    CHECK((min(0.5, x) + max(x, 0.5)).in(g) == (x + 0.5).in(g));
    CHECK(range(min(x, 0.5) + max(x, 1.0)).upper() == 2.5);
    CHECK(range(max(x, 0.5) + max(x, 0.5)).upper() == 4);
}

TEST_CASE("equal parts are shared, whatever their order") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const y(g, g.leaf(operation::state, 1));
    auto const a = (x * y + sin(x)).in(g);
    auto const size = g.size();
    CHECK((sin(x) + y * x).in(g) == a);
    CHECK(g.size() == size);
    CHECK((x - -y).in(g) == (y + x).in(g));
    CHECK(expression(1.0).in(g) == expression(1).in(g));
}

TEST_CASE("different constants stay different although their bounds are equal") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const a = support::between(1, 2);
    expression const b = support::between(1, 2);
    support::place_box where;
    where.x[0] = interval(1.0);
    auto const difference = support::evaluate(g, {(a * x - b * x).in(g)}, where).outputs[0];
    CHECK(contains(difference, 1.0));
    CHECK(contains(difference, -1.0));
    auto const ratio = support::evaluate(g, {((a * x) * (b * x - 1.5)).in(g)}, where).outputs[0];
    CHECK(contains(ratio, -1.0));
    using namespace sivid::literals;
    // Two decimals in one gap between doubles.
    expression const p = 0.1_dec;
    expression const q = 0.100000000000000000001_dec;
    auto const gap = support::evaluate(g, {(q * x - p * x).in(g)}, where).outputs[0];
    CHECK(gap.upper() >= 1e-21);
}

TEST_CASE("literals fold to enclosures of their exact values") {
    using namespace sivid::literals;
    graph g;
    auto const folded = [&g](expression const& e) {
        auto const id = e.in(g);
        REQUIRE(g.is_literal(id));
        return g.value(g[id]);
    };
    auto const third = folded(expression(1) / 3);
    CHECK(encloses(third.enclosure, mp(1) / 3));
    CHECK(width(third.enclosure) < 1e-16);
    CHECK(third.nearest == 1.0 / 3);
    CHECK(encloses(folded(exp(expression(1))).enclosure, exp(mp(1))));
    CHECK(encloses(folded(sqr(expression(0.1_dec))).enclosure, mp("0.01")));
    CHECK(encloses(folded(pown(expression(0.1_dec), 5)).enclosure, mp("0.00001")));
    CHECK(encloses(folded(pown(expression(0.1_dec), -2)).enclosure, mp(100)));
    CHECK(folded(pown(expression(3), 0)).nearest == 1);
}

TEST_CASE("a constant of a model without a value is refused") {
    CHECK_THROWS_AS(log(expression(0)), std::domain_error);
    CHECK_THROWS_AS(sqrt(expression(-1)), std::domain_error);
    CHECK_THROWS_AS(expression(1) / expression(0), std::domain_error);
    CHECK_THROWS_AS(pown(expression(0), -1), std::domain_error);
    CHECK_THROWS_AS(pown(expression(0), -2), std::domain_error);
    CHECK_THROWS_AS(exp(expression(1e6)), std::domain_error);
}

TEST_CASE("a graph keeps operands before their users") {
    graph g;
    auto const x = g.leaf(operation::state, 0);
    auto const p = g.leaf(operation::constant, 1);
    auto const root = g.div(g.unary(operation::tanh, g.mul(x, p)), g.pown(g.add(x, p), 5));
    CHECK(root + 1 == g.size());
    for (node_id i = 0; i < g.size(); ++i) {
        auto const& n = g[i];
        if (is_leaf(n.op)) continue;
        CHECK(n.a < i);
        if (is_binary(n.op)) CHECK(n.b < i);
    }
}

TEST_CASE("powers have an exponent above 2, whose recurrence reads a lower one") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    expression const root = sqrt(x);
    support::place_box where;
    where.x[0] = support::between(1, 4);
    for (int n = -4; n <= 4; ++n) {
        auto const y = support::evaluate(g, {pown(root, n).in(g)}, where);
        CHECK_FALSE(y.undefined);
        CHECK(y.outputs[0].lower() == std::pow(2, std::min(n, 0)));
        CHECK(y.outputs[0].upper() == std::pow(2, std::max(n, 0)));
    }
    for (auto const& n : g.nodes()) {
        if (n.op != operation::pown) continue;
        CHECK(n.index > 2);
        CHECK(n.companion == g.pown(n.a, n.index - 1));
    }
    // Of large ones it is the half power: the nodes of a power grow with its logarithm.
    for (int const n : {20, 999, 1000, 1023, most_power}) {
        auto const before = g.size();
        auto const y = g.pown(g.leaf(operation::state, 1), n);
        CHECK(static_cast<double>(g.size() - before) <= 2 * std::log2(n) + 8);
        auto const half = g[y].companion;
        CHECK((g[half].index == n - 1 || 2 * g[half].index == n));
    }
}

TEST_CASE("nodes know what they depend on and whether they are total") {
    graph g;
    auto const t = g.leaf(operation::time, 0);
    auto const x = g.leaf(operation::state, 0);
    auto const p = g.leaf(operation::constant, 0);
    auto const u = g.leaf(operation::input, 0);
    CHECK(g.depends(g.add(g.mul(t, x), g.mul(p, u))) ==
          (on_time | on_state | on_constant | on_input));
    CHECK(g.depends(g.unary(operation::sin, p)) == on_constant);
    CHECK(g.depends(g.constant(2.0)) == on_nothing);
    auto const root = g.unary(operation::sqrt, x);
    CHECK_FALSE(g.total(root));
    CHECK_FALSE(g.total(g.add(root, p)));
    CHECK_FALSE(g.total(g.div(p, x)));
    CHECK(g.total(g.unary(operation::atan, x)));
    CHECK_FALSE(g.total(g.unary(operation::tan, x)));
}

TEST_CASE("leaves and point literals are entered once") {
    graph g;
    CHECK(g.leaf(operation::state, 3) == g.leaf(operation::state, 3));
    CHECK(g.leaf(operation::state, 3) != g.leaf(operation::state, 2));
    CHECK(g.leaf(operation::state, 0) != g.leaf(operation::constant, 0));
    CHECK(g.constant(2.5) == g.constant(2.5));
    CHECK(g.constant(2.5) != g.constant(2.0));
    CHECK(g.is(g.constant(2.5), 2.5));
    CHECK_FALSE(g.is(g.constant(literal{support::between(2.4, 2.6), 2.5}), 2.5));
}

TEST_CASE("apply computes each operation") {
    using traits = proven_arithmetic<interval>;
    bool cut = false;
    interval const a = support::between(1, 2);
    interval const b = support::between(4, 8);
    auto const at = [&](operation op, int n = 0) { return sivid::apply<traits>(op, a, b, n, cut); };
    CHECK(at(operation::neg).lower() == -2);
    CHECK(at(operation::add).upper() == 10);
    CHECK(at(operation::sub).lower() == -7);
    CHECK(at(operation::mul).upper() == 16);
    CHECK(at(operation::div).upper() == 0.5);
    CHECK(at(operation::sqr).upper() == 4);
    CHECK(at(operation::pown, 3).upper() == 8);
    CHECK(contains(at(operation::sqrt), std::sqrt(1.5)));
    CHECK(contains(at(operation::exp), std::exp(1.5)));
    CHECK(contains(at(operation::log), std::log(1.5)));
    CHECK(contains(at(operation::sin), std::sin(1.25)));
    CHECK(contains(at(operation::cos), std::cos(1.25)));
    CHECK(contains(at(operation::atan), std::atan(1.25)));
    CHECK(contains(at(operation::tanh), std::tanh(1.25)));
    CHECK(at(operation::abs).lower() == 1);
    CHECK(at(operation::sign).lower() == 1);
    CHECK(at(operation::min).upper() == 2);
    CHECK(at(operation::max).lower() == 4);
    CHECK_FALSE(cut);
    (void)at(operation::tan); // [1, 2] holds a pole
    CHECK(cut);
}
