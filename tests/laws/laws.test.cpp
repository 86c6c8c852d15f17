// SPDX-License-Identifier: MIT
#include "laws/laws.hpp"
#include "conformance/types.hpp"
#include "support/catch.hpp"

namespace {

void require_none(std::vector<std::string> const& failures) {
    for (auto const& failure : failures) UNSCOPED_INFO(failure);
    CHECK(failures.empty());
}

} // namespace

TEMPLATE_TEST_CASE("every type obeys the laws", "", SIVID_TESTED_TYPES SIVID_PROVEN_TYPES) {
    require_none(laws::all<TestType>(2'000, 42));
}

TEMPLATE_TEST_CASE("every type obeys the laws, many inputs", "[.long]",
                   SIVID_TESTED_TYPES SIVID_PROVEN_TYPES) {
    require_none(laws::all<TestType>(200'000, 43));
}
