// SPDX-License-Identifier: MIT
#ifdef SIVID_HAS_MPFI

#include <sivid/verifier/mp_identification_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <cstddef>

using namespace sivid;

TEST_CASE("the checks in the types of MPFI and in doubles find the same of a small result") {
    auto const problem = io_support::one_rate_problem();
    auto stored = io_support::stored_result(problem).read();
    bool const tampered = GENERATE(false, true);
    if (tampered) stored.witness->parameters["a"] = problem.prior[0].upper();
    identification_check_options options;
    options.sample = 3;
    options.seconds = 60;
    std::size_t told = 0;
    auto const tell = [&told](check_finding const&) { ++told; };
    auto const doubles = check_identification(problem, stored, options, tell);
    auto const proven = check_by_proven_functions(problem, stored, options, tell);
    auto const multiprecision = check_in_multiprecision(problem, stored, options, tell);
    CHECK(told == doubles.size() + proven.size() + multiprecision.size());
    REQUIRE(proven.size() == doubles.size());
    REQUIRE(multiprecision.size() == doubles.size());
    for (std::size_t k = 0; k < doubles.size(); ++k) {
        CHECK(proven[k].what == doubles[k].what);
        CHECK(proven[k].found == doubles[k].found);
        CHECK(multiprecision[k].what == doubles[k].what);
        CHECK(multiprecision[k].found == doubles[k].found);
    }
    CHECK((overall(proven) == check_finding::outcome::refuted) == tampered);
}

#endif
