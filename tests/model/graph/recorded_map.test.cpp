// SPDX-License-Identifier: MIT
#include <sivid/model/graph/recorded_map.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;
using support::between;
using support::draws;

namespace {

constexpr auto mixed = [](auto const& x) {
    using std::exp;
    return std::vector{x[0] * x[1] / x[2], exp(x[0] - x[1]) + 0.5, x[2] * 1};
};

} // namespace

TEST_CASE("a recorded map encloses its values over boxes") {
    recorded_map const map(3, mixed);
    CHECK((map.arguments() == 3 && map.values() == 3));
    draws d(651);
    for (int round = 0; round < 200; ++round) {
        box x(3);
        for (std::size_t j = 0; j < 3; ++j) {
            double const lo = d.uniform(0.1, 2);
            x[j] = between(lo, lo + d.uniform(0, 1));
        }
        auto const image = map.over(x);
        REQUIRE(image);
        for (int member = 0; member < 5; ++member) {
            auto const p = d.in(x);
            std::vector<long double> const at(p.begin(), p.end());
            auto const y = mixed(at);
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK((*image)[i].lower() <= y[i] + 1e-15L * std::abs(y[i]));
                CHECK((*image)[i].upper() >= y[i] - 1e-15L * std::abs(y[i]));
            }
        }
    }
}

TEST_CASE("where a map is not defined it says nothing") {
    recorded_map const map(3, mixed);
    CHECK_FALSE(map.over(box{interval(1.0), interval(1.0), between(-1, 1)}));
    CHECK_THROWS_AS(map.over(box{interval(1.0)}), std::invalid_argument);
}

TEST_CASE("a map is copied into another graph") {
    recorded_map const map(2, [](auto const& x) { return std::vector{x[0] + x[1], x[0] * 1}; });
    graph g;
    auto const a = g.leaf(operation::state, 0);
    auto const b = g.leaf(operation::time, 0);
    auto const y = map.in(g, {a, b});
    REQUIRE(y.size() == 2);
    CHECK(y[0] == g.add(a, b));
    CHECK(y[1] == a);
    CHECK_THROWS_AS(map.in(g, {a}), std::invalid_argument);
}
