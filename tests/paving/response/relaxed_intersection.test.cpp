// SPDX-License-Identifier: MIT
#include <sivid/paving/response/relaxed_intersection.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

TEST_CASE("the relaxed intersection is the hull of all points in at least n - q sets") {
    draws d(301);
    for (int round = 0; round < 2000; ++round) {
        std::vector<interval> sets(1 + d.below(8));
        for (auto& s : sets) {
            // Small integers, so that ends meet often; sometimes empty or unbounded.
            auto const a = static_cast<double>(d.below(9)) - 4;
            auto const b = a + static_cast<double>(d.below(5));
            s = d.below(12) == 0   ? interval_traits<interval>::empty()
                : d.below(12) == 0 ? between(a, HUGE_VAL)
                : d.below(12) == 0 ? between(-HUGE_VAL, b)
                                   : between(a, b);
        }
        auto const q = d.below(sets.size());
        auto const found = relaxed_intersection(sets, q);
        // Brute force over the quarter integers: all ends are integers.
        double lo = HUGE_VAL;
        double hi = -HUGE_VAL;
        for (int k = -60; k <= 60; ++k) {
            double const x = 0.25 * k;
            std::size_t in = 0;
            for (auto const& s : sets) in += contains(s, x) ? 1 : 0;
            if (in + q < sets.size()) continue;
            lo = std::fmin(lo, x);
            hi = std::fmax(hi, x);
        }
        CAPTURE(round, q, sets.size());
        if (lo > hi) {
            CHECK(is_empty(found));
            continue;
        }
        CHECK(found.lower() == (lo == -15 ? -HUGE_VAL : lo));
        CHECK(found.upper() == (hi == 15 ? HUGE_VAL : hi));
    }
}

TEST_CASE("a budget for all sets excludes nothing") {
    CHECK(is_entire(relaxed_intersection({between(0, 1), between(2, 3)}, 2)));
    CHECK(is_entire(relaxed_intersection({}, 0)));
    auto const empty = interval_traits<interval>::empty();
    CHECK(is_empty(relaxed_intersection({empty, between(0, 1)}, 0)));
    CHECK(relaxed_intersection({empty, between(0, 1)}, 1).upper() == 1);
}
