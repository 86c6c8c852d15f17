// SPDX-License-Identifier: MIT
// Catch2 with the names of version 3, also on version 2.13.
#ifndef SIVID_TESTS_SUPPORT_CATCH_HPP
#define SIVID_TESTS_SUPPORT_CATCH_HPP

#include <iostream>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>

#include <string>

namespace Catch::Matchers {
inline auto ContainsSubstring(std::string const& text) { return Contains(text); }
} // namespace Catch::Matchers
#endif

/// Ends a test case that lacks what it needs, so that ctest counts it as skipped: on the line
/// "test skipped: ...", which version 2 prints and returns behind, since it knows no such end.
#if defined(SKIP)
#define SIVID_SKIP(why) SKIP("test skipped: " << why)
#else
#define SIVID_SKIP(why)                                                                            \
    do {                                                                                           \
        std::cout << "test skipped: " << why << std::endl;                                         \
        return;                                                                                    \
    } while (false)
#endif

// Usable unqualified in either version.
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

#endif // SIVID_TESTS_SUPPORT_CATCH_HPP
