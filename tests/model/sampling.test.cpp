// SPDX-License-Identifier: MIT
#include <sivid/model/sampling.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("lengths of time are told by the samples and the record, in any unit") {
    for (double const unit : {1.0, 0x1p-20, 0x1p20}) {
        experiment dense, sparse;
        dense.begin = 2 * unit;
        for (int k = 1; k <= 40; ++k) dense.measurements.push_back({(2 + 0.25 * k) * unit, 0, {}});
        for (int k = 1; k <= 2; ++k) sparse.measurements.push_back({3.0 * k * unit, 1, {}});
        // The other channel of an experiment, a little later: no gap of its own.
        dense.measurements.push_back({2.26 * unit, 1, {}});
        auto const seen = sampling_of({dense, sparse});
        CHECK(seen.gap == 0.25 * unit);
        CHECK(seen.record == 10 * unit);
        CHECK(seen.span(3, 0.01) == 0.75 * unit);
        CHECK(seen.span(3, 0.5) == 5 * unit);
        CHECK(seen.span(100, 0.5) == 10 * unit);
    }
}

TEST_CASE("what is measured once at the begin, or never, spans no time") {
    experiment once;
    once.begin = 1;
    CHECK(sampling_of({once}).span(3, 0.5) == 0);
    once.measurements = {{1, 0, {}}};
    CHECK(sampling_of({once}).span(3, 0.5) == 0);
    CHECK(sampling_of({}).record == 0);
}
