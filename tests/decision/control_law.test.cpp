// SPDX-License-Identifier: MIT
#include <sivid/decision/control_law.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/approximate/simulate/simulate.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using namespace sivid::literals;

namespace {

sivid::recorded_model cart() {
    return support::model_of(
        {.states = 2, .constants = 1, .inputs = 2},
        [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{x[1], u[0] - u[1]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
}

/// What a law commands for u0 at a time, from a start.
double commanded(std::string const& text, std::vector<double> start, double time) {
    sivid::closed_loop loop(cart());
    loop.gain("K", "1", 2_dec);
    sivid::command_by(text, loop, 4);
    auto const closed = loop.finish();
    std::vector<sivid::signal> open(2, sivid::sampled_signal({0}, {0}, sivid::interpolation::hold));
    auto const inputs = sivid::nominal(closed.inputs(open));
    start.resize(closed.model.about.states.size(), 0.0);
    auto const all = sivid::simulate(std::make_shared<sivid::approximate_model const>(
                                         closed.model, sivid::parameter_choice{}, inputs),
                                     inputs, start, {}, 0, {time}, {1e-10});
    for (std::size_t c = 0; c < closed.model.about.channels.size(); ++c) {
        if (closed.model.about.channels[c].name == "u0") return all.outputs.back()[c];
    }
    return std::nan("");
}

std::string message(std::string const& text) {
    sivid::closed_loop loop(cart());
    loop.gain("K", "1");
    try {
        sivid::command_by(text, loop, 4);
    } catch (sivid::requirement_error const& e) {
        return e.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("laws say what they are written to say") {
    CHECK(commanded("u0 = K * (3 - x0)", {1, 0}, 0) == 4);
    CHECK(commanded("u0 = clamp(K * (3 - x0), -1, 1)", {1, 0}, 0) == 1);
    CHECK(commanded("u0 = clamp(K * (3 - x0), -1, 1)", {9, 0}, 0) == -1);
    CHECK(commanded("u0 = 5 * during(1, 2) + 7 * during(2, end)", {0, 0}, 0.5) == 0);
    CHECK(commanded("u0 = 5 * during(1, 2) + 7 * during(2, end)", {0, 0}, 1) == 5);
    CHECK(commanded("u0 = 5 * during(1, 2) + 7 * during(2, end)", {0, 0}, 2) == 7);
    CHECK(commanded("u0 = 5 * during(1, 2) + 7 * during(2, end)", {0, 0}, 4) == 7);
    CHECK(commanded("u1 = 1; u0 = t", {0, 0}, 3) == 3);
    CHECK(commanded("u0 = tanh(measured(y1)) + p0", {0, 0.5}, 0) == std::tanh(0.5) + 1);
    CHECK(std::abs(commanded("u0 = integral(1 + 0 * x0); u1 = 0;", {0, 0}, 2) - 2) < 1e-9);
}

TEST_CASE("what is wrong with a law is said with its place") {
    CHECK_THAT(message(""), ContainsSubstring("law: character 1") &&
                                ContainsSubstring("an input of the model is needed"));
    CHECK_THAT(message("x0 = 1"), ContainsSubstring("the model has: u0, u1"));
    CHECK_THAT(message("u0 1"), ContainsSubstring("INPUT = expression"));
    CHECK_THAT(message("u0 = 1 u1 = 2"), ContainsSubstring("parted") || ContainsSubstring(";"));
    CHECK_THAT(message("u0 = 1; u0 = 2"),
               ContainsSubstring("character 9") && ContainsSubstring("commanded twice"));
    CHECK_THAT(message("u0 = x0 > 1"), ContainsSubstring("nothing can follow"));
    CHECK_THAT(message("u0 = Z * x0"),
               ContainsSubstring("unknown name 'Z'") && ContainsSubstring("K"));
    CHECK_THAT(message("u0 = foo(x0)"), ContainsSubstring("clamp, during, integral"));
    CHECK_THAT(message("u0 = during(2, 1)"), ContainsSubstring("ends before it begins"));
    CHECK_THAT(message("u0 = during(-1, 1)"), ContainsSubstring("time in s is"));
    CHECK_THAT(message("u0 = measured(z)"), ContainsSubstring("the model has: y0, y1"));
    CHECK_THAT(message("u0 = clamp(x0, 1)"), ContainsSubstring("clamp(x, low, high)"));
    CHECK(message("u0 = 1 / 0") != "nothing");
    CHECK_THAT(message(std::string(20'000, '(')), ContainsSubstring("too long"));
    CHECK(message("u0 = " + std::string(5000, '(')) != "nothing");
    sivid::closed_loop loop(cart());
    CHECK_THROWS_WITH(sivid::command_by("u0 = 1", loop, 0), ContainsSubstring("duration"));
}
