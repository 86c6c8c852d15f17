// SPDX-License-Identifier: MIT
#include <sivid/paving/witness.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a witness is verified with what it violates, or refused") {
    auto const check = [](identification_problem const& problem, double rate, double start) {
        data_test test(problem, {});
        return verify_witness(test, problem, {rate}, {{start}});
    };
    auto const sound = plain_problem::make();
    auto const good = check(sound, plain_problem::truth, 2);
    REQUIRE(good);
    CHECK(good->violated == std::vector<std::vector<bool>>{std::vector<bool>(6, false)});
    CHECK_FALSE(check(sound, 0.9, 2)); // explains nothing
    CHECK_FALSE(check(sound, 0.1, 2)); // neither does the end of the prior
    // A guess outside the problem's boxes is moved into them.
    auto const moved = check(sound, plain_problem::truth, 2.1);
    REQUIRE(moved);
    CHECK(contains(sound.experiments[0].initial, moved->starts[0]));
    auto const spoilt = plain_problem::make(2, 2);
    auto const tolerant = check(spoilt, plain_problem::truth, 2);
    REQUIRE(tolerant);
    CHECK(tolerant->violated[0] == std::vector<bool>{true, true, false, false, false, false});
    CHECK_FALSE(check(plain_problem::make(2, 1), plain_problem::truth, 2));
}
