// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/odeint_stepping.hpp>

#include <sivid/approximate/simulate/approximate_simulator.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/modified_midpoint.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <cmath>

using namespace sivid;
namespace odeint = boost::numeric::odeint;

TEST_CASE("sensitivities are right by any stepper of Odeint, over knots of an input") {
    // x' = -a x + u with u = t on [0, 1], then 2 - t: solved by hand.
    sampled_signal const u({0, 1, 2}, {0, 1, 0}, interpolation::linear);
    parameter_choice choice;
    choice.unknown = {"p0"};
    auto const model = std::make_shared<approximate_model const>(
        support::model_of({1, 1, 1}, [](auto const&, auto const& x, auto const& p,
                                        auto const& v) { return std::vector{v[0] - p[0] * x[0]}; }),
        choice, std::vector<signal>{u});
    auto const exact = [](double a, double x0) {
        double const e = std::exp(-a);
        double const at_one = x0 * e + 1 / a - (1 - e) / (a * a);
        return at_one * e + (1 - e) / a * (1 / a + 1) - 1 / a;
    };
    sensitivity_layout layout;
    layout.parameter_column = {0};
    layout.start_column = {1};
    layout.columns = 2;
    struct method {
        stepping_maker steps;
        double tolerance;
    };
    for (auto const& m : {method{classical_steps, 1e-6}, method{dormand_prince_steps, 1e-6},
                          method{step_by<odeint_method<odeint::runge_kutta_cash_karp54>>, 1e-6},
                          method{step_by<odeint_method<odeint::runge_kutta_fehlberg78>>, 1e-6},
                          method{step_by<odeint_method<odeint::bulirsch_stoer>>, 1e-6},
                          method{step_by<odeint_method<odeint::runge_kutta4>>, 1e-2}}) {
        approximate_simulator run(model, {u}, 0, {{2, 0}}, {1e-8}, {}, m.steps);
        simulated_outputs out;
        double const a = 0.7, x0 = 0.4, h = 1e-5;
        REQUIRE(run({x0}, {a}, {}, layout, true, out));
        CHECK_THAT(out.values[0], WithinAbs(exact(a, x0), m.tolerance));
        CHECK_THAT(out.jacobian[0],
                   WithinAbs((exact(a + h, x0) - exact(a - h, x0)) / (2 * h), m.tolerance));
        CHECK_THAT(out.jacobian[1], WithinAbs(std::exp(-2 * a), m.tolerance));
    }
}
