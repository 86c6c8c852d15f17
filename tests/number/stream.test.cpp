// SPDX-License-Identifier: MIT
#include <sivid/number/stream.hpp>

#include <sivid/number/polynomial/univariate_taylor.hpp>

#include "number/support.hpp"

#include <iomanip>
#include <sstream>

using namespace sivid;

namespace {
template <class T>
concept written = requires(std::ostream& out, T x) {
    out << x;
};
} // namespace

TEST_CASE("intervals and decimals to streams") {
    std::ostringstream out;
    out << make(0.5, 2) << ' ' << interval{0.1} << ' ' << nothing() << ' ' << make(1, inf) << ' '
        << -0.10_dec << ' ' << std::setw(10) << make(1, 2);
    CHECK(out.str() == "[0.5, 2] [0.1, 0.10000000000000001] [empty] [1, inf] -0.10     [1, 2]");
}

// A test framework asks this of all that it compares, for instance of enumerations.
TEST_CASE("what is no interval is not written as one") {
    STATIC_REQUIRE(written<interval>);
    STATIC_REQUIRE_FALSE(written<univariate>);
}
