// SPDX-License-Identifier: MIT
// Packs as compiled with the flags of the build; each back end with flags of its own:
// tests/pack_backends.
#include "laws/containment.hpp"
#include "conformance/types.hpp"
#include "support/catch.hpp"

#include <cmath>

namespace {

/// One value of MPFR serves all types.
void check(std::size_t count, std::uint64_t seed) {
    for (auto const& m : laws::all_contained<SIVID_TESTED_TYPES SIVID_PROVEN_TYPES>(count, seed)) {
        INFO(m.first);
        CHECK(m.inputs >= count);
        CHECK(m.count == 0);
    }
}

} // namespace

TEST_CASE("every type contains what MPFR computes") {
    check(laws::containment_count(5'000), 20'240'101);
}

TEST_CASE("every type contains what MPFR computes, many inputs", "[.long]") {
    check(laws::containment_count(10'000'000), 7);
}

TEST_CASE("the check of containment finds what is not contained") {
    // The logarithm of the lower end, rounded to nearest.
    auto const m = laws::contained<sivid::interval>(
        "careless log", 1'000, 1, mpfr_log, [](sivid::interval const& a) {
            return sivid::interval{std::log(lower(a) > 0.0 ? lower(a) : 1.0)};
        });
    CHECK(m.count > 500);
    CHECK_THAT(m.first, StartsWith("careless log of ["));
}
