// SPDX-License-Identifier: MIT
// The bound alone; that whole trajectories are contained is tested in `uncertain_input.test.cpp`.
#include <sivid/enclosure/step/perturbed_step.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/real_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

template <class Rate>
std::shared_ptr<flow const> free_flow(std::size_t n, Rate const& rate) {
    return support::flow_of(support::model_of({n, 0, 0}, rate));
}

bool prove(perturbed_step<interval>& step, double h, box const& tube) {
    step.set_parameters(box{});
    return step.prove(0, h, between(0, h), tube, true);
}

} // namespace

TEST_CASE("a bound of the rates alone: x' = -x + w") {
    auto const f = free_flow(
        1, [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{-x[0]}; });
    perturbed_step<interval> step(*f);
    step.set_rate_bound({0.1});
    for (double const h : {1e-3, 0.5, 20.0}) {
        REQUIRE(prove(step, h, box{between(0, 1)}));
        double const exact = -0.1 * std::expm1(-h);
        CAPTURE(h);
        CHECK(step.at_end()[0] >= exact);
        CHECK(step.at_end()[0] <= exact * (1 + 1e-6));
        CHECK(step.largest()[0] >= step.at_end()[0] * (1 - 1e-9));
    }
    step.set_rate_bound({}); // nothing is perturbed
    REQUIRE(prove(step, 0.5, box{between(0, 1)}));
    CHECK(step.at_end()[0] < 1e-200);
    CHECK_THROWS_AS(step.set_rate_bound({1, 2}), std::invalid_argument);
    CHECK_THROWS_AS(step.set_rate_bound({-1}), std::invalid_argument);
    CHECK_THROWS_AS(step.set_rate_bound({std::nan("")}), std::invalid_argument);
}

TEST_CASE("an oscillation is not taken for growth") {
    // x'' = -9 x + w: |d(h)| <= w/9 (1 - cos 3h) up to half a period, where Metzler's bound is
    // cosh.
    auto const f = free_flow(2, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{x[1], -9 * x[0]};
    });
    perturbed_step<interval> step(*f);
    step.set_rate_bound({0, 0.1});
    REQUIRE(prove(step, 1.0, box{between(-1, 1), between(-3, 3)}));
    double const exact = 0.1 / 9 * (1 - std::cos(3.0));
    CHECK(step.at_end()[0] >= exact);
    CHECK(step.at_end()[0] <= 1.1 * exact);
    // |v| <= w int_0^h |cos 3s| ds
    double const speed = 0.1 / 3 * (2 - std::sin(3.0));
    CHECK(step.at_end()[1] >= speed);
    CHECK(step.at_end()[1] <= 1.1 * speed);
}

TEST_CASE("a bound of a perturbation does not hang on the units of time and states") {
    // x'' = -9 x + w, x in 2^-k m and the time in 2^-m s.
    for (double const length : {1.0, 0x1p20, 0x1p-30}) {
        for (double const second : {1.0, 0x1p12, 0x1p-12}) {
            double const speed = length / second;
            auto model = support::model_of(
                {2, 0, 0}, [second](auto const&, auto const& x, auto const&, auto const&) {
                    return std::vector{x[1], -9 / (second * second) * x[0]};
                });
            model.about.states[0].limit = length;
            model.about.states[1].limit = 3 * speed;
            auto const f = support::flow_of(model);
            perturbed_step<interval> step(*f);
            step.set_rate_bound({0, 0.1 * speed / second});
            REQUIRE(
                prove(step, second, box{between(-length, length), between(-3 * speed, 3 * speed)}));
            CHECK(step.at_end()[0] <= 1.1 * length * 0.1 / 9 * (1 - std::cos(3.0)));
            CHECK(step.at_end()[1] <= 1.1 * speed * 0.1 / 3 * (2 - std::sin(3.0)));
        }
    }
}

