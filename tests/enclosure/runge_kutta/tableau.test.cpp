// SPDX-License-Identifier: MIT
#include <sivid/enclosure/runge_kutta/tableau.hpp>

#include "support/catch.hpp"
#include "support/power_series.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/number/interval.hpp>

using namespace sivid;
using support::encloses;
using support::mp;

TEST_CASE("fractions and roots are enclosed tightly") {
    CHECK(encloses(surd{1, 6}.enclose<interval>(), mp(1) / 6));
    CHECK(width(surd{1, 6}.enclose<interval>()) < 1e-16);
    CHECK(is_point(surd{3, 4}.enclose<interval>()));
    CHECK(encloses(surd{-7, 3}.enclose<interval>(), mp(-7) / 3));
    for (int const r : {2, 3, 5, 6, 15}) {
        for (int const f : {-169, -1, 1, 7}) {
            surd const x{296, 1800, f, r};
            mp const exact = (296 + f * sqrt(mp(r))) / 1800;
            CHECK(encloses(x.enclose<interval>(), exact));
            CHECK_FALSE(encloses(x.enclose<interval>(), exact + mp(1e-15)));
            CHECK_FALSE(encloses(x.enclose<interval>(), exact - mp(1e-15)));
        }
    }
    CHECK(is_point(surd{1, 2, 3, 4}.enclose<interval>())); // (1 + 3 * 2) / 2
    CHECK(contains(surd{1, 2, 3, 4}.enclose<interval>(), 3.5));
}

TEST_CASE("the shipped explicit methods have their shape") {
    std::size_t stages = 0;
    for (auto const& m :
         {explicit_midpoint(), heun(), kutta3(), rk4(), dormand_prince5(), butcher6()}) {
        CAPTURE(m.name);
        CHECK(m.is_explicit());
        CHECK_NOTHROW(m.require_explicit());
        CHECK_THROWS_WITH(m.require_implicit(), ContainsSubstring(m.name));
        stages += m.stages();
    }
    CHECK(stages == 2 + 2 + 3 + 4 + 6 + 7);
    CHECK(rk4().order == 4);
    CHECK(butcher6().order == 6);
}

TEST_CASE("tableaux that are not explicit methods are refused") {
    auto const bad = [](tableau m) {
        CHECK_THROWS_WITH(m.require_explicit(), ContainsSubstring(m.name));
    };
    auto m = rk4();
    m.a[2].push_back({1, 2});
    bad(m);
    m = rk4();
    m.b.pop_back();
    bad(m);
    m = rk4();
    m.c.clear();
    bad(m);
    m = rk4();
    m.order = 0;
    bad(m);
    m = tableau{};
    m.name = "nothing";
    bad(m);
}
