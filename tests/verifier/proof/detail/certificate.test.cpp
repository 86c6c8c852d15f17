// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;
using kind = box_claim::kind;
using status = box_claim::status;

namespace {

box_claim claim(double low, double high, kind what) { return {box{interval(low, high)}, what}; }

std::vector<box_claim> checked(identification_problem const& problem, std::vector<box_claim> claims,
                               certificate_options options = {}) {
    claim_checker<interval> check(problem, {}, options);
    check(claims);
    return claims;
}

} // namespace

TEST_CASE("true claims are proved, false ones refuted with a counterexample") {
    auto const problem = plain_problem::make();
    auto const f = plain_problem::feasible();
    double const a = f.lower(), b = f.upper();
    auto const found = checked(
        problem, {claim(a + 1e-4, b - 1e-4, kind::inside), claim(b + 1e-4, 1, kind::outside),
                  claim(0.25, a - 1e-4, kind::outside), claim(a + 1e-3, b + 1e-3, kind::inside),
                  claim(b - 1e-3, b + 0.1, kind::outside), claim(0.6, 0.7, kind::inside)});
    for (std::size_t k = 0; k < 3; ++k) {
        INFO(k);
        CHECK(found[k].found == status::proved);
    }
    for (std::size_t k = 3; k < 6; ++k) {
        INFO(k);
        REQUIRE(found[k].found == status::refuted);
        REQUIRE(found[k].counterexample.size() == 1);
        double const at = found[k].counterexample[0];
        CHECK((a <= at && at <= b) == (found[k].what == kind::outside));
        CHECK(contains(found[k].set, found[k].counterexample));
    }
}

TEST_CASE("claims at the very edge or without a budget stay open") {
    auto const problem = plain_problem::make();
    auto const f = plain_problem::feasible();
    certificate_options few;
    few.runs_per_claim = 5;
    CHECK(checked(problem, {claim(f.upper(), 1, kind::outside)}, few)[0].found == status::open);
    certificate_options none;
    none.seconds = -1;
    CHECK(checked(problem, {claim(0.9, 1, kind::outside)}, none)[0].found == status::open);
    certificate_options stopped;
    stopped.keep_going = [] { return false; };
    CHECK(checked(problem, {claim(0.9, 1, kind::outside)}, stopped)[0].found == status::open);
}

TEST_CASE("many claims share runs") {
    auto const problem = plain_problem::make();
    std::vector<box_claim> claims;
    for (int k = 0; k < 200; ++k) {
        claims.push_back(claim(0.7 + 0.001 * k, 0.7 + 0.001 * (k + 1), kind::outside));
    }
    claim_checker<interval> check(problem, {}, {});
    check(claims);
    for (auto const& c : claims) CHECK(c.found == status::proved);
    CHECK(check.runs() < 40);
}
