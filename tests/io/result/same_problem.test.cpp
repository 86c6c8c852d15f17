// SPDX-License-Identifier: MIT
#include <sivid/io/result/same_problem.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <sivid/io/input_error.hpp>

using namespace sivid;

TEST_CASE("a result is of the problem that it came from, and of no other") {
    auto const problem = io_support::one_rate_problem();
    auto good = io_support::stored_result(problem).read();
    CHECK_NOTHROW(require_same_problem(problem, good, "result.json"));
    SECTION("another parameter") { good.parameters[0].name = "c"; }
    SECTION("no budget") { good.budget.clear(); }
    SECTION("the budget of another scenario too") { good.budget["other"] = 0; }
    CHECK_THROWS_AS(require_same_problem(problem, good, "result.json"), input_error);
}
