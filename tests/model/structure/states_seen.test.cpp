// SPDX-License-Identifier: MIT
#include <sivid/model/structure/states_seen.hpp>

#include "support/catch.hpp"
#include "support/pendulum.hpp"

TEST_CASE("every state gets a channel of its own behind the model's channels") {
    auto const seen = sivid::with_states_seen(sivid::record_model<support::pendulum>());
    REQUIRE(seen.about.channels.size() == 3);
    CHECK(seen.about.channels[1].name == "state angle");
    CHECK(seen.about.channels[2].unit == "rad/s");
    CHECK(seen.observe[1] == seen.observe[0]);
    CHECK(seen.observe[2] != seen.observe[0]);
}
