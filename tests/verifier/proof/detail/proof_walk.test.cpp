// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/exclusion_check.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <random>
#include <vector>

using namespace sivid;
using kind = proof_step::kind;

TEST_CASE("whatever a proof says each point is in a row or proved or left open") {
    std::mt19937 random(5);
    auto const uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    box const prior{interval(0, 1), interval(-1, 1)};
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<box> rows;
        for (int k = 0; k < 3; ++k) {
            double const x = uniform(0, 0.9), y = uniform(-1, 0.8);
            rows.push_back({interval(x, x + 0.1), interval(y, y + 0.2)});
        }
        proof_walk walk(prior, rows, 1);
        std::vector<box> proved;
        for (int n = 0; n < 40 && !walk.done(); ++n) {
            // Kinds, sides and places of all sorts, also such as do not exist.
            proof_step const step{static_cast<kind>(1 + random() % 4), random() % 3,
                                  random() % 2 == 0, uniform(-1.2, 1.2)};
            walk.take(step, [&](response_list const&, box const& part) {
                bool const says = random() % 2 == 0;
                if (says) proved.push_back(part);
                return says;
            });
        }
        auto const open = std::move(walk).open();
        for (int k = 0; k < 300; ++k) {
            std::vector<double> const p{uniform(0, 1), uniform(-1, 1)};
            auto const in = [&](std::vector<box> const& list) {
                for (auto const& b : list) {
                    if (contains(b, p)) return true;
                }
                return false;
            };
            REQUIRE((in(rows) || in(proved) || in(open)));
        }
    }
}
