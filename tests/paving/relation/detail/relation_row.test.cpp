// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/relation_row.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

struct bench {
    graph g;
    std::vector<expression> x, p;

    bench() {
        for (std::size_t i = 0; i < 2; ++i) x.emplace_back(g, g.leaf(operation::state, i));
        for (std::size_t j = 0; j < 3; ++j) p.emplace_back(g, g.leaf(operation::constant, j));
    }
    relation_row row(expression const& e, box const& prior) {
        return make_relation_row(g, e.in(g), 0, prior);
    }
};
/// z of a parameter vector, by the ranges of the coefficients.
std::vector<double> place(relation_row const& row, std::vector<double> const& theta) {
    std::vector<double> z;
    for (std::size_t j = 0; j < theta.size(); ++j) {
        z.push_back(row.width[j] == 0 ? 0.0 : (theta[j] - row.anchor[j]) / row.width[j]);
    }
    return z;
}
double violation(linear_system const& s, std::size_t i, std::vector<double> const& z) {
    double value = -s.bound(i);
    for (std::size_t j = 0; j < z.size(); ++j) value += s.row(i)[j] * z[j];
    return value;
}

} // namespace

TEST_CASE("coefficients have certified ranges and start at the end closest to zero") {
    bench b;
    auto const row = b.row(b.p[0] / b.p[1] * b.x[0] - b.p[2] * b.x[1] + b.x[0] * b.x[1],
                           box{between(2, 4), between(1, 2), between(-3, -1)});
    REQUIRE(row.range.size() == 2);
    CHECK(row.functions.size() == 3);
    CHECK(row.states == std::set<std::size_t>{0, 1});
    CHECK(row.bounded);
    CHECK_FALSE(row.uses_inputs);
    for (std::size_t j = 0; j < 2; ++j) {
        auto const& r = row.range[j];
        bool const quotient = r.lower() > 0;
        CHECK(equal(r, quotient ? between(1, 4) : between(-3, -1)));
        CHECK(row.anchor[j] == (quotient ? 1 : -1));
        CHECK(row.width[j] == (quotient ? 3 : -2));
    }
    CHECK_FALSE(b.row(b.x[0] / b.p[0], box{between(0, 1), between(0, 1), between(0, 1)}).bounded);
}

TEST_CASE(
    "what does not separate is taken about its middle, unless its factor has the same constant") {
    bench b;
    box const prior{between(1, 2), between(3, 5), between(0, 1)};
    auto const apart = b.row(b.p[1] * tanh(b.p[0] * b.x[0]), prior);
    REQUIRE(apart.theta.size() == 2); // p1, and the distance of p0 from its middle
    CHECK(std::any_of(apart.range.begin(), apart.range.end(),
                      [](interval const& r) { return equal(r, between(-0.5, 0.5)); }));
    CHECK(apart.inseparable == std::set<std::size_t>{0, 1}); // where the slope is taken
    auto const same = b.row(b.p[0] * tanh(b.p[0] * b.x[0]), prior);
    REQUIRE(same.theta.size() == 1);
    CHECK(equal(same.range[0], between(1, 2)));
    CHECK(same.inseparable == std::set<std::size_t>{0});
}

TEST_CASE("quotients in which factors cancel tie coefficients together") {
    bench b;
    // 1/p1 in [0.5, 1] and p0/p1 in [1, 4], but p0 = their quotient in [2, 4] only.
    auto const row = b.row(b.x[0] / b.p[1] - b.p[0] / b.p[1] * b.x[1],
                           box{between(2, 4), between(1, 2), between(0, 1)});
    REQUIRE(row.range.size() == 2);
    CHECK(row.ratios.size() >= 2);
    auto const system = system_of(row, {});
    draws d(20);
    bool cuts = false;
    for (int n = 0; n < 200; ++n) {
        double const p0 = d.uniform(2, 4), p1 = d.uniform(1, 2);
        std::vector<double> theta(2);
        for (std::size_t j = 0; j < 2; ++j) {
            theta[j] = row.range[j].upper() < 1.5 ? 1 / p1 : p0 / p1;
        }
        for (std::size_t i = 0; i < system.size(); ++i) {
            CHECK(violation(system, i, place(row, theta)) <= 1e-12);
            CHECK(system.weight(i) == 0);
        }
        std::vector<double> const wrong{d.uniform(0, 1), d.uniform(0, 1)};
        for (std::size_t i = 0; i < system.size(); ++i) {
            cuts = cuts || violation(system, i, wrong) > 0.01;
        }
    }
    CHECK(cuts);
}

TEST_CASE("a coefficient vector that fulfils the windows fulfils the inequalities") {
    draws d(21);
    bench b;
    box const prior{between(-1, 2), between(1, 3), between(-4, -1)};
    auto const row =
        b.row(b.p[0] * b.x[0] + b.p[1] * b.x[1] + b.p[2] * b.x[0] * b.x[1] + b.x[1], prior);
    REQUIRE(row.range.size() == 3);
    for (int n = 0; n < 200; ++n) {
        std::vector<double> theta;
        for (auto const& r : row.range) theta.push_back(d.in(r));
        std::vector<window_row> windows;
        for (int m = 0; m < 5; ++m) {
            window_row w;
            double sum = 0;
            for (std::size_t j = 0; j < 4; ++j) {
                double const a = d.uniform(-2, 2);
                double const e = d.coin() ? 0 : d.uniform(0, 1);
                w.a.push_back(between(a - d.uniform(0, 1) * e, a + d.uniform(0, 1) * e));
                sum += a * (j < 3 ? theta[j] : 1.0);
            }
            w.difference = around(sum, 0.01 * (1 + d.uniform(0, 1)));
            w.length = between(2, 2);
            windows.push_back(w);
            CHECK(contains(missing_rate_in(row, w), 0));
        }
        auto const system = system_of(row, windows);
        REQUIRE(system.size() >= 10);
        for (std::size_t i = 0; i < system.size(); ++i) {
            CHECK(violation(system, i, place(row, theta)) <= 1e-9);
        }
        CHECK(proved_margin(system, least_relaxation(system).multipliers) <= 0);
    }
}

TEST_CASE("the missing rate is what the window lacks, over its length") {
    bench b;
    auto const row = b.row(b.p[0] * b.x[0], box{between(1, 2), between(1, 3), between(-4, -1)});
    window_row w;
    w.a = {between(1, 1), between(0, 0)};
    w.difference = between(5, 5);
    w.length = between(2, 2);
    auto const missing = missing_rate_in(row, w);
    CHECK(equal(missing, between(1.5, 2)));
}
