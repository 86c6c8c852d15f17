// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/linear_refutation.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <limits>

using namespace sivid;
using support::draws;

namespace {

/// Random inequalities around a point of the box: fulfilled there with `slack`, or violated by one
/// pair of them.
linear_system random_system(draws& d, std::size_t n, std::size_t rows, double slack,
                            std::vector<double> const& z) {
    linear_system system(n);
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<double> row(n);
        double value = 0;
        for (std::size_t j = 0; j < n; ++j) {
            row[j] = d.uniform(-2, 2);
            value += row[j] * z[j];
        }
        system.add(row, value + slack * d.uniform(0, 1), d.uniform(0.5, 2));
    }
    return system;
}
std::vector<double> random_point(draws& d, std::size_t n) {
    std::vector<double> z(n);
    for (auto& v : z) v = d.uniform(0, 1);
    return z;
}

} // namespace

TEST_CASE("what has a solution is never refuted") {
    draws d(6);
    for (int k = 0; k < 300; ++k) {
        auto const n = d.below(6);
        auto const system =
            random_system(d, n, 1 + d.below(200), d.coin() ? 1e-9 : 0.3, random_point(d, n));
        auto const relaxed = least_relaxation(system);
        CHECK(proved_margin(system, relaxed.multipliers) <= 0);
        refutation any; // whatever non-negative multipliers
        for (int m = 0; m < 5; ++m) {
            any.multipliers.emplace_back(d.below(system.size()), d.uniform(0, 3));
        }
        CHECK(proved_margin(system, any) <= 0);
    }
}

TEST_CASE("the relaxation is the least one, and its multipliers prove it") {
    draws d(7);
    for (int k = 0; k < 200; ++k) {
        auto const n = d.below(5);
        auto const rows = 5 + d.below(300);
        linear_system system(n);
        for (std::size_t i = 0; i < rows; ++i) {
            std::vector<double> row(n);
            for (auto& v : row) v = d.uniform(-1, 1);
            system.add(row, d.uniform(-1, 1), d.uniform(0.5, 2));
        }
        auto const relaxed = least_relaxation(system);
        // t is enough at z ...
        for (std::size_t i = 0; i < rows; ++i) {
            double value = 0;
            for (std::size_t j = 0; j < n; ++j) value += system.row(i)[j] * relaxed.z[j];
            CHECK(value <= system.bound(i) + relaxed.t * system.weight(i) + 1e-7);
        }
        // ... and needed.
        CHECK(relaxed.multipliers.multipliers.size() <= n + 1);
        if (relaxed.t > 1e-6) {
            double const margin = proved_margin(system, relaxed.multipliers);
            CHECK(margin <= relaxed.t + 1e-9);
            CHECK_THAT(margin, WithinRel(relaxed.t, 1e-6));
        }
    }
}

