// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/best_window.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

using namespace sivid;

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
