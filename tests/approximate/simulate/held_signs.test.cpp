// SPDX-License-Identifier: MIT
// Dry friction with `sign` in simulations and fits: what sticks rests.
#include <sivid/approximate/simulate/detail/held_signs.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>
#include <memory>
#include <vector>

using namespace sivid;

namespace {

/// x' = v, v' = u - p0 sign(v)
recorded_model block() {
    return support::model_of({2, 1, 1},
                             [](auto const&, auto const& x, auto const& p, auto const& u) {
                                 return std::vector{x[1] + 0 * x[0], u[0] - p[0] * sign(x[1])};
                             });
}
sampled_signal const push({0, 1, 2, 6}, {0.5, 3, 0, 0}, interpolation::hold);

std::vector<std::vector<double>> motion(recorded_model const& model, std::vector<double> const& p,
                                        std::vector<double> const& times) {
    parameter_choice choice;
    for (std::size_t k = 0; k < p.size(); ++k) choice.unknown.push_back("p" + std::to_string(k));
    auto const plain =
        std::make_shared<approximate_model const>(model, choice, std::vector<signal>{push});
    return simulate(plain, {push}, std::vector<double>(model.rate.size()), p, 0, times).states;
}

/// Of a block with friction 1: it sticks, is pushed from t = 1 to 2, and has stopped at t = 4.
double place(double t) {
    if (t < 1) return 0;
    if (t < 2) return (t - 1) * (t - 1);
    double const on = std::min(t, 4.0) - 2;
    return 1 + 2 * on - on * on / 2;
}

} // namespace

TEST_CASE("a block that sticks rests, and slides where it is pushed") {
    std::vector<double> const times{0.5, 1, 1.5, 2, 3, 4, 5, 6};
    auto const found = motion(block(), {1}, times);
    for (std::size_t k = 0; k < times.size(); ++k) {
        CAPTURE(times[k]);
        CHECK(std::abs(found[k][0] - place(times[k])) < 2e-3);
    }
    CHECK(std::abs(found[1][0]) < 1e-6);               // not crept
    CHECK(std::abs(found[7][0] - found[6][0]) < 1e-6); // nor afterwards
    auto const free = motion(block(), {0}, {2});       // no friction: the push alone
    CHECK(std::abs(free[0][0] - 2.25) < 1e-6);
}

TEST_CASE("blocks that hold each other rest together") {
    auto const model =
        support::model_of({2, 2, 1}, [](auto const&, auto const& v, auto const& p, auto const& u) {
            auto const between = p[1] * sign(v[0] - v[1]);
            return std::vector{u[0] - p[0] * sign(v[0]) - between, between + 0 * v[0]};
        });
    auto const found = motion(model, {1, 2}, {1, 2, 6});
    for (auto const i : {0, 1}) {
        CHECK(std::abs(found[0][static_cast<std::size_t>(i)]) < 2e-3);     // of the layer's 0.02
        CHECK(std::abs(found[1][static_cast<std::size_t>(i)] - 1) < 1e-2); // 3 - 1 moves two
        CHECK(std::abs(found[2][static_cast<std::size_t>(i)]) < 2e-3);
    }
}

TEST_CASE("a model without jumps of its states stays what it is") {
    auto const model =
        support::model_of({1, 1, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{abs(x[0]) * p[0] + sign(u[0])};
        });
    auto const same = with_held_signs(model);
    CHECK(same.g.size() == model.g.size());
    CHECK(same.rate == model.rate);
}

TEST_CASE("a fit follows the slope of dry friction") {
    identification_problem problem;
    problem.model = block();
    problem.choice.unknown = {"p0"};
    problem.prior = box{interval(0.0, 2.9)};
    experiment e;
    e.name = "E";
    e.inputs = {push};
    e.initial = box{interval(0.0), interval(0.0)};
    auto const true_motion = motion(block(), {0.83}, {1, 1.5, 2, 2.5, 3, 4, 5});
    double const times[] = {1, 1.5, 2, 2.5, 3, 4, 5};
    for (std::size_t k = 0; k < true_motion.size(); ++k)
        e.measurements.push_back(
            {times[k], 0, interval(true_motion[k][0] - 0.01, true_motion[k][0] + 0.01)});
    problem.experiments = {e};
    auto const found = fit(problem);
    CHECK(found.inflation < 0.2);
    REQUIRE(found.parameters.size() == 1);
    CHECK(std::abs(found.parameters[0] - 0.83) < 0.01);
}
