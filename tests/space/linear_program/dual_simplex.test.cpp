// SPDX-License-Identifier: MIT
// Small programs against all their vertices; degenerate, empty and unbounded ones; numbers that are
// none.
#include <sivid/space/linear_program/dual_simplex.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

using namespace sivid;
using support::draws;
using outcome = dual_simplex::outcome;

namespace {

using vector = std::vector<double>;

double dot(vector const& a, vector const& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// A program whose half-spaces are listed: first the sides of a box.
struct listed {
    vector goal;
    std::vector<half_space> all;

    listed(vector g, double side) : goal(std::move(g)) {
        for (std::size_t v = 0; v < goal.size(); ++v) {
            for (double const sign : {1.0, -1.0}) {
                vector normal(goal.size(), 0.0);
                normal[v] = sign;
                add(normal, side);
            }
        }
    }
    void add(vector normal, double reach) { all.push_back({all.size(), std::move(normal), reach}); }
    std::vector<half_space> corner() const {
        std::vector<half_space> basis;
        for (std::size_t v = 0; v < goal.size(); ++v) basis.push_back(all[2 * v + (goal[v] < 0)]);
        return basis;
    }
    dual_simplex::question worst() const {
        return [this](vector const& x, half_space& violated) {
            double most = 1e-9;
            half_space const* found = nullptr;
            for (auto const& h : all) {
                double const excess = dot(h.normal, x) - h.reach;
                if (excess > most) most = excess, found = &h;
            }
            if (found) violated = *found;
            return found != nullptr;
        };
    }
    /// The best vertex, -infinity when there is none.
    double best() const {
        auto const n = goal.size();
        double value = -std::numeric_limits<double>::infinity();
        std::vector<bool> chosen(all.size(), false);
        std::fill(chosen.end() - static_cast<std::ptrdiff_t>(n), chosen.end(), true);
        basis_factors f;
        do {
            vector m, x;
            for (std::size_t k = 0; k < all.size(); ++k) {
                if (!chosen[k]) continue;
                m.insert(m.end(), all[k].normal.begin(), all[k].normal.end());
                x.push_back(all[k].reach);
            }
            if (!f.factorise(m, n)) continue;
            f.solve(x);
            bool const holds = std::all_of(all.begin(), all.end(), [&](half_space const& h) {
                return dot(h.normal, x) <= h.reach + 1e-7;
            });
            if (holds) value = std::max(value, dot(goal, x));
        } while (std::next_permutation(chosen.begin(), chosen.end()));
        return value;
    }
};

/// The combination must be that of the goal (or of nothing, when the program is empty).
double shown(listed const& p, dual_simplex const& s, vector sum) {
    double bound = 0;
    for (auto const& [name, y] : s.combination()) {
        REQUIRE(y > 0);
        REQUIRE(name < p.all.size());
        auto const& h = p.all[name];
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= y * h.normal[i];
        bound += y * h.reach;
    }
    for (double const left : sum) CHECK_THAT(left, WithinAbs(0, 1e-7));
    return bound;
}

listed random_program(draws& d, std::size_t n, std::size_t rows, bool small_integers) {
    auto const entry = [&] {
        return small_integers ? static_cast<double>(d.below(5)) - 2 : d.uniform(-1, 1);
    };
    vector goal(n);
    for (auto& g : goal) g = entry();
    listed p(goal, 1);
    for (std::size_t k = 0; k < rows; ++k) {
        vector normal(n);
        for (auto& v : normal) v = entry();
        p.add(normal, small_integers ? static_cast<double>(d.below(4)) - 1 : d.uniform(-0.4, 1));
    }
    return p;
}

} // namespace

TEST_CASE("the best vertex is found, or that nothing is left, and the multipliers show it") {
    draws d(41);
    int solved = 0, empty = 0;
    for (bool const small_integers : {false, true}) { // these are degenerate most of the time
        for (int trial = 0; trial < 150; ++trial) {
            std::size_t const n = 1 + d.below(3);
            auto const p = random_program(d, n, d.below(7), small_integers);
            INFO("trial " << trial << (small_integers ? " of integers" : ""));
            dual_simplex s;
            REQUIRE(s.start(p.goal, p.corner()));
            auto const how = s.run(p.worst(), 200);
            double const best = p.best();
            if (how == outcome::empty) {
                ++empty;
                CHECK(best == -std::numeric_limits<double>::infinity());
                CHECK(shown(p, s, vector(n, 0.0)) < 0);
                continue;
            }
            ++solved;
            REQUIRE(how == outcome::optimal);
            CHECK_THAT(dot(p.goal, s.point()), WithinAbs(best, 1e-7));
            CHECK_THAT(s.value(), WithinAbs(best, 1e-7));
            CHECK_THAT(shown(p, s, p.goal), WithinAbs(best, 1e-7));
        }
    }
    CHECK(solved > 150);
    CHECK(empty > 20);
}

TEST_CASE("many half-spaces through one point end the work in few exchanges") {
    draws d(42);
    for (std::size_t const n : {4u, 10u, 30u}) {
        vector goal(n);
        for (auto& g : goal) g = d.uniform(0, 1);
        listed p(goal, 1);
        for (int k = 0; k < 400; ++k) { // cones with their tips at zero
            vector normal(n);
            for (auto& v : normal) v = static_cast<double>(d.below(3));
            p.add(normal, 0);
        }
        dual_simplex s;
        REQUIRE(s.start(p.goal, p.corner()));
        CHECK(s.run(p.worst(), 40 * n) == outcome::optimal);
        CHECK_THAT(shown(p, s, p.goal), WithinAbs(s.value(), 1e-6));
    }
}

TEST_CASE("tens of unknowns: point and multipliers meet") {
    draws d(43);
    for (int trial = 0; trial < 10; ++trial) {
        std::size_t const n = 20 + d.below(40);
        auto p = random_program(d, n, 300, false);
        for (auto& h : p.all) h.reach = std::abs(h.reach) + 0.1; // zero is inside
        dual_simplex s;
        REQUIRE(s.start(p.goal, p.corner()));
        REQUIRE(s.run(p.worst(), 40 * n) == outcome::optimal);
        CHECK_THAT(dot(p.goal, s.point()), WithinAbs(s.value(), 1e-7));
        CHECK_THAT(shown(p, s, p.goal), WithinAbs(s.value(), 1e-7));
    }
}

TEST_CASE("with further half-spaces a run goes on from where it was") {
    draws d(44);
    std::size_t warm = 0, cold = 0;
    for (int trial = 0; trial < 40; ++trial) {
        auto p = random_program(d, 8, 60, false);
        for (auto& h : p.all) h.reach = std::abs(h.reach) + 0.2;
        dual_simplex s;
        REQUIRE(s.start(p.goal, p.corner()));
        REQUIRE(s.run(p.worst(), 400) == outcome::optimal);
        auto const before = s.exchanges();
        vector normal = s.point();
        p.add(normal, 0.9 * dot(normal, normal)); // cuts the point off
        REQUIRE(s.run(p.worst(), 400) == outcome::optimal);
        warm += s.exchanges() - before;
        dual_simplex fresh;
        REQUIRE(fresh.start(p.goal, p.corner()));
        REQUIRE(fresh.run(p.worst(), 400) == outcome::optimal);
        cold += fresh.exchanges();
        CHECK_THAT(s.value(), WithinAbs(fresh.value(), 1e-8));
    }
    CHECK(warm > 0);
    CHECK(2 * warm < cold);
}

TEST_CASE(
    "a basis that does not bound the goal is refused: such is every one of an unbounded program") {
    dual_simplex s;
    listed const p({1, 1}, 1);
    auto const question = p.worst();
    CHECK_FALSE(s.start({1, 1}, {{0, {1, 0}, 1}, {1, {0, -1}, 1}}));
    CHECK_FALSE(s.started());
    CHECK(s.run(question, 10) == outcome::stopped);
    CHECK_FALSE(s.start({1, 1}, {{0, {1, 0}, 1}, {1, {2, 0}, 1}})); // parallel
    CHECK_FALSE(s.start({1, 1}, {{0, {1, 0}, 1}}));                 // too few
    CHECK_FALSE(s.start({1, 1}, {{0, {1}, 1}, {1, {0, 1}, 1}}));    // of another space
    CHECK(s.start({1, 1}, p.corner()));
}

TEST_CASE("numbers that are none end a run, and so does its limit") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (double const bad : {nan, infinite, -infinite}) {
        dual_simplex s;
        listed p({1, 1}, 1);
        CHECK_FALSE(s.start({bad, 1}, p.corner()));
        CHECK_FALSE(s.start({1, 1}, {{0, {1, 0}, bad}, {1, {0, 1}, 1}}));
        REQUIRE(s.start({1, 1}, p.corner()));
        auto const always = [&](vector const&, half_space& h) {
            h = {7, {bad, 1}, 0.5};
            return true;
        };
        CHECK(s.run(always, 50) == outcome::stopped);
        CHECK(s.value() == 2); // of the last basis that was one
        CHECK_THAT(shown(p, s, p.goal), WithinAbs(2, 1e-12));
        auto const far = [&](vector const&, half_space& h) {
            h = {7, {1, 0.5}, bad};
            return true;
        };
        CHECK(s.run(far, 50) == outcome::stopped);
        CHECK(std::isfinite(s.value()));
    }
    dual_simplex s;
    listed const p({1, 1}, 1);
    REQUIRE(s.start({1, 1}, p.corner()));
    std::size_t asked = 0;
    auto const never_content = [&](vector const&, half_space& h) {
        h = {++asked, {1, asked % 2 == 0 ? 2.0 : 0.5}, 0.1};
        return true;
    };
    CHECK(s.run(never_content, 25) == outcome::stopped);
    CHECK(s.exchanges() <= 25);
    CHECK(s.run(
              [](vector const&, half_space& h) {
                  return h = {3, {}, 1}, true;
              },
              25) == outcome::stopped);
}

TEST_CASE("of nearly equal steps the larger pivot leaves") {
    // The first is driven to zero a trillionth earlier, by a pivot that spoils the factors.
    CHECK(dual_simplex::leaving({1e-9, 1}, {0.5e-9, 0.5 * (1 + 1e-12)}) == 1);
    CHECK(dual_simplex::leaving({0.5, 1}, {0.25, 0.6}) == 0);
    CHECK(dual_simplex::leaving({-1, 0}, {1, 1}) == 2);
}
