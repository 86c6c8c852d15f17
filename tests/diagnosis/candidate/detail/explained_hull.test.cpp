// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

combination product_of(std::vector<int> exponents) { return {std::move(exponents), "", ""}; }

/// Points of a box, and the hull that is known of them: sides, and some of the products.
struct cloud {
    std::vector<std::vector<double>> points;
    explained_hull known;
};
cloud drawn(draws& d, std::vector<combination> const& products) {
    cloud c;
    double const a = d.uniform(0.5, 2), b = d.uniform(0.5, 2);
    auto const around = [](double x) { return between(x * (1 - 1e-9), x * (1 + 1e-9)); };
    std::vector<interval> sides(3), ranges(products.size());
    for (int k = 0; k < 20; ++k) {
        double const t = d.uniform(0.5, 2);
        c.points.push_back({a * t, b / t, d.uniform(1, 2)});
        auto const& p = c.points.back();
        for (std::size_t j = 0; j < 3; ++j)
            sides[j] = k == 0 ? around(p[j]) : hull(sides[j], around(p[j]));
        for (std::size_t i = 0; i < products.size(); ++i) {
            double value = 1;
            for (std::size_t j = 0; j < 3; ++j) value *= std::pow(p[j], products[i].exponents[j]);
            ranges[i] = k == 0 ? around(value) : hull(ranges[i], around(value));
        }
    }
    c.known.parameters = box(sides);
    for (std::size_t i = 0; i < products.size(); ++i) c.known.add({products[i], ranges[i]});
    return c;
}
bool same(interval const& a, interval const& b) { return subset(a, b) && subset(b, a); }
bool holds(explained_hull const& known, std::vector<double> const& p) {
    for (std::size_t j = 0; j < p.size(); ++j)
        if (!contains(known.parameters[j], p[j])) return false;
    return std::all_of(known.products.begin(), known.products.end(), [&](auto const& k) {
        double value = 1;
        for (std::size_t j = 0; j < p.size(); ++j) value *= std::pow(p[j], k.what.exponents[j]);
        return contains(k.hull, value);
    });
}

} // namespace

TEST_CASE("what contains two clouds of points contains all their points, with products of either") {
    draws d(611);
    auto const ab = product_of({1, 1, 0}), ac = product_of({1, 0, -1});
    for (int round = 0; round < 100; ++round) {
        auto const first = drawn(d, {ab}), second = drawn(d, {ab, ac});
        auto both = first.known;
        both.join(second.known);
        CHECK(both.products.size() == 2);
        for (auto const* c : {&first, &second})
            for (auto const& p : c->points) CHECK(holds(both, p));
        CHECK(both.contains(first.known));
        CHECK(both.contains(second.known));
        CHECK_FALSE(first.known.contains(both));
        // Both say a b almost exactly, so their hull is what lies between.
        auto const range = hull(first.known.products[0].hull, second.known.products[0].hull);
        CHECK(subset(both.products[0].hull, hull(range, range)));
    }
    explained_hull none;
    auto const one = drawn(d, {ab});
    CHECK_FALSE(none.contains(one.known));
    none.join(one.known);
    CHECK(none.contains(one.known));
}

TEST_CASE("a product that is not bounded is not kept, one that is known twice is cut") {
    explained_hull crossing{box{between(-1, 1), between(1, 2)}};
    explained_hull told{box{between(1, 2), between(1, 2)},
                        {{product_of({-1, 1}), between(1, 1.5)}}};
    told.join(crossing);
    CHECK(told.products.empty());
    explained_hull twice{box{between(1, 2), between(1, 2)}};
    twice.add({product_of({1, 1}), between(1, 3)});
    twice.add({product_of({1, 1}), between(2, 4)});
    REQUIRE(twice.products.size() == 1);
    CHECK(same(twice.products[0].hull, between(2, 3)));
    CHECK(same(range_of(product_of({1, 1}), twice.parameters, twice.products), between(2, 3)));
    CHECK(same(range_of(product_of({1, 0}), twice.parameters, twice.products), between(1, 2)));
}

TEST_CASE("products in another order of the parameters") {
    std::vector<std::string> const from{"a", "b", "c"}, to{"c", "d", "a"};
    auto const told = reordered({product_of({2, 0, -1}), between(1, 2)}, from, to);
    REQUIRE(told);
    CHECK(told->what.exponents == std::vector<int>{-1, 0, 2});
    CHECK(same(told->hull, between(1, 2)));
    CHECK_FALSE(reordered({product_of({2, 1, -1}), between(1, 2)}, from, to));
    combination const sum{{0, 0, 0}, "a - c", "", {1, 0, -1}};
    auto const moved = reordered({sum, between(1, 2)}, from, to);
    REQUIRE(moved);
    CHECK(moved->what.signs == std::vector<int>{-1, 0, 1});
    CHECK(moved->what.exponents == std::vector<int>{0, 0, 0});
}
