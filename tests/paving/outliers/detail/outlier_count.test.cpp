// SPDX-License-Identifier: MIT
#include <sivid/paving/outliers/detail/outlier_count.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;

namespace {

auto const nobody = [](std::vector<double> const&) { return std::size_t{6}; };

} // namespace

TEST_CASE("spoilt samples are counted from below, and never too many") {
    for (std::size_t spoilt = 0; spoilt < 4; ++spoilt) {
        outlier_count_search search(plain_problem::make(spoilt), {}, {});
        CHECK(search.bound() == 0);              // no goal yet
        CHECK(search(spoilt, nobody) == spoilt); // nothing does with fewer
        // A higher goal is not reached: the truth violates no more.
        outlier_search_options few;
        few.boxes = 200;
        outlier_count_search further(plain_problem::make(spoilt), {}, few);
        CHECK(further(spoilt + 1, nobody) == spoilt);
        CHECK(further.boxes() > 0);
    }
}

TEST_CASE(
    "a goal that falls on the way ends the search, and points that may reach it are offered") {
    std::size_t offered = 0;
    outlier_count_search search(plain_problem::make(1), {}, {});
    auto const bound = search(6, [&](std::vector<double> const& middle) {
        ++offered;
        CHECK(contains(plain_problem::make().prior, middle));
        return std::size_t{1}; // somebody did it with one
    });
    CHECK(offered > 0);
    CHECK(bound == 1);
    outlier_count_search informed(plain_problem::make(2), {2}, {});
    CHECK(informed(2, nobody) == 2);
    CHECK(informed.boxes() == 0);
}
