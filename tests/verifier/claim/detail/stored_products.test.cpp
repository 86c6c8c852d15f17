// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stored_claims.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/products.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <vector>

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

TEST_CASE("boxes of products that share a factor are reached where a preimage is shown") {
    // c0 c1 and c1 c2 over [1, 2]^3: (w, z) is reached where w and z have a ratio of at most 2.
    identification_problem problem;
    problem.model = support::model_of(
        {.states = 1, .constants = 3},
        [](auto const&, auto const& x, auto const& c, auto const&) {
            return std::vector{c[0] * c[1] - c[1] * c[2] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    problem.choice.unknown = support::all_constants(3);
    problem.prior = {support::between(1, 2), support::between(1, 2), support::between(1, 2)};
    auto const& names = problem.choice.unknown;
    auto const products =
        rebuild_products<interval>(problem, {names[0] + "*" + names[1], names[1] + "*" + names[2]});
    REQUIRE(products.malformed.empty());
    CHECK(share_a_factor(products));
    CHECK_FALSE(share_a_factor(rebuild_products<interval>(problem, {names[0] + "*" + names[1]})));

    auto const found = reached_within(products, problem.prior, {products.problem.prior}, 500);
    REQUIRE_FALSE(found.empty());
    support::draws d(11);
    double area = 0;
    for (auto const& r : found) {
        area += width(r[0]) * width(r[1]);
        auto const at = d.in(r);
        CHECK(std::max(at[0], at[1]) <= 2 * std::min(at[0], at[1]));
    }
    CHECK(area > 0.8 * 7); // the image is [1, 4]^2 without two triangles of 1 each
    CHECK(area <= 7);
    box const corner{support::between(3.5, 4), support::between(1, 1.5)};
    CHECK(reached_within(products, problem.prior, {corner}, 500).empty());
}
