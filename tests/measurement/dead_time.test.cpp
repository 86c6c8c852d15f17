// SPDX-License-Identifier: MIT
#include <sivid/measurement/dead_time.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>

using namespace sivid;

TEST_CASE("what happens is seen a dead time later, and the other way round") {
    support::draws d(3);
    for (int n = 0; n < 1000; ++n) {
        double const begin = d.uniform(-2.0, 2.0), s = begin + d.uniform(0.0, 5.0);
        dead_time const late{d.below(3) == 0 ? 0 : d.uniform(0.0, 2.0),
                             d.below(3) == 0 ? 0 : d.uniform(0.0, 0.9)};
        double const t = late.seen(s, begin);
        CHECK_THAT(t - s, WithinAbs(late.delay + late.drift * (t - begin), 1e-12));
        CHECK_THAT(late.source(t, begin), WithinAbs(s, 1e-12));
        CHECK(late.source(begin - 1, begin) == begin);
        CHECK(late.any() == (late.delay > 0 || late.drift > 0));
    }
    dead_time const stands{0.5, 1.25};
    CHECK(stands.source(7, 2) == 2);
    CHECK(std::isinf(stands.seen(3, 2)));
}
