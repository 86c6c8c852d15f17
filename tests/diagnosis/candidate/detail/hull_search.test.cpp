// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/hull_search.hpp>

#include "support/catch.hpp"
#include "support/planted_curves.hpp"

#include <cstdint>

using namespace sivid;
using support::draws;

TEST_CASE("hulls of a diagnosis have all contractors: curves such as those of a car's tyres") {
    int gained = 0;
    for (std::uint64_t const seed : {22U, 54U}) { // runs over these priors end early
        draws d(seed);
        auto const p = support::plant_curve(d, d.coin());
        contraction_journal journal;
        effect_hull_options how{.seconds = 30, .boxes = 20};
        how.tried = [&](contraction_journal const& more) { add(journal, more); };
        auto const left = hull_search(how)(p.problem, 1);
        REQUIRE(left);
        CHECK(contains(left->parameters, p.truth));
        CHECK(relative_volume(left->parameters, p.problem.prior).upper() < 0.5);
        REQUIRE_FALSE(journal.empty());
        CHECK(journal[0].by == "shapes");
        gained += journal[0].how == contraction_record::outcome::gained ? 1 : 0;
    }
    CHECK(gained > 0);
}
