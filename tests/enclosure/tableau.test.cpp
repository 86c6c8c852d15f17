// SPDX-License-Identifier: MIT
#include <sivid/enclosure/tableau.hpp>

#include "support/catch.hpp"
#include "support/power_series.hpp"

using namespace sivid;
using support::encloses;
using support::mp;

namespace {

mp exact(ratio const& r) { return mp(r.numerator) / r.denominator; }

/// The order conditions of trees with up to four nodes, in exact fractions up to 50 digits.
std::size_t proved_order(tableau const& m) {
    auto const s = m.stages();
    auto const a = [&](std::size_t i, std::size_t j) { return j < i ? exact(m.a[i][j]) : mp(0); };
    auto const sum = [s](auto const& f) {
        mp total = 0;
        for (std::size_t i = 0; i < s; ++i) total += f(i);
        return total;
    };
    auto const b = [&](std::size_t i) { return exact(m.b[i]); };
    auto const c = [&](std::size_t i) { return exact(m.c[i]); };
    auto const ac = [&](std::size_t i) { return sum([&](std::size_t j) { return mp(a(i, j) * c(j)); }); };
    auto const near = [](mp const& x, mp const& y) { return abs(x - y) < 1e-40; };
    for (std::size_t i = 0; i < s; ++i) {
        if (!near(sum([&](std::size_t j) { return a(i, j); }), c(i))) return 0;
    }
    if (!near(sum(b), 1)) return 0;
    if (!near(sum([&](auto i) { return mp(b(i) * c(i)); }), mp(1) / 2)) return 1;
    if (!near(sum([&](auto i) { return mp(b(i) * c(i) * c(i)); }), mp(1) / 3)) return 2;
    if (!near(sum([&](auto i) { return mp(b(i) * ac(i)); }), mp(1) / 6)) return 2;
    if (!near(sum([&](auto i) { return mp(b(i) * c(i) * c(i) * c(i)); }), mp(1) / 4)) return 3;
    if (!near(sum([&](auto i) { return mp(b(i) * c(i) * ac(i)); }), mp(1) / 8)) return 3;
    auto const acc = [&](std::size_t i) {
        return sum([&](std::size_t j) { return mp(a(i, j) * c(j) * c(j)); });
    };
    auto const aac = [&](std::size_t i) {
        return sum([&](std::size_t j) { return mp(a(i, j) * ac(j)); });
    };
    if (!near(sum([&](auto i) { return mp(b(i) * acc(i)); }), mp(1) / 12)) return 3;
    if (!near(sum([&](auto i) { return mp(b(i) * aac(i)); }), mp(1) / 24)) return 3;
    return 4;
}

} // namespace

TEST_CASE("the shipped tableaux have the order that they state") {
    CHECK_NOTHROW(heun().require_explicit());
    CHECK_NOTHROW(rk4().require_explicit());
    CHECK(proved_order(heun()) == heun().order);
    CHECK(proved_order(rk4()) == rk4().order);
    CHECK(heun().order == 2);
    CHECK(rk4().order == 4);
    CHECK(rk4().stages() == 4);
}

TEST_CASE("fractions are enclosed exactly") {
    CHECK(encloses(ratio{1, 6}.enclose<interval>(), mp(1) / 6));
    CHECK(width(ratio{1, 6}.enclose<interval>()) < 1e-16);
    CHECK(is_point(ratio{3, 4}.enclose<interval>()));
    CHECK(encloses(ratio{-7, 3}.enclose<interval>(), mp(-7) / 3));
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
