// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/shaped_problem.hpp>

#include "support/catch.hpp"
#include "support/planted_curves.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/contract/window_contraction.hpp>

#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

TEST_CASE("no parameter that explains the data is lost by shapes") {
    std::size_t tried = 0, contracted = 0;
    support::each_planted_curve(support::swept(4U, 200U), [&](auto const& p, draws& d) {
        auto shaped = shaped_problem::of(p.problem);
        if (!shaped) return;
        ++tried;
        CHECK(subset(p.problem.prior, shaped->parameters()));
        for (double const negligible : {1e-3, 1e-5, 1e-7}) {
            if (!shaped->shape(negligible)) continue;
            auto const seen = shaped->posed();
            CHECK_NOTHROW(seen.require_valid());
            window_options o;
            o.seconds = 5;
            o.chained = d.coin() ? 1 : 24;
            o.keep_responses = true;
            auto const found = contract_by_windows(seen, o);
            REQUIRE_FALSE(found.empty());
            shaped->take(found.rest);
            REQUIRE(shaped->contract());
            REQUIRE(contains(shaped->parameters(), p.truth));
            shaped->begin_in(found.starts);
            // Parts of which nothing is known leave all that there is.
            auto const parts = shaped->parts(1 + d.below(20));
            REQUIRE(shaped->take_parts(parts));
            REQUIRE(contains(shaped->parameters(), p.truth));
        }
        contracted += relative_volume(shaped->parameters(), p.problem.prior).upper() < 0.5 ? 1 : 0;
    });
    CHECK(tried >= support::swept(4U, 200U) / 2);
    CHECK(contracted > tried / 4);
}

TEST_CASE("shapes do not pose what they cannot") {
    draws d(1);
    auto p = support::plant_curve(d, true);
    p.problem.experiments[0].outliers = 1;
    CHECK_FALSE(shaped_problem::of(p.problem));
    p = support::plant_curve(d, true);
    for (auto& e : p.problem.experiments) // the speed is not measured, and has no bound
        std::erase_if(e.measurements, [](measurement const& m) { return m.channel == 1; });
    auto shaped = shaped_problem::of(p.problem);
    if (shaped) CHECK(shaped->shape(1e-6)); // where equations bound it all the same
}

TEST_CASE("a model may have the names that shapes would take") {
    draws d(2);
    auto p = support::plant_curve(d, true);
    p.problem.model.about.inputs[0].name = "rest of curve 1";
    p.problem.model.about.constants[3].name = "curve 1' shape 1";
    p.problem.choice.unknown[3] = "curve 1' shape 1";
    auto shaped = shaped_problem::of(p.problem);
    REQUIRE(shaped);
    REQUIRE(shaped->shape(1e-4));
    CHECK_NOTHROW(shaped->posed().require_valid());
}
