// SPDX-License-Identifier: MIT
#include <sivid/number/stream.hpp>

#include "number/support.hpp"

#include <iomanip>
#include <sstream>

using namespace sivid;

TEST_CASE("intervals and decimals to streams") {
    std::ostringstream out;
    out << make(0.5, 2) << ' ' << interval{0.1} << ' ' << nothing() << ' ' << make(1, inf) << ' '
        << -0.10_dec << ' ' << std::setw(10) << make(1, 2);
    CHECK(out.str() == "[0.5, 2] [0.1, 0.10000000000000001] [empty] [1, inf] -0.10     [1, 2]");
}
