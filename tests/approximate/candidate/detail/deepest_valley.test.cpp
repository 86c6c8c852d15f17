// SPDX-License-Identifier: MIT
#include <sivid/approximate/candidate/detail/deepest_valley.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;

TEST_CASE("of two valleys the deeper one is found, though the grid is lower in the other") {
    // Narrow and deep at 0.377, wide and shallow at 0.75, which is a place of the grid.
    auto const narrow = [](double x) { return std::min(8 * std::abs(x - 0.377), 1.0); };
    auto const wide = [](double x) { return 0.02 + 2 * std::abs(x - 0.75); };
    auto const both = [&](double x) { return std::min(narrow(x), wide(x)); };
    auto const mirrored = [&](double x) { return both(1 - x); };
    CHECK(both(0.375) > 0.0159);
    auto const at = [&](std::vector<double> const& x) {
        return std::vector<double>{both(x[0]), mirrored(x[1]), 1};
    };
    auto const found = deepest_valley(at, {0.9, 0.9, 0.25}, 32, 1e-5);
    CHECK_THAT(found[0], WithinAbs(0.377, 1e-4));
    CHECK_THAT(found[1], WithinAbs(0.623, 1e-4));
    CHECK(found[2] == 0.25); // it stays where nothing is better
    auto const coarse = deepest_valley(at, {0.9, 0.9, 0.25}, 20, 1);
    CHECK(coarse[0] == 0.75);
    // Better where it is than anywhere on the grid.
    CHECK(deepest_valley(at, {0.377, 0.1, 0.3}, 8, 1)[0] == 0.377);
}

TEST_CASE("no other window gains more") {
    support::draws d(4);
    for (int n = 0; n < 500; ++n) {
        std::vector<double> gains, shares;
        double at = 0;
        for (std::size_t k = d.below(12); k > 0; --k) {
            if (!d.coin()) at += d.uniform(0.0, 0.09); // several at one time
            shares.push_back(at);
            gains.push_back(d.uniform(-1.0, 1.0));
        }
        auto const gained = [&](double on, double off) {
            double sum = 0;
            for (std::size_t k = 0; k < gains.size(); ++k)
                if (on <= shares[k] && shares[k] < off) sum += gains[k];
            return sum;
        };
        for (auto const ends : {episode_ends{true, false}, {false, true}, {true, true}}) {
            auto const best = best_window(gains, shares, ends);
            if (!ends.begins) CHECK(best.on < 0);
            if (!ends.ends) CHECK(best.off > 1);
            double most = 0; // never on
            for (double on = -0.05; on < 1.1; on += 0.01)
                for (double off = on; off < 1.1; off += 0.01)
                    if ((ends.begins || on < 0) && (ends.ends || off > 1))
                        most = std::max(most, gained(on, off));
            CHECK(gained(best.on, best.off) >= most - 1e-12);
        }
    }
}
