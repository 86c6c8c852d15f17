// SPDX-License-Identifier: MIT
#include <sivid/model/closed_loop.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/effects.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sivid::literals;

namespace {

using support::between;

/// x0' = x1, x1' = u0 + u1 - p0 x1; y0 = x0, y1 = x1.
sivid::recorded_model cart() {
    return support::model_of(
        {.states = 2, .constants = 1, .inputs = 2},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{x[1], u[0] + u[1] - c[0] * x[1]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
}

sivid::signal held(double value) {
    return sivid::sampled_signal({0}, {value}, sivid::interpolation::hold);
}

/// States and channels of a closed model at a time, all constants at these values.
struct motion {
    std::vector<double> state, channels;
};
motion at(sivid::closed_model const& closed, std::vector<sivid::signal> const& inputs,
          std::vector<double> const& constants, std::vector<double> const& start, double time) {
    sivid::parameter_choice choice;
    for (std::size_t j = 0; j < constants.size(); ++j)
        choice.fixed[closed.model.about.constants[j].name] = sivid::interval(constants[j]);
    auto const plain = sivid::nominal(inputs);
    auto const all = sivid::simulate(
        std::make_shared<sivid::approximate_model const>(closed.model, choice, plain), plain, start,
        {}, 0, {time}, {1e-10});
    return {all.states.back(), all.outputs.back()};
}

} // namespace

TEST_CASE("a loop is closed: the model under the law moves as written by hand") {
    sivid::closed_loop law(cart());
    auto const k = law.gain("K", "1/s^2"), d = law.gain("D", "1/s");
    law.command("u0", k * (1.0 - law.state("x0")) - d * law.measured("y1"));
    auto const closed = law.finish();
    CHECK(closed.kept_inputs == std::vector<std::size_t>{1});
    CHECK(closed.own_inputs.empty());
    CHECK(closed.own_states == 0);
    auto const& about = closed.model.about;
    REQUIRE(about.inputs.size() == 1);
    CHECK(about.inputs[0].name == "u1");
    REQUIRE(about.channels.size() == 3);
    CHECK(about.channels[2].name == "u0");
    REQUIRE(about.constants.size() == 3);
    CHECK(about.constants[1].name == "K");

    // x0'' = 4 (1 - x0) - (1 + 3) x0' + 2: critically damped around 1.5.
    auto const inputs = closed.inputs({held(99), held(2)});
    auto const end = at(closed, inputs, {1, 4, 3}, {0, 0}, 0.7);
    double const e = std::exp(-2 * 0.7);
    CHECK(std::abs(end.state[0] - (1.5 - 1.5 * (1 + 2 * 0.7) * e)) < 1e-8);
    CHECK(std::abs(end.channels[2] - (4 * (1 - end.state[0]) - 3 * end.state[1])) < 1e-12);
}

TEST_CASE("an integral is a further state that begins at 0") {
    sivid::closed_loop law(cart());
    law.command("u0", law.integral(1.0 - law.state("x0"), "sum", "s", 10));
    auto const closed = law.finish();
    CHECK(closed.own_states == 1);
    auto const start =
        closed.initial({sivid::interval(0.0), between(0, 1)}, {held(0)}, {sivid::interval(1.0)});
    REQUIRE(start.size() == 3);
    CHECK(start[1].upper() == 1);
    CHECK(mag(start[2]) == 0);
    // While x0 stays 0 the integral is the time.
    auto const end = at(closed, {held(0)}, {1}, {0, 0, 0}, 1e-3);
    CHECK(std::abs(end.state[2] - 1e-3) < 1e-9);
}

TEST_CASE("switches in time are exact and inclusive at their begin") {
    sivid::closed_loop law(cart());
    law.command("u0", 3.0 * law.during(0.5, 1.5));
    auto const closed = law.finish();
    REQUIRE(closed.own_inputs.size() == 1);
    auto const inputs = closed.inputs({held(0), held(0)});
    auto const before = at(closed, inputs, {0}, {0, 0}, 0.4);
    CHECK(before.state[1] == 0);
    auto const end = at(closed, inputs, {0}, {0, 0}, 2);
    CHECK(std::abs(end.state[1] - 3) < 1e-8);
    CHECK(at(closed, inputs, {0}, {0, 0}, 0.5).channels[2] == 3);
    CHECK(at(closed, inputs, {0}, {0, 0}, 1.5).channels[2] == 0);
    CHECK_THROWS_WITH(law.during(1, 1), ContainsSubstring("from < to"));
}

TEST_CASE("a sensor's error is an input that may do anything within its bound") {
    sivid::closed_loop law(cart());
    law.sensor("y0", 0.25);
    law.command("u0", -law.measured("y0") - law.measured("y0") + law.measured("y1"));
    CHECK_THROWS_WITH(law.sensor("y0", 0.5), ContainsSubstring("was read before"));
    CHECK_THROWS_WITH(law.sensor("y1", -1), ContainsSubstring("0 or more"));
    CHECK(law.reads("y0"));
    sivid::closed_loop blind(cart());
    blind.sensor("y0", 0.25);
    blind.command("u0", -blind.state("x0")); // the state is no reading
    CHECK_FALSE(blind.reads("y0"));
    CHECK_THROWS_AS(blind.reads("z"), std::invalid_argument);
    auto const closed = law.finish();
    REQUIRE(closed.own_inputs.size() == 1); // one error, however often it is read; none of y1
    CHECK(closed.model.about.inputs.back().name == "y0.error");
    CHECK(sivid::is_uncertain(closed.own_inputs[0]));
    auto const& u = std::get<sivid::sampled_signal>(closed.own_inputs[0]);
    CHECK(u.error_bound(u.piece(0), 0) >= 0.25);
}

TEST_CASE("a lag behind a command begins at what is commanded") {
    auto const lag = sivid::effects::input_lag("lag", "u0", "1", {0.1_dec, 0.5_dec}, 10);
    sivid::closed_loop law(sivid::with(cart(), std::vector<sivid::effect>{lag}));
    law.command("u0", law.gain("K", "1") * (1.0 - law.state("x0")));
    auto const closed = law.finish();
    REQUIRE(closed.starts.size() == 1);
    auto const states = closed.model.about.states.size();
    sivid::box open(states);
    for (std::size_t i = 0; i < states; ++i) open[i] = sivid::interval(0.0);
    open[0] = between(0.25, 0.5);
    std::vector<sivid::interval> constants(closed.model.about.constants.size(),
                                           sivid::interval(4.0));
    auto const start = closed.initial(open, {held(0)}, constants);
    auto const& own = start[closed.starts[0].state];
    CHECK(contains(own, 2.0)); // 4 (1 - 0.5)
    CHECK(contains(own, 3.0));
    CHECK(own.lower() > 1.999);
    CHECK(own.upper() < 3.001);
}

TEST_CASE("loops that mean nothing are refused") {
    auto const message = [](auto const& build) {
        sivid::closed_loop law(cart());
        try {
            build(law);
            static_cast<void>(law.finish());
        } catch (std::invalid_argument const& e) {
            return std::string{e.what()};
        }
        return std::string{"nothing"};
    };
    CHECK_THAT(message([](auto&) {}), ContainsSubstring("commands no input"));
    CHECK_THAT(message([](auto& l) { l.command("u9", l.time()); }), ContainsSubstring("u9"));
    CHECK_THAT(message([](auto& l) {
                   l.command("u0", l.time());
                   l.command("u0", l.time());
               }),
               ContainsSubstring("commanded twice"));
    CHECK_THAT(message([](auto& l) { l.gain("p0", "1"); }),
               ContainsSubstring("name that the model"));
    CHECK_THAT(message([](auto& l) { static_cast<void>(l.state("q")); }), ContainsSubstring("q"));
    CHECK_THAT(message([](auto& l) { l.integral(l.time(), "i", "s", 0); }),
               ContainsSubstring("finite range"));
    CHECK_THAT(message([](auto& l) { l.command("u0", l.input("u0") + 1.0); }),
               ContainsSubstring("algebraic loop"));
}
