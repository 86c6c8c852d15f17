// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/separation.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

#include <sivid/model/bound_model.hpp>

#include "../../../../examples/hovercraft/model.hpp"

using namespace diagnosis_support;

namespace {

/// A graph with three states and four constants.
struct bench {
    graph g;
    std::vector<expression> x, p;

    bench() {
        for (std::size_t i = 0; i < 3; ++i) x.emplace_back(g, g.leaf(operation::state, i));
        for (std::size_t j = 0; j < 4; ++j) p.emplace_back(g, g.leaf(operation::constant, j));
    }
    /// The sum of terms and the expression itself overlap at random points, narrowly.
    std::size_t agree(node_id root, draws& d, double lo = 0.5, double hi = 2) {
        auto const split = separate(g, root);
        std::vector<node_id> nodes{root, split.rest};
        for (auto const& t : split.terms) {
            nodes.push_back(t.function);
            for (auto const& [atom, e] : t.theta) nodes.push_back(atom);
        }
        graph_range range(g, nodes);
        for (int n = 0; n < 20; ++n) {
            box states(3), constants(4);
            for (auto* b : {&states, &constants}) {
                for (std::size_t i = 0; i < b->size(); ++i) (*b)[i] = interval(d.uniform(lo, hi));
            }
            range.evaluate({interval(0.0), states, constants, {}});
            auto sum = range.value(split.rest);
            for (auto const& t : split.terms) {
                sum = sum + range_of(t.theta, range) * range.value(t.function);
            }
            CHECK_FALSE(disjoint(sum, range.value(root)));
            CHECK(width(sum) <= 1e-11 * (1 + mag(sum)));
        }
        for (std::size_t a = 0; a < split.terms.size(); ++a) {
            CHECK_FALSE(split.terms[a].theta.empty());
            for (std::size_t b = 0; b < a; ++b) {
                CHECK(split.terms[a].theta != split.terms[b].theta);
            }
        }
        return split.terms.size();
    }
};

} // namespace

TEST_CASE("sums, products, quotients and powers separate") {
    bench b;
    draws d(2);
    auto const& x = b.x;
    auto const& p = b.p;
    auto const terms = [&](expression const& e) { return b.agree(e.in(b.g), d); };
    CHECK(terms(x[0] * x[1] + 2) == 0);
    CHECK(terms(p[0]) == 1);
    CHECK(terms(p[0] * x[0] - p[0] * x[1]) == 1);
    CHECK(terms(p[0] * p[1] * x[0] + p[1] * p[0] * sin(x[1])) == 1);
    CHECK(terms((p[0] + x[0]) * (p[1] - x[1])) == 3);
    CHECK(terms((p[0] * x[0] + p[1] * x[1]) / p[2]) == 2);
    CHECK(terms(x[0] / (p[0] + p[1])) == 1);
    CHECK(terms(p[0] * x[0] / (p[1] * sqr(x[1]))) == 1);
    CHECK(terms(sqr(p[0] * x[0]) + pown(p[0] / p[1], 3) * x[1]) == 2);
    CHECK(terms(sqr(x[0] + p[0] * x[1])) == 2);
    CHECK(terms(pown(x[0] - p[0], 3)) == 3);
    CHECK(terms(exp(p[0]) * x[0] + exp(p[0]) * x[1]) == 1);
    CHECK(terms(-(p[0] * (x[0] - (p[1] + 3) * x[1]))) == 2);
    CHECK(terms(p[0] / p[0] * x[0]) == 0);
    CHECK(terms(p[0] * x[0] - p[0] * x[0]) == 0);
}

