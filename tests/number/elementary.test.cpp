// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>

namespace {

/// A user's generic code: standard functions for doubles, found by their arguments for intervals.
template <class T>
T generic(T const& x) {
    using std::exp;
    using std::sin;
    return exp(sin(x)) + sin(exp(x));
}

} // namespace

TEST_CASE("elementary functions are found by their argument") {
    sivid::interval const x = 0.25;
    CHECK(contains(generic(x), generic(0.25)));
    CHECK(width(generic(x)) < 1e-14);
    CHECK(contains(atan2(x, x), 0x1.921fb54442d18p-1));
    CHECK(contains(cosh(x), 1.03141309987957319));
}

TEST_CASE("elementary functions keep the caller's rounding mode and do not depend on it") {
    auto const all = [](sivid::interval const& x) {
        return std::array{sivid::exp(x),    sivid::log(x),      sivid::sin(x),
                          sivid::cos(x),    sivid::tan(x),      sivid::atan(x),
                          sivid::tanh(x),   sivid::sinh(x),     sivid::cosh(x),
                          sivid::asin(x),   sivid::acos(x),     sivid::sqrt(x),
                          sivid::expm1(x),  sivid::log1p(x),    sivid::pown(x, 9),
                          sivid::pow(x, x), sivid::hypot(x, x), sivid::atan2(x, x)};
    };
    oracle::inputs in{1};
    for (int i = 0; i < 500; ++i) {
        double const a = in.uniform(0.0, 1.0);
        sivid::interval const x = make(a, a + in.uniform(0.0, 0.1));
        auto const expected = all(x);
        for (int const mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            std::fesetround(mode);
            auto const got = all(x);
            int const after = std::fegetround();
            std::fesetround(FE_TONEAREST);
            REQUIRE(after == mode);
            for (std::size_t k = 0; k < got.size(); ++k) {
                INFO("function " << k);
                REQUIRE(equal(got[k], expected[k]));
            }
        }
    }
}
