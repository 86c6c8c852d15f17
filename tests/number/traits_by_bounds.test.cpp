// SPDX-License-Identifier: MIT
#include <sivid/number/traits_by_bounds.hpp>

#include "laws/containment.hpp"
#include "laws/laws.hpp"
#include "number/support.hpp"

namespace {

/// A type that stores bounds with the greater first and marks emptiness by a flag.
struct turned {
    double high = 0.0, low = 0.0;
    bool none = false;
};

} // namespace

template <>
struct sivid::interval_traits<turned> : sivid::traits_by_bounds<turned> {
    static turned bounds(double lo, double hi) {
        interval const x = detail::bounded(lo, hi);
        return {x.upper(), x.lower(), sivid::is_empty(x)};
    }
    static turned empty() { return {0.0, 0.0, true}; }
    static double lower(turned const& a, std::size_t = 0) {
        return a.none ? detail::not_a_number : a.low;
    }
    static double upper(turned const& a, std::size_t = 0) {
        return a.none ? detail::not_a_number : a.high;
    }
};

TEST_CASE("four functions make a complete interval type") {
    STATIC_REQUIRE(sivid::interval_scalar<turned>);
    auto const failures = laws::all<turned>(2'000, 5);
    for (auto const& failure : failures) UNSCOPED_INFO(failure);
    CHECK(failures.empty());
    for (auto const& m : laws::all_contained<turned>(2'000, 6)) {
        INFO(m.first);
        CHECK(m.count == 0);
    }
    CHECK(sivid::interval_traits<turned>::mid(sivid::interval_traits<turned>::bounds(1, 3)) == 2.0);
}
