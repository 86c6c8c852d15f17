// SPDX-License-Identifier: MIT
#include <sivid/model/prior_end.hpp>

#include "support/catch.hpp"

#include <vector>

using namespace sivid;

TEST_CASE("a value at the end of its prior is seen, but not where the end is 0") {
    interval const prior(1, 3);
    CHECK(end_of_prior(1.0019, prior) == prior_end::lower);
    CHECK(end_of_prior(2.9999, prior) == prior_end::upper);
    CHECK(end_of_prior(1.1, prior) == prior_end::none);
    CHECK(end_of_prior(0, interval(0, 1)) == prior_end::none); // where an effect vanishes
    CHECK(end_of_prior(1, interval(0, 1)) == prior_end::upper);
    CHECK(end_of_prior(-1, interval(-1, 0)) == prior_end::lower);
    CHECK(end_of_prior(2, interval(2, 2)) == prior_end::none); // not to be found
    CHECK(to_string(prior_end::lower) == "lower");
}

TEST_CASE("what sits at the end of its prior is moved to the middle") {
    box const prior{interval(0.5, 1.5)};
    CHECK(away_from_ends(prior, {1.5}) == std::vector<double>{1.0});
    CHECK(away_from_ends(prior, {1.2}) == std::vector<double>{1.2});
}
