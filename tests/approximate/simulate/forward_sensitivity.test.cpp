// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/forward_sensitivity.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("one step is the Runge-Kutta step of the variational equation") {
    // x' = -a x: S = exp(-a h) to fourth order, with the parameter's column beside it.
    auto const model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0])};
        });
    parameter_choice choice;
    choice.unknown = {"p0"};
    plain_model const plain(model, choice, {});
    sensitivity_layout layout;
    layout.parameter_column = {0};
    layout.start_column = {1};
    layout.disturbed = {0};
    layout.first_disturbance = 2;
    layout.columns = 4;
    forward_sensitivity s;
    s.start(plain, layout);
    double const a = 0.8, h = 0.1;
    auto const stage = [&](double x, double share) {
        return linear_stage{{-a}, {-x}, {}, {}, share};
    };
    auto const s1 = stage(1, 0), s2 = stage(std::exp(-a * h / 2), 0.5),
               s4 = stage(std::exp(-a * h), 1);
    s.step(h, {&s1, &s2, &s2, &s4}, 4, 0, 2);
    CHECK(s.stride() == 4);
    double const decay = std::exp(-a * h);
    CHECK_THAT(s.row(0)[1], WithinAbs(decay, 1e-6));
    CHECK_THAT(s.row(0)[0], WithinAbs(-h * decay, 1e-5));
    double const whole = (1 - decay) / a;
    CHECK_THAT(s.row(0)[2] + s.row(0)[3], WithinAbs(whole, 1e-6));
    CHECK(s.row(0)[3] > s.row(0)[2]);
}
