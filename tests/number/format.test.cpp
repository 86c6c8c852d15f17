// SPDX-License-Identifier: MIT
#if __has_include(<fmt/format.h>)

#if !defined(FMT_HEADER_ONLY)
#define FMT_HEADER_ONLY
#endif
#include <sivid/number/format.hpp>

#include "number/support.hpp"

using namespace sivid;

TEST_CASE("intervals in fmt, outward") {
    CHECK(fmt::format("{}", make(0.5, 2)) == "[0.5, 2]");
    CHECK(fmt::format("{}", interval{0.1}) == "[0.1, 0.10000000000000001]");
    CHECK(fmt::format("{:.3}", make(0.123456, 0.123456)) == "[0.123, 0.124]");
    CHECK(fmt::format("{:>12}", make(0.5, 2)) == "    [0.5, 2]");
    CHECK(fmt::format("{:*^12.2}", make(0.5, 2)) == "**[0.5, 2]**");
    CHECK(fmt::format("{:<10}|", nothing()) == "[empty]   |");
    CHECK_THROWS_AS(fmt::format(fmt::runtime("{:x}"), make(0.5, 2)), fmt::format_error);
    CHECK_THROWS_AS(fmt::format(fmt::runtime("{:.}"), make(0.5, 2)), fmt::format_error);
}

#endif