TEST_CASE("two inequalities that contradict each other") {
    linear_system system(1);
    system.add({1.0}, 0.25, 1);   // z <= 1/4
    system.add({-1.0}, -0.75, 1); // z >= 3/4
    auto const relaxed = least_relaxation(system);
    CHECK_THAT(relaxed.t, WithinAbs(0.25, 1e-6));
    CHECK_THAT(relaxed.z[0], WithinAbs(0.5, 1e-6));
    CHECK_THAT(proved_margin(system, relaxed.multipliers), WithinAbs(0.25, 1e-6));
    SECTION("tampered multipliers prove nothing") {
        auto const& good = relaxed.multipliers.multipliers;
        REQUIRE(good.size() == 2);
        for (double const bad : {-1.0, std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
            auto y = good;
            y[0].second = bad;
            CHECK(proved_margin(system, {y}) <= 0);
        }
        CHECK(proved_margin(system, {{{0, 1.0}, {0, 1.0}}}) <= 0); // the same one twice
        CHECK(proved_margin(system, {{{0, 1.0}}}) <= 0);
        CHECK(proved_margin(system, {{{0, 1.0}, {1, 0.2}}}) <= 0);
        CHECK(proved_margin(system, {{{0, 1.0}, {7, 1.0}}}) <= 0); // there is no seventh
        CHECK(proved_margin(system, {}) <= 0);
        // Another, weaker, but honest combination is still a proof.
        double const weaker = proved_margin(system, {{{0, 1.0}, {1, 1.2}}});
        CHECK(weaker > 0);
        CHECK(weaker < 0.25);
    }
}

TEST_CASE("a contradiction by less than rounding is not claimed") {
    linear_system system(1);
    system.add({0.1}, 0.1 * 0.3, 1);
    system.add({-0.1}, -0.1 * 0.3, 1);
    CHECK(proved_margin(system, {{{0, 1.0}, {1, 1.0}}}) <= 0);
}

TEST_CASE("inequalities of no weight have to hold") {
    linear_system system(2);
    system.add({1.0, -1.0}, 0.0, 0);   // z0 <= z1
    system.add({0.0, 1.0}, 0.25, 1);   // z1 <= 1/4
    system.add({-1.0, 0.0}, -0.75, 1); // z0 >= 3/4
    auto const relaxed = least_relaxation(system);
    CHECK_THAT(relaxed.t, WithinAbs(0.25, 1e-6));
    CHECK_THAT(proved_margin(system, relaxed.multipliers), WithinAbs(0.25, 1e-6));
    CHECK(relaxed.multipliers.multipliers.size() == 3);
}

TEST_CASE("without unknowns a single inequality decides") {
    linear_system system(0);
    system.add({}, 0.5, 1);
    CHECK(proved_margin(system, least_relaxation(system).multipliers) <= 0);
    system.add({}, -0.5, 2);
    auto const relaxed = least_relaxation(system);
    CHECK_THAT(relaxed.t, WithinAbs(0.25, 1e-6));
    CHECK_THAT(proved_margin(system, relaxed.multipliers), WithinAbs(0.25, 1e-6));
}

TEST_CASE("nothing to relax, nothing to say") {
    linear_system const none(2);
    CHECK(least_relaxation(none).multipliers.multipliers.empty());
    linear_system hard(1);
    hard.add({1.0}, -1.0, 0);
    CHECK(least_relaxation(hard).multipliers.multipliers.empty());
    CHECK(proved_margin(hard, {{{0, 1.0}}}) > 1e300); // refuted whatever is relaxed
}

TEST_CASE("a least value is not above that of any solution") {
    draws d(9);
    for (int k = 0; k < 300; ++k) {
        auto const n = 1 + d.below(5);
        auto const z = random_point(d, n);
        auto const system = random_system(d, n, d.below(60), d.coin() ? 1e-9 : 0.3, z);
        std::vector<double> goal(n);
        for (auto& c : goal) c = d.below(3) == 0 ? 0 : d.uniform(-2, 2);
        double const least = proved_least(system, goal);
        auto const value = [&goal](std::vector<double> const& x) {
            double sum = 0;
            for (std::size_t j = 0; j < x.size(); ++j) sum += goal[j] * x[j];
            return sum;
        };
        CHECK(least <= value(z) + 1e-12);
        for (int m = 0; m < 20; ++m) {
            auto const x = random_point(d, n);
            bool holds = true;
            for (std::size_t i = 0; i < system.size() && holds; ++i) {
                double sum = -system.bound(i);
                for (std::size_t j = 0; j < n; ++j) sum += system.row(i)[j] * x[j];
                holds = sum <= 0;
            }
            if (holds) CHECK(least <= value(x) + 1e-12);
        }
    }
}

TEST_CASE("least values of programs with known answers") {
    linear_system system(2);
    CHECK(proved_least(system, {1, -2}) == -2);
    system.add({1, 1}, 1, 1);      // x + y <= 1
    system.add({-1, 0}, -0.25, 1); // x >= 1/4
    CHECK_THAT(proved_least(system, {0, -1}), WithinAbs(-0.75, 1e-12));
    CHECK_THAT(proved_least(system, {1, 0}), WithinAbs(0.25, 1e-12));
    CHECK(proved_least(system, {0, 1}) == 0);
    system.add({0, -1}, -0.8, 1); // y >= 0.8: nothing is left
    CHECK(proved_least(system, {1, 1}) == HUGE_VAL);
    linear_system joined(2);
    joined.add(system);
    CHECK(joined.size() == 3);
    CHECK(proved_least(joined, {1, 1}) == HUGE_VAL);
}
