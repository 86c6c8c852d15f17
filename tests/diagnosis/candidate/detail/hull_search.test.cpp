// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/hull_search.hpp>

#include "support/catch.hpp"
#include "support/planted_curves.hpp"
#include "support/sweep.hpp"

#include <cstddef>

using namespace sivid;
using support::draws;

TEST_CASE(
    "hulls of a diagnosis have all contractors: curves of a car, such as those of its tyres") {
    std::size_t tried = 0, narrower = 0;
    support::each_planted_curve(support::swept(3U, 100U), [&](auto const& p, draws&) {
        contraction_journal journal;
        effect_hull_options how{.seconds = 20, .boxes = 20};
        how.tried = [&](contraction_journal const& more) { add(journal, more); };
        auto const left = hull_search(how)(p.problem, 1);
        REQUIRE(left);
        REQUIRE(contains(left->parameters, p.truth));
        REQUIRE_FALSE(journal.empty());
        if (journal[0].by != "shapes" || !(journal[0].left < 0.5)) return;
        ++tried;
        how.strategy = how.strategy.without("shapes")
                           .without("growing window")
                           .without("guided windows")
                           .without("windows all along");
        auto const without = hull_search(how)(p.problem, 1);
        REQUIRE(without);
        narrower += relative_volume(left->parameters, without->parameters).upper() < 0.5 ? 1 : 0;
    });
    CHECK(tried > 0);
    CHECK(2 * narrower >= tried);
}
