// SPDX-License-Identifier: MIT
#include <sivid/paving/products/dependence.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

using namespace sivid;

TEST_CASE("products are found over all experiments of a problem") {
    support::draws d(781);
    auto const product = support::plant(d, 2, {.experiments = 2});
    auto const found = dependence_of(product.problem);
    CHECK(found.entangled == std::vector<std::size_t>{0, 1});
    REQUIRE(found.combinations.size() == 1);
    CHECK(found.combinations[0].formula == "p0*p1");
    CHECK(dependence_of(support::plant(d, 0, {}).problem).entangled.empty());
}
