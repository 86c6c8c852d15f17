// SPDX-License-Identifier: MIT
// Packs as compiled with the flags of the build; each back end with flags of its own:
// tests/pack_backends.
#include <sivid/number/pack_functions.hpp>

#include "support/catch.hpp"

#if defined(SIVID_HAS_MPFR)

#include "laws/containment.hpp"

namespace {

template <class I>
void check(std::size_t count, std::uint64_t seed) {
    for (auto const& m : laws::all_contained<I>(count, seed)) {
        INFO(m.first);
        CHECK(m.inputs >= count);
        CHECK(m.count == 0);
    }
}

} // namespace

TEST_CASE("packs contain what MPFR computes") {
    check<sivid::pack<8>>(laws::containment_count(20'000), 31);
}

TEST_CASE("packs contain what MPFR computes, many inputs", "[.long]") {
    check<sivid::pack<8>>(laws::containment_count(10'000'000), 32);
}

#else
TEST_CASE("packs contain what MPFR computes") { WARN("skipped: MPFR is not installed"); }
#endif
