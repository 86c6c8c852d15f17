// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/cut_program.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

minimax_block random_block(draws& d, std::size_t unknowns, std::size_t functions, double margin) {
    minimax_block b;
    for (std::size_t v = 0; v < unknowns; ++v) b.variable.push_back(v);
    for (std::size_t k = 0; k < unknowns * functions; ++k) b.slope.push_back(d.uniform(-1, 1));
    for (std::size_t y = 0; y < functions; ++y) {
        b.offset.push_back(d.uniform(-0.3, 0.3));
        b.margin.push_back(margin);
    }
    return b;
}

/// What the multipliers prove in doubles: sum |w| margin - min (sum w f -+ d_j).
double proved(std::vector<minimax_block> const& blocks, approximate_cut const& cut, std::size_t n,
              std::size_t j, double direction) {
    std::vector<double> slope(n, 0.0);
    slope[j] = -direction;
    double bound = 0;
    for (auto const& w : cut.weights) {
        auto const& b = blocks[w.block];
        bound += std::abs(w.value) * b.margin[w.function] - w.value * b.offset[w.function];
        for (std::size_t v = 0; v < b.variable.size(); ++v) {
            slope[b.variable[v]] += w.value * b.slope[v * b.functions() + w.function];
        }
    }
    for (double const s : slope) bound += std::abs(s);
    return bound;
}

bool meets(std::vector<minimax_block> const& blocks, std::vector<double> const& d) {
    for (auto const& b : blocks) {
        for (std::size_t y = 0; y < b.functions(); ++y) {
            double f = b.offset[y];
            for (std::size_t v = 0; v < b.variable.size(); ++v) {
                f += b.slope[v * b.functions() + y] * d[b.variable[v]];
            }
            if (std::abs(f) > b.margin[y]) return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("the multipliers of a cut prove how far an unknown can go, and no point goes further") {
    draws d(201);
    int tight = 0;
    int empty = 0;
    for (int trial = 0; trial < 300; ++trial) {
        std::size_t const n = 1 + d.below(3);
        std::vector const blocks{random_block(d, n, 1 + d.below(8), d.uniform(0.1, 1)),
                                 random_block(d, n, d.below(4), 0.5)};
        auto const j = d.below(n);
        bool const upwards = d.coin();
        double const direction = upwards ? 1 : -1;
        auto const cut = cut_program(n, blocks)(j, upwards);
        double furthest = -2;
        for (int sample = 0; sample < 3000; ++sample) {
            std::vector<double> x;
            for (std::size_t v = 0; v < n; ++v) x.push_back(d.uniform(-1, 1));
            if (meets(blocks, x)) furthest = std::max(furthest, direction * x[j]);
        }
        if (cut.empty) {
            ++empty;
            CHECK(furthest == -2);
            continue;
        }
        double const bound = proved(blocks, cut, n, j, direction);
        CHECK(furthest <= bound + 1e-9);
        CHECK(std::abs(direction * cut.point[j] - bound) < 1e-6);
        tight += furthest > bound - 0.1 ? 1 : 0;
    }
    CHECK(tight > 150);
    CHECK(empty > 10);
}

TEST_CASE("without constraints an unknown goes to its bound, and an infinite margin is none") {
    std::vector<minimax_block> blocks;
    CHECK(cut_program(2, blocks)(1, true).weights.empty());
    draws d(202);
    blocks.push_back(random_block(d, 2, 3, std::numeric_limits<double>::infinity()));
    CHECK(cut_program(2, blocks)(0, false).weights.empty());
}

TEST_CASE("two constraints that contradict each other are told to") {
    minimax_block b; // |d0 + 0.5| <= 0.1 and |d0 - 0.5| <= 0.1
    b.variable = {0};
    b.slope = {1, 1};
    b.offset = {0.5, -0.5};
    b.margin = {0.1, 0.1};
    std::vector const blocks{b};
    auto const cut = cut_program(1, blocks)(0, true);
    CHECK(cut.empty);
    CHECK(cut.weights.size() == 2);
}
