// SPDX-License-Identifier: MIT
// The order conditions of all rooted trees: in interval arithmetic, tightly, and in 100 digits by an
// evaluation of its own; one order more must fail.

#include "support/catch.hpp"
#include "support/runge_kutta.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>

#include <functional>

using namespace sivid;
using support::exact;
using support::mp;

namespace {

std::vector<tableau> shipped() {
    return {
        explicit_midpoint(), heun(),          kutta3(),        rk4(),          dormand_prince5(),
        butcher6(),          gauss2(),        gauss4(),        gauss6(),       radau_iia3(),
        radau_iia5(),        lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()};
}

/// The largest residual of the trees with up to `order` nodes, straight from the definition.
mp largest_residual(tableau const& m, std::size_t order) {
    auto const trees = rooted_trees(order);
    std::function<mp(std::size_t, std::size_t)> const weight = [&](std::size_t tree,
                                                                   std::size_t i) {
        mp product = 1;
        for (auto const child : trees[tree].children) {
            mp sum = 0;
            for (std::size_t j = 0; j < m.a[i].size(); ++j) {
                sum += exact(m.a[i][j]) * weight(child, j);
            }
            product *= sum;
        }
        return product;
    };
    std::function<mp(std::size_t)> const density = [&](std::size_t tree) {
        mp product = trees[tree].nodes;
        for (auto const child : trees[tree].children) product *= density(child);
        return product;
    };
    mp worst = 0;
    for (std::size_t t = 0; t < trees.size(); ++t) {
        mp sum = -1 / density(t);
        for (std::size_t i = 0; i < m.stages(); ++i) sum += exact(m.b[i]) * weight(t, i);
        worst = std::max<mp>(worst, abs(sum));
    }
    return worst;
}

} // namespace

TEST_CASE("rooted trees: their number, their sizes, their densities") {
    std::size_t const count[] = {1, 1, 2, 4, 9, 20, 48, 115};
    auto const trees = rooted_trees(8);
    std::size_t total = 0;
    for (std::size_t n = 1; n <= 8; ++n) {
        std::size_t found = 0;
        for (auto const& t : trees) found += t.nodes == n;
        CHECK(found == count[n - 1]);
        total += found;
    }
    CHECK(trees.size() == total);
    double lowest = 1e9;
    double highest = 0;
    for (auto const& t : trees) {
        if (t.nodes != 5) continue;
        lowest = std::min(lowest, t.density);
        highest = std::max(highest, t.density);
    }
    CHECK(lowest == 5);    // the bush
    CHECK(highest == 120); // the tall tree
}

TEST_CASE("every shipped method has the order that it states, and no more") {
    for (auto const& m : shipped()) {
        CAPTURE(m.name);
        for (auto const& r : order_residuals<interval>(m, m.order)) {
            CHECK(contains(r, 0.0));
            CHECK(width(r) < 1e-13);
        }
        bool more = true;
        for (auto const& r : order_residuals<interval>(m, m.order + 1)) {
            more = more && contains(r, 0.0);
        }
        CHECK_FALSE(more);
        CHECK(largest_residual(m, m.order) < 1e-40);
        CHECK(largest_residual(m, m.order + 1) > 1e-6);
        CHECK_NOTHROW(require_order(m));
        auto boast = m;
        ++boast.order;
        CHECK_THROWS_WITH(require_order(boast), ContainsSubstring(m.name));
    }
}

TEST_CASE("a slip in any one coefficient is found") {
    for (auto const& m : shipped()) {
        CAPTURE(m.name);
        for (std::size_t i = 0; i < m.stages(); ++i) {
            for (std::size_t j = 0; j < m.a[i].size(); ++j) {
                auto wrong = m;
                wrong.a[i][j].numerator += 1;
                CHECK_THROWS(require_order(wrong));
            }
            auto wrong = m;
            wrong.b[i].numerator += 1;
            CHECK_THROWS(require_order(wrong));
            wrong = m;
            wrong.c[i].numerator += 1;
            CHECK_THROWS(require_order(wrong));
        }
    }
}
