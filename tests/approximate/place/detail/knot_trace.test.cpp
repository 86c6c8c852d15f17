// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/knot_trace.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("a trace shows states, inputs, slopes and the inputs' influence at the knots") {
    identification_problem problem;
    problem.model =
        support::model_of({1, 1, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{u[0] * u[0] - p[0] * x[0]};
        });
    problem.choice.unknown = {"p0"};
    problem.prior = box{support::between(0.5, 1.5)};
    experiment e;
    e.name = "E";
    e.begin = 1;
    e.initial = box{interval(2.0)};
    e.inputs = {sampled_signal({0, 5}, {0, 10}, interpolation::linear)};
    for (int k = 1; k <= 40; ++k)
        e.measurements.push_back({1 + 0.05 * k, 0, support::around(0, 1)});
    problem.experiments = {e};
    approximate_campaign c(problem, {{1, 1.5, 2.25}});
    auto z = arrow_vector::like(c.lower(), 1);
    auto const trace = trace_at_knots(c, 0, z);
    REQUIRE(trace.times == std::vector<double>{0, 0.5, 1.25});
    CHECK_THAT(trace.states[0][0], WithinAbs(2, 1e-12));
    CHECK_THAT(trace.inputs[1][0], WithinAbs(3, 1e-9));
    CHECK_THAT(trace.input_slopes[2][0], WithinAbs(2, 1e-9));
    CHECK_THAT(trace.by_input[2][0], WithinAbs(2 * 4.5, 1e-9));
    // x' = 4 t^2 - x from 2 at 1: x = 4 t^2 - 8 t + 8 + c exp(-t).
    double const factor = (2 - 4) * std::exp(1.0);
    CHECK_THAT(trace.states[1][0], WithinAbs(4 * 2.25 - 12 + 8 + factor * std::exp(-1.5), 1e-4));
}
