// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/identify_remembering.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/model/effects.hpp>

#include <algorithm>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

identification identified(small_campaign::truth const& real, std::vector<effect> const& effects) {
    effect_hull_options options;
    options.seconds = 20;
    options.boxes = 400;
    return identify_remembering(small_campaign::problem(real), effects, options);
}

} // namespace

TEST_CASE("a model with a delay, a play, a rate limit or a late sensor is identified") {
    small_campaign::truth late, loose, limited, slow;
    late.delay = 0.2;
    loose.play = 0.1;
    limited.limit = 0.75;
    slow.sensor_delay = 0.15;
    struct planted {
        small_campaign::truth real;
        effect what;
        double size;
    };
    std::vector<planted> const all{
        {late, effects::input_delay("late", "u", {0_dec, 0.5_dec}), 0.2},
        {loose, effects::input_backlash("loose", "u", "N", {0_dec, 0.5_dec}), 0.1},
        {limited, effects::input_rate_limit("limited", "u", "N/s", {0.25_dec, 4_dec}), 0.75},
        {slow, effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec}), 0.15}};
    for (auto const& one : all) {
        CAPTURE(one.what.name);
        auto const found = identified(one.real, {one.what});
        CHECK(found.verdict == verdict::consistent);
        REQUIRE(found.witness);
        REQUIRE(found.hull.size() == 2);
        CHECK(contains(found.hull[0], 1.0));
        CHECK(contains(found.hull[1], one.size));
        CHECK(width(found.hull[1]) < 0.2 * width(one.what.parameters[0].prior()));
        CHECK(contains(found.hull[1], found.witness->parameters[1]));
        CHECK(found.paving.outer_volume().upper() < 0.1);
    }
}

TEST_CASE("a delay that cannot explain the data is refuted") {
    small_campaign::truth late;
    late.delay = 0.3;
    auto const found = identified(late, {effects::input_delay("late", "u", {0_dec, 0.05_dec})});
    CHECK(found.verdict == verdict::inconsistent);
    CHECK(found.reason == stop_reason::decided);
    CHECK_FALSE(found.witness);
    CHECK(!found.paving.has_outer());
}
