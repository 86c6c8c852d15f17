// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/gap/detail/error_sequence.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;

namespace {

/// Errors that keep this share of the one before.
std::vector<error_sequence> drawn(support::draws& d, std::size_t count, double kept) {
    std::vector<error_sequence> result(2);
    for (auto& r : result) {
        double e = d.uniform(-1, 1);
        for (std::size_t k = 0; k < count; ++k) {
            e = kept * e + std::sqrt(1 - kept * kept) * d.uniform(-1, 1);
            r.times.push_back(0.1 * static_cast<double>(k));
            r.errors.push_back(e);
        }
    }
    return result;
}

} // namespace

TEST_CASE("errors that go together are told, with for how long") {
    support::draws d(5);
    for (double const kept : {0.5, 0.8, 0.95}) {
        auto const found = correlation_of(drawn(d, 400, kept));
        REQUIRE(found);
        CHECK_THAT(found->of_neighbours, WithinAbs(kept, 0.1));
        CHECK_THAT(found->seconds, WithinRel(-0.1 / std::log(kept), 0.5));
    }
}

TEST_CASE("nothing is said of independent errors, of few, or of those that alternate") {
    support::draws d(6);
    for (int n = 0; n < 200; ++n) CHECK_FALSE(correlation_of(drawn(d, 5 + d.below(300), 0)));
    CHECK_FALSE(correlation_of(drawn(d, 6, 0.9)));
    CHECK_FALSE(correlation_of(drawn(d, 400, -0.8)));
    CHECK_FALSE(correlation_of({}));
    CHECK_FALSE(correlation_of({{{0.0}, {1.0}}}));
    CHECK_FALSE(correlation_of({{{0.0, 1.0}, {0.0, 0.0}}}));
}
