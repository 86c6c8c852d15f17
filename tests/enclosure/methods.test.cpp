// SPDX-License-Identifier: MIT
// Shapes of the implicit methods, and what distinguishes the families: the simplifying conditions
// of their nodes. That they have their orders is tested with the rooted trees in
// order_conditions.test.cpp.
#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"
#include "support/runge_kutta.hpp"

#include <set>
#include <string>

using namespace sivid;
using support::exact;
using support::mp;

namespace {

bool zero(mp const& x) { return abs(x) < 1e-40; }

/// B(q): the weights integrate polynomials of degree q - 1.
std::size_t quadrature_order(tableau const& m) {
    for (std::size_t q = 1;; ++q) {
        mp sum = -mp(1) / q;
        for (std::size_t i = 0; i < m.stages(); ++i) {
            sum += exact(m.b[i]) * pow(exact(m.c[i]), static_cast<int>(q - 1));
        }
        if (!zero(sum)) return q - 1;
    }
}
/// C(q): the stages do.
std::size_t stage_order(tableau const& m) {
    for (std::size_t q = 1;; ++q) {
        for (std::size_t i = 0; i < m.stages(); ++i) {
            mp sum = -pow(exact(m.c[i]), static_cast<int>(q)) / q;
            for (std::size_t j = 0; j < m.stages(); ++j) {
                sum += exact(m.a[i][j]) * pow(exact(m.c[j]), static_cast<int>(q - 1));
            }
            if (!zero(sum)) return q - 1;
        }
    }
}
bool stiffly_accurate(tableau const& m) {
    for (std::size_t j = 0; j < m.stages(); ++j) {
        if (!zero(exact(m.a.back()[j]) - exact(m.b[j]))) return false;
    }
    return true;
}

} // namespace

TEST_CASE("Gauss: order 2s, stages of order s") {
    std::size_t s = 0;
    for (auto const& m : {gauss2(), gauss4(), gauss6()}) {
        ++s;
        CAPTURE(m.name);
        CHECK_NOTHROW(m.require_implicit());
        CHECK(m.stages() == s);
        CHECK(m.order == 2 * s);
        CHECK(quadrature_order(m) == 2 * s);
        CHECK(stage_order(m) == s);
        CHECK_FALSE(stiffly_accurate(m));
    }
}

TEST_CASE("Radau IIA: order 2s - 1, stages of order s, ends in a stage") {
    std::size_t s = 1;
    for (auto const& m : {radau_iia3(), radau_iia5()}) {
        ++s;
        CAPTURE(m.name);
        CHECK_NOTHROW(m.require_implicit());
        CHECK(m.stages() == s);
        CHECK(m.order == 2 * s - 1);
        CHECK(quadrature_order(m) == 2 * s - 1);
        CHECK(stage_order(m) == s);
        CHECK(stiffly_accurate(m));
    }
}

TEST_CASE("Lobatto IIIC: order 2s - 2, stages of order s - 1, begins and ends in a stage") {
    std::size_t s = 1;
    for (auto const& m : {lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()}) {
        ++s;
        CAPTURE(m.name);
        CHECK_NOTHROW(m.require_implicit());
        CHECK(m.stages() == s);
        CHECK(m.order == 2 * s - 2);
        CHECK(quadrature_order(m) == 2 * s - 2);
        CHECK(stage_order(m) == s - 1);
        CHECK(stiffly_accurate(m));
        CHECK(zero(exact(m.c.front())));
        for (std::size_t i = 0; i < s; ++i) CHECK(zero(exact(m.a[i][0]) - exact(m.b[0])));
    }
}

TEST_CASE("a tableau with rows of other lengths is no implicit method") {
    auto m = gauss4();
    m.a[0].pop_back();
    CHECK_THROWS_WITH(m.require_implicit(), ContainsSubstring("gauss4"));
    CHECK_FALSE(m.is_explicit());
    CHECK_THROWS(rk4().require_implicit());
}

TEST_CASE("the shipped methods are what they claim, each with a name of its own") {
    std::set<std::string> names;
    for (auto const& m : shipped_methods()) {
        CAPTURE(m.name);
        CHECK(names.insert(m.name).second);
        CHECK_NOTHROW(require_order(m));
    }
    CHECK(names.size() == 14);
    CHECK(names.count("rk4") == 1);
}
