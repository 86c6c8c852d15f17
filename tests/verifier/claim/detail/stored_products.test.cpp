// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stored_products.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"
#include "support/products.hpp"

using namespace sivid;

TEST_CASE("the problem in products is rebuilt as the search had it") {
    auto const problem = io_support::two_rates_problem();
    auto const map = reduction::find(problem, dependence_of(problem)).value();
    auto const rebuilt = rebuild_products<interval>(problem, map.side_names());
    CHECK(rebuilt.malformed.empty());
    CHECK(rebuilt.unproved.empty());
    CHECK(rebuilt.problem.choice.unknown == map.problem().choice.unknown);
    REQUIRE(rebuilt.problem.prior.size() == 1);
    CHECK(subset(rebuilt.problem.prior, map.problem().prior));
    CHECK(rebuilt.problem.prior[0].lower() == 0.125);
    CHECK(rebuilt.problem.prior[0].upper() == 2.0);
}

TEST_CASE("sides that are no products, or not all that the equations see, are told") {
    auto const problem = io_support::two_rates_problem();
    auto const rebuilt = [&](std::vector<std::string> const& sides) {
        return rebuild_products<interval>(problem, sides);
    };
    CHECK_FALSE(rebuilt({"a*c"}).malformed.empty());
    CHECK_FALSE(rebuilt({"a^2*b^2"}).malformed.empty()); // no factor that it could replace
    CHECK_FALSE(rebuilt({"a*b", "a"}).malformed.empty());
    CHECK_FALSE(rebuilt({"a/b"}).unproved.empty());
    CHECK_FALSE(rebuilt({"a"}).unproved.empty());
    CHECK_FALSE(rebuilt({"b"}).unproved.empty());
    auto zero = problem;
    zero.prior[1] = support::between(-0.5, 1);
    CHECK_FALSE(rebuild_products<interval>(zero, {"a*b"}).unproved.empty());
}
