// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/fewest_outliers_check.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

/// Two samples are spoilt, and two outliers allowed.
stored_identification honest() {
    stored_identification stored;
    stored.verdict = verdict::consistent;
    stored.rows = {{box{plain_problem::feasible()}, box_verdict::undecided}};
    stored.fewest = proved_count{2, 2};
    stored.fewest_alone["run"] = {2, 2};
    return stored;
}
outcome check(stored_identification const& stored, std::size_t budget = 2, std::size_t sample = 8,
              double seconds = 10) {
    return check_fewest<interval>(plain_problem::make(2, budget), stored, {}, seconds, sample, 1)
        .found;
}

} // namespace

TEST_CASE("the fewest outliers are proved to be needed, by sample or over the whole prior") {
    CHECK(check({}) == outcome::nothing);
    CHECK(check(honest()) == outcome::sampled);
    CHECK(check(honest(), 2, 0) == outcome::verified);
    CHECK(check(honest(), 2, 0, 0) == outcome::undecided);
}

TEST_CASE("more outliers than are needed, and numbers that do not fit, are refuted") {
    auto stored = honest();
    stored.fewest = {3, 3};
    CHECK(check(stored) == outcome::refuted);    // not the budget
    CHECK(check(stored, 3) == outcome::refuted); // two suffice
    stored.fewest = {2, 3};
    CHECK(check(stored, 3) == outcome::sampled);
    CHECK(check(stored, 3, 0) == outcome::verified); // the sum of what each needs
    stored.fewest_alone["run"] = {3, 3};
    CHECK(check(stored, 3) == outcome::refuted);
    stored = honest();
    stored.verdict = verdict::undecided;
    CHECK(check(stored) == outcome::refuted);
    stored = honest();
    stored.fewest_alone["walk"] = {0, 0};
    CHECK(check(stored) == outcome::refuted);
    stored.fewest_alone = {{"walk", {2, 2}}};
    CHECK(check(stored) == outcome::refuted);
}
