// SPDX-License-Identifier: MIT
// An enclosed motion says what the tube says that `integrate` proves; that tubes contain the
// trajectories is tested with them.
#include <sivid/enclosure/enclosed_motion.hpp>

#include "support/catch.hpp"
#include "support/systems.hpp"

#include <sivid/enclosure/tube.hpp>

#include <cstddef>
#include <stdexcept>

using namespace sivid;

namespace {

void check_equal(box const& a, box const& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(a[i].lower() == b[i].lower());
        CHECK(a[i].upper() == b[i].upper());
    }
}

} // namespace

TEST_CASE("an enclosed motion is the tube of integrate") {
    std::size_t ended = 0;
    support::for_each_smooth_system([&](auto system) {
        CAPTURE(system.name);
        auto const f = system.flow();
        double const end = 10 * system.horizon; // some are not enclosed so far
        enclosure_options options;
        options.maximum_steps = 60;
        enclosed_motion const motion(f, system.initial, system.parameters, 0, end, options);
        auto const expected =
            integrate<interval>(f, system.initial, system.parameters, 0, end, options);
        CHECK(motion.end_time() == expected.end_time());
        CHECK(motion.complete() == expected.complete());
        REQUIRE(motion.spans().size() == expected.steps().size());
        for (std::size_t k = 0; k < motion.spans().size(); ++k) {
            CHECK(motion.spans()[k].from == expected.steps()[k].from);
            CHECK(motion.spans()[k].to == expected.steps()[k].to);
            check_equal(motion.spans()[k].states, expected.steps()[k].swept);
        }
        double const t = 0.7 * motion.end_time();
        check_equal(motion.at(t), expected.at(t));
        check_equal(motion.observe_at(t), expected.observe_at(t));
        CHECK(motion.steps().steps().size() == motion.spans().size());
        check_equal(motion.over(0.5 * t, t), expected.over(0.5 * t, t));
        CHECK_THROWS_AS(motion.over(t, 0.5 * t), std::invalid_argument);
        CHECK_THROWS_AS(motion.at(end + 1), std::out_of_range);
        if (motion.complete()) return;
        ++ended;
        CHECK(motion.failure()->reason == expected.failure()->reason);
        CHECK(motion.failure()->time == expected.failure()->time);
    });
    CHECK(ended > 0);
}
