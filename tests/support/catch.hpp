// SPDX-License-Identifier: MIT
// Catch2 with the names of version 3, also on version 2.13.
#ifndef SIVID_TESTS_SUPPORT_CATCH_HPP
#define SIVID_TESTS_SUPPORT_CATCH_HPP

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>

#include <string>

namespace Catch::Matchers {
inline auto ContainsSubstring(std::string const& text) { return Contains(text); }
} // namespace Catch::Matchers
#endif

// Usable unqualified in either version.
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

#endif // SIVID_TESTS_SUPPORT_CATCH_HPP
