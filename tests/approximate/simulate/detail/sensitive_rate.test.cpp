// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/detail/sensitive_rate.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>

using namespace sivid;

namespace {

/// x' = -a x y + u, y' = x - y, with a column for a, for both starts and for the hats of d on x.
struct coupled {
    std::shared_ptr<approximate_model const> model = [] {
        parameter_choice choice;
        choice.unknown = {"p0"};
        return std::make_shared<approximate_model const>(
            support::model_of({2, 1, 1},
                              [](auto const&, auto const& x, auto const& p, auto const& u) {
                                  return std::vector{u[0] - p[0] * x[0] * x[1], x[0] - x[1]};
                              }),
            choice, std::vector<signal>{sampled_signal({0}, {0.5}, interpolation::hold)});
    }();
    std::vector<double> knots{0, 1, 2, 3};
    simulation_mesh mesh{
        *model, {sampled_signal({0}, {0.5}, interpolation::hold)}, 0, {{3, 0}}, knots};
    sensitivity_layout layout;

    coupled() {
        layout.parameter_column = {0};
        layout.start_column = {1, 2};
        layout.disturbed = {0};
        layout.first_disturbance = 3;
        layout.columns = 3 + knots.size();
        mesh.place({0.8});
    }
};

} // namespace

TEST_CASE("the rate of a state with its sensitivities is the variational equation") {
    coupled c;
    sensitive_rate rate(c.model, c.knots);
    simulation_state x;
    std::vector<double> const d{0.1, -0.2, 0.3, 0};
    rate.begin(c.mesh, {0.8}, d, c.layout, true, {2, 3}, x);
    CHECK(rate.active() == 5); // the hats of the first two knots
    CHECK(x[rate.at(0, 1)] == 1);
    CHECK(x[rate.at(1, 1)] == 0);
    CHECK(x[rate.at(1, 2)] == 1);
    x[rate.at(0, 0)] = 0.7;
    x[rate.at(1, 0)] = -0.4;
    simulation_state dx(x.size());
    rate(x, dx, 0.25);
    double const missing = 0.75 * 0.1 - 0.25 * 0.2;
    CHECK_THAT(dx[0], WithinAbs(0.5 - 0.8 * 6 + missing, 1e-14));
    CHECK_THAT(dx[1], WithinAbs(-1, 1e-14));
    CHECK_THAT(dx[rate.at(0, 0)], WithinAbs(-0.8 * 3 * 0.7 - 0.8 * 2 * -0.4 - 6, 1e-14));
    CHECK_THAT(dx[rate.at(1, 0)], WithinAbs(0.7 + 0.4, 1e-14));
    CHECK_THAT(dx[rate.at(0, 1)], WithinAbs(-0.8 * 3, 1e-14));
    CHECK_THAT(dx[rate.at(0, 2)], WithinAbs(-0.8 * 2, 1e-14));
    CHECK_THAT(dx[rate.at(0, 3)], WithinAbs(0.75, 1e-14));
    CHECK_THAT(dx[rate.at(0, 4)], WithinAbs(0.25, 1e-14));
    CHECK(dx[rate.at(1, 3)] == 0);
}

TEST_CASE("columns of later disturbances join where they begin to act") {
    coupled c;
    sensitive_rate rate(c.model, c.knots);
    simulation_state x;
    std::vector<double> const d{0, 0, 0, 0};
    rate.begin(c.mesh, {0.8}, d, c.layout, true, {2, 3}, x);
    auto const before = x.size();
    CHECK_FALSE(rate.enter(0, x));
    x[rate.at(1, 4)] = 7;
    CHECK(rate.enter(1, x));
    CHECK(rate.active() == 6);
    CHECK(rate.enter(2, x));
    CHECK(rate.active() == 7);
    CHECK(x.size() == before); // eight columns have had their place
    CHECK(x[rate.at(1, 4)] == 7);
    CHECK(x[rate.at(0, 6)] == 0);
}

TEST_CASE("without sensitivities only the states are there") {
    coupled c;
    sensitive_rate rate(c.model, {});
    sensitivity_layout none;
    none.parameter_column = {sensitivity_layout::none};
    none.start_column = {sensitivity_layout::none, sensitivity_layout::none};
    simulation_state x;
    std::vector<double> const d;
    rate.begin(c.mesh, {0.8}, d, none, false, {2, 3}, x);
    CHECK(x.size() == 4); // the padding is zero
    simulation_state dx(x.size());
    rate(x, dx, 0.25);
    CHECK_THAT(dx[0], WithinAbs(0.5 - 0.8 * 6, 1e-14));
    CHECK(dx[2] == 0);
    CHECK(dx[3] == 0);
}
