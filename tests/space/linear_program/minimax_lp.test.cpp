// SPDX-License-Identifier: MIT
#include <sivid/space/linear_program/minimax_lp.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

minimax_block random_block(draws& d, std::vector<std::size_t> variable, std::size_t functions) {
    minimax_block b;
    b.variable = std::move(variable);
    for (std::size_t k = 0; k < b.variable.size() * functions; ++k) {
        b.slope.push_back(d.below(5) == 0 ? 0 : d.uniform(-1, 1));
    }
    for (std::size_t y = 0; y < functions; ++y) {
        b.offset.push_back(d.uniform(-1, 1));
        b.margin.push_back(d.coin() ? 0 : d.uniform(0, 0.3));
    }
    return b;
}

/// Largest |f| - margin at a point.
double height(std::vector<minimax_block> const& blocks, std::vector<double> const& d) {
    double worst = -infinite;
    for (auto const& b : blocks) {
        for (std::size_t y = 0; y < b.functions(); ++y) {
            double f = b.offset[y];
            for (std::size_t v = 0; v < b.variable.size(); ++v) {
                f += b.slope[v * b.functions() + y] * d[b.variable[v]];
            }
            worst = std::max(worst, std::abs(f) - b.margin[y]);
        }
    }
    return worst;
}

/// The least height over all vertices of the linear program, one by one.
double by_vertices(std::size_t n, std::vector<minimax_block> const& blocks) {
    using vector = Eigen::VectorXd;
    auto const size = static_cast<Eigen::Index>(n + 1);
    std::vector<vector> rows; // row . (d, height) = right at equality
    std::vector<double> right;
    for (auto const& b : blocks) {
        for (std::size_t y = 0; y < b.functions(); ++y) {
            for (double const sign : {-1.0, 1.0}) {
                vector r = vector::Zero(size);
                for (std::size_t v = 0; v < b.variable.size(); ++v) {
                    r[static_cast<Eigen::Index>(b.variable[v])] =
                        sign * b.slope[v * b.functions() + y];
                }
                r[size - 1] = -1;
                rows.push_back(r);
                right.push_back(b.margin[y] - sign * b.offset[y]);
            }
        }
    }
    for (Eigen::Index v = 0; v + 1 < size; ++v) {
        for (double const sign : {-1.0, 1.0}) {
            vector r = vector::Zero(size);
            r[v] = sign;
            rows.push_back(r);
            right.push_back(1);
        }
    }
    double best = infinite;
    std::vector<std::size_t> chosen(n + 1);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    for (;;) {
        Eigen::MatrixXd a(size, size);
        vector c(size);
        for (Eigen::Index k = 0; k < size; ++k) {
            auto const at = chosen[static_cast<std::size_t>(k)];
            a.row(k) = rows[at].transpose();
            c[k] = right[at];
        }
        Eigen::FullPivLU<Eigen::MatrixXd> const lu(a);
        if (lu.isInvertible()) {
            vector const z = lu.solve(c);
            std::vector<double> d(z.data(), z.data() + n);
            bool const within =
                std::all_of(d.begin(), d.end(), [](double x) { return std::abs(x) <= 1 + 1e-9; });
            if (within) best = std::min(best, height(blocks, d));
        }
        std::size_t k = n + 1; // the next subset
        while (k-- > 0 && chosen[k] == rows.size() - (n + 1 - k)) {
        }
        if (k > n) return best;
        ++chosen[k];
        for (std::size_t l = k + 1; l <= n; ++l) chosen[l] = chosen[l - 1] + 1;
    }
}

/// The bound that multipliers prove, in plain arithmetic.
double proved(std::size_t n, std::vector<minimax_block> const& blocks,
              std::vector<minimax_weight> const& weights) {
    std::vector<double> slope(n, 0.0);
    double total = 0;
    double size = 0;
    for (auto const& w : weights) {
        auto const& b = blocks[w.block];
        total += w.value * b.offset[w.function] - std::abs(w.value) * b.margin[w.function];
        size += std::abs(w.value);
        for (std::size_t v = 0; v < b.variable.size(); ++v) {
            slope[b.variable[v]] += w.value * b.slope[v * b.functions() + w.function];
        }
    }
    for (double const s : slope) total -= std::abs(s);
    return total / size;
}

} // namespace

