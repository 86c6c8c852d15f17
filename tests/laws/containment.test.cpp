// SPDX-License-Identifier: MIT
#include "laws/containment.hpp"
#include "support/catch.hpp"

#include <sivid/number/interval_traits.hpp>

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

TEST_CASE("the vocabulary type contains what MPFR computes") {
    check<sivid::interval>(laws::containment_count(20'000), 20'240'101);
}

TEST_CASE("the vocabulary type contains what MPFR computes, many inputs", "[.long]") {
    check<sivid::interval>(laws::containment_count(10'000'000), 7);
}
