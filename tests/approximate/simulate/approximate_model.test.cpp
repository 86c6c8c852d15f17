// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/approximate_model.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;

TEST_CASE("a plain model keeps its delays and knows its derivatives") {
    auto model = support::model_of(
        {2, 3, 1}, [](auto const& t, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[1] * x[0] + p[0], p[1] * u[0] + t + 0 * x[0]};
        });
    model.input_memory = {{0, 2}};
    model.channel_delays = {{1, 1}};
    parameter_choice choice;
    choice.unknown = {"p2", "p0"};
    choice.fixed["p1"] = interval(0.25);
    sampled_signal const u({0, 1}, {1, 2}, interpolation::linear);
    approximate_model const plain(model, choice, {u});
    CHECK(plain.states() == 2);
    CHECK(plain.parameters() == 2);
    CHECK(plain.channels() == 2);
    REQUIRE(plain.input_memory().size() == 1);
    CHECK(plain.input_memory()[0].unknown);
    CHECK(plain.input_memory()[0].value({0.3, 7}) == 0.3);
    REQUIRE(plain.channel_delays().size() == 1);
    CHECK_FALSE(plain.channel_delays()[0].unknown);
    CHECK(plain.channel_delays()[0].value({0.3, 7}) == 0.25);
    CHECK(plain.rate().by_state.size() == 2);
    REQUIRE(plain.rate().by_parameter.size() == 1);
    CHECK(plain.rate().by_parameter[0].column == 1);
    REQUIRE(plain.rate().by_input.size() == 1);
    REQUIRE(plain.rate().by_time.size() == 1);
    CHECK_THROWS_AS(approximate_model(model, choice, {}), std::invalid_argument);
}
