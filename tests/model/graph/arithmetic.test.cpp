// SPDX-License-Identifier: MIT
#include <sivid/model/graph/arithmetic.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <limits>
#include <type_traits>

using namespace sivid;
using support::between;

TEST_CASE("intervals prove, doubles approximate") {
    STATIC_REQUIRE(std::is_same_v<arithmetic_of<double>, approximate_arithmetic>);
    STATIC_REQUIRE(std::is_same_v<arithmetic_of<interval>, proven_arithmetic<interval>>);
    STATIC_REQUIRE(std::is_same_v<arithmetic_of<interval>::value_type, interval>);
}

TEST_CASE("the sign of a set that touches zero is everything between") {
    using proven = proven_arithmetic<interval>;
    double const tiny = std::numeric_limits<double>::denorm_min();
    for (auto const& x : {between(0, 0), between(0, 1), between(-1, 0), between(-1, 1)}) {
        auto const s = proven::sign(x);
        CAPTURE(x.lower(), x.upper());
        CHECK(s.lower() == (x.lower() > 0 ? 1 : -1));
        CHECK(s.upper() == 1);
    }
    CHECK(proven::sign(between(1e-300, 1)).lower() == 1);
    CHECK(proven::sign(between(-2, -1e-300)).upper() == -1);
    // Next to zero a wider set is allowed, a narrower one is not.
    CHECK(contains(proven::sign(between(tiny, tiny)), 1.0));
    CHECK(contains(proven::sign(between(-tiny, -tiny)), -1.0));
}

TEST_CASE("approximate arithmetic lies within the proven one") {
    support::draws d(151);
    using exact = proven_arithmetic<interval>;
    using fast = approximate_arithmetic;
    bool cut = false;
    for (int round = 0; round < 300; ++round) {
        double const a = d.uniform(0.1, 3);
        double const b = d.uniform(0.1, 3);
        interval const x(a);
        interval const y(b);
        auto const slack = [](interval const& v) { return exact::add(v, between(-1e-13, 1e-13)); };
        CHECK(contains(slack(exact::add(x, y)), fast::add(a, b)));
        CHECK(contains(slack(exact::sub(x, y)), fast::sub(a, b)));
        CHECK(contains(slack(exact::mul(x, y)), fast::mul(a, b)));
        CHECK(contains(slack(exact::div(x, y, cut)), fast::div(a, b, cut)));
        CHECK(contains(slack(exact::pown(x, 5, cut)), fast::pown(a, 5, cut)));
        CHECK(contains(slack(exact::sqrt(x, cut)), fast::sqrt(a, cut)));
        CHECK(contains(slack(exact::log(x, cut)), fast::log(a, cut)));
        CHECK(contains(slack(exact::exp(x)), fast::exp(a)));
        CHECK(contains(slack(exact::tanh(x)), fast::tanh(a)));
        CHECK(contains(slack(exact::atan(x)), fast::atan(a)));
        CHECK(contains(slack(exact::sin(x)), fast::sin(a)));
        CHECK(contains(slack(exact::cos(x)), fast::cos(a)));
        CHECK(fast::min(a, b) == std::min(a, b));
        CHECK(fast::max(a, b) == std::max(a, b));
        CHECK(fast::abs(-a) == a);
        CHECK(fast::sign(-a) == -1);
        CHECK(fast::sqr(a) == a * a);
        CHECK(fast::neg(a) == -a);
    }
    CHECK(fast::sign(0) == 0);
    CHECK_FALSE(cut);
}
