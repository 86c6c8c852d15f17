// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/forced_outlier_check.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

outcome check(stored_identification const& stored, std::vector<std::vector<bool>> const& hits = {},
              double seconds = 10) {
    return check_forced<interval>(plain_problem::make(1, 1), stored, hits, {}, seconds).found;
}

} // namespace

TEST_CASE("forced outliers are proved over all boxes, or not believed") {
    stored_identification stored;
    stored.rows = {{box{interval(0.45, 0.5)}, box_verdict::inside},
                   {box{interval(0.5, 0.55)}, box_verdict::undecided}};
    CHECK(check(stored) == outcome::nothing);
    stored.forced = {{"run", 0.5, "x"}};
    CHECK(check(stored) == outcome::verified);
    CHECK(check(stored, {{true}}) == outcome::refuted);
    stored.forced.push_back({"run", 1.0, "x"}); // which the boxes meet
    CHECK(check(stored, {}, 0.2) == outcome::undecided);
    for (auto const& bad : {stored_identification::outlier{"run", 0.7, "x"},
                            stored_identification::outlier{"run", 0.5, "y"},
                            stored_identification::outlier{"walk", 0.5, "x"}}) {
        stored.forced = {bad};
        CHECK(check(stored) == outcome::refuted);
    }
}