TEST_CASE("an uncertain input is a perturbation of the rates that it enters") {
    auto const swing = [](auto const&, auto const& x, auto const& u) {
        using namespace support::real;
        return std::vector{x[1], u - sin(x[0]) - 0.25 * x[1]};
    };
    auto const with_input = [&](auto const& t, auto const& x, auto const&, auto const& u) {
        return swing(t, x, u[0]);
    };
    auto const without = [&](auto const& t, auto const& x, auto const&, auto const&) {
        return swing(t, x, x[0] - x[0]);
    };
    auto const f =
        support::flow_of(support::model_of({2, 0, 1}, with_input),
                         {sampled_signal({0, 4}, {0, 0}, interpolation::linear, {0.05, 0.05})});
    auto const g = free_flow(2, without);
    perturbed_step<interval> input(*f);
    perturbed_step<interval> rates(*g);
    rates.set_rate_bound({0, 0.05});
    draws d(3);
    for (int round = 0; round < 20; ++round) {
        double const h = d.uniform(0.01, 0.8);
        box const tube{d.interval(-1, 1, 0.2), d.interval(-1, 1, 0.2)};
        REQUIRE(prove(input, h, tube));
        REQUIRE(prove(rates, h, tube));
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK_THAT(input.at_end()[i], WithinRel(rates.at_end()[i], 1e-6));
        }
    }
}

TEST_CASE("errors along a line are integrated, not taken at their largest") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 1}, [](auto const&, auto const& x, auto const&,
                                        auto const& u) { return std::vector{u[0] - x[0]}; }),
        {sampled_signal({0, 1}, {0, 0}, interpolation::linear, {0, 0.2})});
    perturbed_step<interval> step(*f);
    REQUIRE(prove(step, 1, box{between(0, 1)}));
    double const exact = 0.2 * std::exp(-1.0); // int_0^1 e^(s-1) 0.2 s ds
    CHECK(step.at_end()[0] >= exact);
    CHECK(step.at_end()[0] <= exact * (1 + 1e-6));
    CHECK(step.largest()[0] >= exact);
}

TEST_CASE("where the rates jump, their difference bounds the distance") {
    auto const f = free_flow(1, [](auto const&, auto const& x, auto const&, auto const&) {
        using namespace support::real;
        return std::vector{-abs(x[0]) / x[0]};
    });
    perturbed_step<interval> step(*f);
    step.set_rate_bound({0.5});
    // A tube on one side, from which the perturbation leads across 0: 0/0 there, nothing is proved.
    CHECK_FALSE(prove(step, 0.1, box{between(0.01, 0.02)}));
    auto const friction = support::flow_of([] {
        auto m = support::model_of(
            {1, 0, 0}, [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        m.rate[0] = m.g.neg(m.g.unary(operation::sign, m.g.leaf(operation::state, 0)));
        return m;
    }());
    perturbed_step<interval> slip(*friction);
    slip.set_rate_bound({0.5});
    REQUIRE(prove(slip, 0.1, box{between(0.01, 0.02)}));
    CHECK(slip.largest()[0] >= 0.1 * 0.5);
    CHECK(slip.largest()[0] >= 0.1 * 2.5 * (1 - 1e-9)); // from -1 to 1, and the perturbation
    CHECK(slip.largest()[0] <= 0.1 * 2.5 * (1 + 1e-6));
    REQUIRE(prove(slip, 0.1, box{between(1, 2)})); // far from 0 only the perturbation is left
    CHECK(slip.largest()[0] <= 0.1 * 0.5 * (1 + 1e-6));
}

TEST_CASE("what may escape, or is not defined, is not bounded") {
    auto const square = free_flow(1, [](auto const&, auto const& x, auto const&, auto const&) {
        using namespace support::real;
        return std::vector{sqr(x[0])};
    });
    perturbed_step<interval> step(*square);
    step.set_rate_bound({1});
    CHECK(prove(step, 0.1, box{between(0, 1)}));
    CHECK_FALSE(prove(step, 10, box{between(0, 1)}));
    step.set_rate_bound({std::numeric_limits<double>::infinity()});
    CHECK_FALSE(prove(step, 0.1, box{between(0, 1)}));
    auto const root = free_flow(1, [](auto const&, auto const& x, auto const&, auto const&) {
        using namespace support::real;
        return std::vector{-sqrt(x[0])};
    });
    perturbed_step<interval> out(*root);
    out.set_rate_bound({0.1});
    CHECK(prove(out, 0.1, box{between(1, 2)}));
    CHECK_FALSE(prove(out, 0.1, box{between(0.001, 2)}));
}
