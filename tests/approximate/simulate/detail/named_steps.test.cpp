// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/detail/named_steps.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace sivid;

namespace {

/// x' = x, y' = -5 y; only x is controlled.
class growth final : public rate_function {
public:
    void operator()(simulation_state const& x, simulation_state& dx, double) override {
        dx[0] = x[0];
        dx[1] = -5 * x[1];
        ++calls;
    }
    int calls = 0;
};

} // namespace

TEST_CASE("a step that misses too much is shortened, one that is taken has its order") {
    for (auto make : {classical_steps, dormand_prince_steps}) {
        auto const steps = make();
        steps->tolerance.absolute = {1e-6};
        growth rate;
        simulation_state x = simulation_state::Ones(2), dx(2), to, there;
        rate(x, dx, 0);
        double t = 0, h = 3;
        CHECK(steps->step(rate, x, dx, t, to, there, h) == step_outcome::too_long);
        CHECK(t == 0);
        CHECK(h < 3);
        h = 0.05;
        rate.calls = 0;
        REQUIRE(steps->step(rate, x, dx, t, to, there, h) == step_outcome::with_rate);
        CHECK(rate.calls == (make == classical_steps ? 4 : 6)); // the first came from before
        CHECK(t == 0.05);
        CHECK_THAT(to[0], WithinAbs(std::exp(0.05), 1e-8));
        CHECK_THAT(to[1], WithinAbs(std::exp(-0.25), 1e-5));
        CHECK(there[0] == to[0]);
    }
}

TEST_CASE("no step is accepted that leaves the doubles, and the shortest is whatever it misses") {
    auto const steps = classical_steps();
    steps->tolerance.absolute = {1e-12};
    growth rate;
    simulation_state x(2), dx(2), to, there;
    x << 1e308, 1;
    rate(x, dx, 0);
    double t = 0, h = 2;
    steps->tolerance.shortest = 2;
    CHECK(steps->step(rate, x, dx, t, to, there, h) == step_outcome::too_long);
    x[0] = 1;
    rate(x, dx, 0);
    h = 0.5;
    CHECK(steps->step(rate, x, dx, t, to, there, h) == step_outcome::with_rate);
}