TEST_CASE("what does not separate stays in the functions, and is said") {
    bench b;
    draws d(3);
    auto const inside = sin(b.p[0] * b.x[0]) * b.p[1] + b.p[2] * b.x[2];
    auto const root = inside.in(b.g);
    CHECK(b.agree(root, d) == 2);
    CHECK_FALSE(separate(b.g, root).complete);
    CHECK(separate(b.g, (b.p[0] * b.x[0]).in(b.g)).complete);
    // A denominator of several terms: the numerator still separates.
    auto const quotient_of = (b.p[0] * b.x[0] / (b.p[1] + b.x[1])).in(b.g);
    CHECK(b.agree(quotient_of, d) == 1);
    CHECK_FALSE(separate(b.g, quotient_of).complete);
    // Too many terms: left as they are, still equal.
    auto sum = b.p[0] * b.x[0] + b.p[1] * b.x[1] + b.p[2] * b.x[2] + b.p[3];
    auto const power = pown(sum, 5).in(b.g);
    CHECK(b.agree(power, d) == 0);
}

TEST_CASE("random expressions equal the sum of their terms") {
    draws d(4);
    for (int n = 0; n < 60; ++n) {
        bench b;
        std::vector<expression> pool;
        for (auto const& e : b.x) pool.push_back(e);
        for (auto const& e : b.p) pool.push_back(e);
        for (int k = 0; k < 10; ++k) {
            auto const& a = pool[d.below(pool.size())];
            auto const& c = pool[d.below(pool.size())];
            switch (d.below(6)) {
            case 0:
                pool.push_back(a + c);
                break;
            case 1:
                pool.push_back(a - c);
                break;
            case 2:
                pool.push_back(a * c);
                break;
            case 3:
                pool.push_back(a / (2 + sqr(c)));
                break;
            case 4:
                pool.push_back(a * b.p[d.below(4)] / b.p[d.below(4)]);
                break;
            default:
                pool.push_back(sin(a));
            }
        }
        bench& used = b;
        auto const root = pool.back().in(used.g);
        auto const split = separate(used.g, root);
        std::vector<node_id> nodes{root, split.rest};
        for (auto const& t : split.terms) {
            nodes.push_back(t.function);
            for (auto const& [atom, e] : t.theta) nodes.push_back(atom);
        }
        graph_range range(used.g, nodes);
        box states(3), constants(4);
        for (std::size_t i = 0; i < 3; ++i) states[i] = interval(d.uniform(-1, 1));
        for (std::size_t j = 0; j < 4; ++j) constants[j] = interval(d.uniform(0.5, 1.5));
        range.evaluate({interval(0.0), states, constants, {}});
        auto total = range.value(split.rest);
        for (auto const& t : split.terms) {
            total = total + range_of(t.theta, range) * range.value(t.function);
        }
        CHECK_FALSE(disjoint(total, range.value(root)));
    }
}

TEST_CASE("the hovercraft's equations are linear in a few products") {
    auto const model = record_model<hovercraft>();
    std::vector<signal> const open(2, sampled_signal({0.0}, {0.0}, interpolation::linear));
    auto bound = bind(model, {{"Sv", "Sg", "L", "m", "Iz", "Ff"}, {}}, open);
    std::vector<std::size_t> counts;
    for (auto const rate : bound.rate) {
        auto const split = separate(bound.g, rate);
        counts.push_back(split.terms.size());
        CHECK(split.complete);
    }
    // 1/m, Ff/m | Ff/m, Sv/m, 1/m | L Sg/Iz, 1/Iz | kinematics
    CHECK(counts == std::vector<std::size_t>{2, 3, 2, 0, 0, 0});
}

TEST_CASE("a quotient that may divide by zero has no bounded range") {
    graph g;
    auto const p = g.leaf(operation::constant, 0);
    graph_range range(g, {p});
    range.evaluate({interval(0.0), {}, box{between(-1, 1)}, {}});
    CHECK_FALSE(is_bounded(range_of({{p, -1}}, range)));
    CHECK(equal(range_of({{p, 2}}, range), between(0, 1)));
    CHECK(equal(range_of({}, range), between(1, 1)));
    CHECK(quotient({{p, 1}}, {{p, 1}}).empty());
}
