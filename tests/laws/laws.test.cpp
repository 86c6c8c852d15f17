// SPDX-License-Identifier: MIT
#include "laws/laws.hpp"
#include "support/catch.hpp"

#include <sivid/number/interval_traits.hpp>

namespace {

void require_none(std::vector<std::string> const& failures) {
    for (auto const& failure : failures) UNSCOPED_INFO(failure);
    CHECK(failures.empty());
}

} // namespace

TEST_CASE("the vocabulary type obeys the laws") {
    require_none(laws::all<sivid::interval>(10'000, 42));
}

TEST_CASE("the vocabulary type obeys the laws, many inputs", "[.long]") {
    require_none(laws::all<sivid::interval>(1'000'000, 43));
}
