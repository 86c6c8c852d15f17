// SPDX-License-Identifier: MIT
// That whatever belongs to a problem is in it is tested with its digest, problem_digest.test.cpp.
#include <sivid/model/problem_text.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using sivid::problem_text;

TEST_CASE("equal problems have equal texts, others have others") {
    auto const text = problem_text(plain_problem::make(1, 1));
    CHECK(problem_text(plain_problem::make(1, 1)) == text);
    CHECK(problem_text(plain_problem::make(1, 0)) != text);
    CHECK(problem_text(plain_problem::make(2, 1)) != text);
    auto other = plain_problem::make(1, 1);
    other.prior[0] = sivid::interval(0.25, 1.0000000000000002);
    CHECK(problem_text(other) != text);
    other = plain_problem::make(1, 0);
    other.experiments[0].constraint = true;
    CHECK(problem_text(other) != problem_text(plain_problem::make(1, 0)));
}
