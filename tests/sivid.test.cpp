// SPDX-License-Identifier: MIT
#include <sivid/sivid.hpp>

#include "support/catch.hpp"

// That the umbrella lists every public core header is checked in tests/architecture; here, that it
// compiles and that no optional package reaches a user of the core through it.
TEST_CASE("the umbrella header brings in the core and nothing else") {
    CHECK(sivid::version.size() >= 5);
#if defined(NLOHMANN_JSON_VERSION_MAJOR) || defined(FMT_VERSION) || defined(__MPFR_H) ||           \
    defined(TBB_VERSION_MAJOR)
    FAIL("an optional package was included");
#endif
}
