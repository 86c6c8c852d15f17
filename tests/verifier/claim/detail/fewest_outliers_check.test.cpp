// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/identification_check_work.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

/// Two samples are spoilt, and two outliers allowed.
stored_identification honest() {
    stored_identification stored;
    stored.verdict = verdict::consistent;
    stored.fewest = proved_count{2, 2};
    stored.fewest_alone["run"] = {2, 2};
    return stored;
}
outcome check(stored_identification const& stored, std::size_t budget = 2, double seconds = 10) {
    return check_fewest(plain_problem::make(2, budget), stored, seconds).found;
}

} // namespace

TEST_CASE("the fewest outliers are proved to be needed, within a budget") {
    CHECK(check({}) == outcome::nothing);
    CHECK(check(honest()) == outcome::verified);
    CHECK(check(honest(), 2, 0) == outcome::undecided);
}

TEST_CASE("more outliers than are needed, and numbers that do not fit, are refuted") {
    auto stored = honest();
    stored.fewest = {3, 3};
    CHECK(check(stored) == outcome::refuted);    // not the budget
    CHECK(check(stored, 3) == outcome::refuted); // two suffice
    stored.fewest = {2, 3};
    stored.fewest_alone["run"] = {2, 3};
    CHECK(check(stored, 3) == outcome::verified); // the verdict
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

namespace {

/// Two records that agree on 1.6 but for one reading, and on 0.6 if two of the other are wrong:
/// outliers are traded between them.
identification_problem two_records(std::size_t of_one, std::size_t of_two) {
    auto problem = plain_problem::make();
    auto const at = [](double rate, double t) {
        double const x = 2 * std::exp(-rate * t);
        return measurement{t, 0, interval(x - 0.02, x + 0.02)};
    };
    auto one = problem.experiments[0];
    one.name = "one";
    one.measurements = {{0.5, 0, interval(-3.0, 3.0)}, at(0.8, 2), at(0.8, 2.5)};
    one.outliers = of_one;
    auto two = one;
    two.name = "two";
    two.measurements = {{0.5, 0, interval(-3.0, 3.0)}, at(0.8, 2), at(0.3, 2.5), at(0.3, 3)};
    two.outliers = of_two;
    problem.experiments = {one, two};
    return problem;
}
check_finding checked(identification_problem const& problem, proved_count total, proved_count one,
                      proved_count two) {
    auto stored = honest();
    stored.fewest = total;
    stored.fewest_alone = {{"one", one}, {"two", two}};
    return check_fewest(problem, stored, 20);
}

} // namespace

TEST_CASE("a total is needed only if no way to share out fewer suffices") {
    // 0 in one and 2 in two suffice, though neither 1 and 1 nor 2 and 0 do.
    CHECK(checked(two_records(0, 2), {2, 2}, {0, 0}, {1, 1}).found == outcome::verified);
    CHECK(checked(two_records(0, 2), {1, 2}, {0, 0}, {1, 2}).found == outcome::verified);
    auto const traded = checked(two_records(2, 1), {3, 3}, {0, 0}, {1, 1});
    CHECK(traded.found == outcome::refuted);
    CHECK_THAT(traded.detail, ContainsSubstring("are needed"));
}

TEST_CASE("that fewer than the budget suffice for a scenario by itself is searched once more") {
    auto stored = honest();
    stored.fewest_alone["run"] = {0, 2};
    stored.fewest = proved_count{0, 2};
    CHECK(check(stored) == outcome::verified); // the verdict
    stored.fewest_alone["run"] = {0, 1};       // two are needed
    CHECK(check(stored) == outcome::refuted);
    stored.fewest_alone["run"] = {0, 0};
    CHECK(check(stored) == outcome::refuted);
    stored.fewest = proved_count{0, 3};
    stored.fewest_alone["run"] = {2, 2}; // as a fit shows
    CHECK(check(stored, 3) == outcome::verified);
    stored.fewest = proved_count{0, 7}; // more than there are measurements
    CHECK(check(stored, 7) == outcome::refuted);
}