TEST_CASE("the minimax value is the least over all vertices, and the multipliers prove it") {
    draws d(71);
    for (int trial = 0; trial < 300; ++trial) {
        std::size_t const n = 1 + d.below(3);
        std::vector<std::size_t> all(n);
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::vector<minimax_block> const blocks{random_block(d, all, 1 + d.below(4)),
                                                random_block(d, {d.below(n)}, 1 + d.below(3))};
        auto const found = minimax_solver(n, blocks)();
        double const exact = by_vertices(n, blocks);
        INFO("trial " << trial << ", n " << n);
        CHECK_THAT(found.value, WithinAbs(exact, 1e-8));
        CHECK_THAT(height(blocks, found.point), WithinAbs(exact, 1e-8));
        CHECK_THAT(proved(n, blocks, found.weights), WithinAbs(exact, 1e-8));
        CHECK(found.weights.size() <= n + 1);
        double total = 0;
        for (auto const& w : found.weights) total += std::abs(w.value);
        CHECK_THAT(total, WithinAbs(1, 1e-9));
    }
}

TEST_CASE("many functions of many unknowns, shared and separate: point and proof meet") {
    draws d(72);
    for (int trial = 0; trial < 5; ++trial) {
        std::size_t const n = 33; // three shared ones and six for each of five blocks
        std::vector<minimax_block> blocks;
        for (std::size_t b = 0; b < 5; ++b) {
            std::vector<std::size_t> variable{0, 1, 2};
            for (std::size_t k = 0; k < 6; ++k) variable.push_back(3 + 6 * b + k);
            blocks.push_back(random_block(d, variable, 300));
        }
        auto const found = minimax_solver(n, blocks)();
        CHECK_THAT(height(blocks, found.point), WithinAbs(found.value, 1e-7));
        CHECK_THAT(proved(n, blocks, found.weights), WithinAbs(found.value, 1e-7));
        CHECK(found.exchanges < 40 * n);
    }
}

TEST_CASE("a program goes on with functions that have come") {
    draws d(73);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<minimax_block> blocks{random_block(d, {0, 1, 2}, 6)};
        minimax_solver growing(3, blocks);
        auto const before = growing();
        blocks.push_back(random_block(d, {2, 0}, 3));
        auto const after = growing();
        auto const fresh = minimax_solver(3, blocks)();
        CHECK(after.value >= before.value - 1e-9);
        CHECK_THAT(after.value, WithinAbs(fresh.value, 1e-9));
        CHECK_THAT(height(blocks, after.point), WithinAbs(after.value, 1e-8));
        CHECK_THAT(proved(3, blocks, after.weights), WithinAbs(after.value, 1e-8));
    }
}

TEST_CASE("what the minimax program does at its limits") {
    SECTION("nothing to bound") {
        auto const found = minimax_solver(2, {})();
        CHECK(found.value == -infinite);
        CHECK(found.weights.empty());
        CHECK(found.point == std::vector<double>{0, 0});
    }
    SECTION("functions that are taken out do not count") {
        std::vector<minimax_block> const blocks{{{0}, {0, 0}, {5, 0.25}, {infinite, 0}}};
        auto const found = minimax_solver(1, blocks)();
        CHECK_THAT(found.value, WithinAbs(0.25, 1e-9));
        REQUIRE(found.weights.size() == 1);
        CHECK(found.weights[0].function == 1);
    }
    SECTION("all of them out") {
        std::vector<minimax_block> const blocks{{{0}, {1}, {5}, {infinite}}};
        CHECK(minimax_solver(1, blocks)().weights.empty());
    }
    SECTION("no unknown at all") {
        std::vector<minimax_block> const blocks{{{}, {}, {0.5, -2, 1}, {0, 0.5, 0}}};
        auto const found = minimax_solver(0, blocks)();
        CHECK_THAT(found.value, WithinAbs(1.5, 1e-9));
        REQUIRE(found.weights.size() == 1);
        CHECK(found.weights[0].value == -1);
    }
    SECTION("two lines that cross") { // |d - 1/2| and |d + 1/2| are 1/2 at 0
        std::vector<minimax_block> const blocks{{{0}, {1, 1}, {-0.5, 0.5}, {0, 0}}};
        auto const found = minimax_solver(1, blocks)();
        CHECK_THAT(found.value, WithinAbs(0.5, 1e-9));
        CHECK_THAT(found.point[0], WithinAbs(0, 1e-12));
    }
    SECTION("numbers that are none end the work") {
        std::vector<minimax_block> const none{{{0}, {std::nan("")}, {1}, {0}}};
        CHECK(minimax_solver(1, none)().value == -infinite); // no function
        std::vector<minimax_block> const blocks{{{0}, {1}, {infinite}, {0}}};
        auto const found = minimax_solver(1, blocks)();
        CHECK(found.exchanges < 1000);
        CHECK(std::isnan(found.value)); // no bound, and none that is met
        CHECK(found.weights.empty());
    }
}
