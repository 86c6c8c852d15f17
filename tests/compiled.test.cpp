// SPDX-License-Identifier: MIT
#include <sivid/compiled.hpp>

#include "support/catch.hpp"

#include <string>

#define SIVID_TEXT_OF(x) SIVID_TEXT(x)
#define SIVID_TEXT(x) #x

TEST_CASE("entry functions are inline but where a library defines them") {
    std::string const specifier = "" SIVID_TEXT_OF(SIVID_DECL);
#ifdef SIVID_COMPILED
    CHECK(specifier.find("inline") == std::string::npos);
#else
    CHECK(specifier == "inline");
#endif
}
