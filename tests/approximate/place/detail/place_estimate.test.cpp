// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/detail/place_estimate.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

TEST_CASE("nothing is reported of data that the model explains") {
    draws d(941);
    for (bool const uncertain : {false, true}) {
        auto const estimate = estimate_places(support::hovercraft_campaign(
            d, {}, {.truth = {{"Sv", 0.21}}, .uncertain_starts = uncertain}));
        CHECK(estimate.base.inflation <= 1);
        CHECK(estimate.places.empty());
        CHECK(estimate.tried.empty());
    }
}

TEST_CASE("equation, sensor and input are told apart") {
    draws d(942);
    place_options options;
    options.equation_names = {{"u", "surge"}, {"v", "sway"}, {"r", "yaw"}};
    SECTION("yaw friction, with outliers") {
        support::hover_effect effect;
        effect.rates = [](double, support::motion const& x, auto const&, auto const&,
                          support::motion& rate) { rate[2] -= 2 * std::abs(x[2]) * x[2]; };
        auto const found = estimate_places(
            support::hovercraft_campaign(d, effect, {.outlier_fraction = 0.05}), options);
        REQUIRE(found.places.size() == 1);
        auto const& p = found.places.front();
        CHECK(p.kind == place_kind::equation);
        CHECK(p.name == "yaw");
        CHECK(p.law == "abs(r)*r");
        CHECK(p.unit == "rad/s^2");
        CHECK(found.inflation <= 1);
        CHECK(p.rates.size() == 5);
        CHECK(p.from < p.to);
        CHECK(std::abs(p.missing) > 3 * p.deviation);
    }
    SECTION("a late position") {
        support::hover_effect effect;
        effect.sensors = [](double t, auto const& at) {
            auto y = at(t);
            auto const late = at(std::max(0.0, t - 0.2));
            y[3] = late[3];
            y[4] = late[4];
            return y;
        };
        auto const found = estimate_places(support::hovercraft_campaign(d, effect, {}), options);
        REQUIRE(found.places.size() == 1);
        CHECK(found.places[0].kind == place_kind::sensor);
        CHECK(found.places[0].members == std::vector<std::size_t>{3, 4});
        CHECK(found.places[0].law == "latency");
        CHECK_THAT(found.places[0].missing, WithinAbs(0.2, 0.03));
    }
    SECTION("a rudder that saturates, starts uncertain") {
        support::hover_effect effect;
        effect.inputs = [](double t, auto const& recorded) {
            return support::controls{recorded(t)[0], std::clamp(recorded(t)[1], -0.2, 0.2)};
        };
        auto const found = estimate_places(
            support::hovercraft_campaign(d, effect, {.uncertain_starts = true}), options);
        REQUIRE_FALSE(found.places.empty());
        CHECK(found.places[0].kind == place_kind::input);
        CHECK(found.places[0].name == "delta");
        CHECK(found.places[0].regime.rfind("abs(delta) > ", 0) == 0);
    }
}

TEST_CASE("a pendulum of which only the angle is measured misses its friction") {
    draws d(943);
    identification_problem problem;
    problem.model = support::model_of(
        {2, 1},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[1], -(p[0] * sin(x[0]))};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{x[0]}; });
    problem.choice.unknown = {"p0"};
    problem.prior = box{support::between(8, 12)};
    for (double const start : {1.2, 2.0}) {
        experiment e;
        e.name = "release from " + std::to_string(start);
        e.initial = box{interval(start), interval(0.0)};
        double angle = start, speed = 0;
        double const h = 1e-4;
        for (int k = 1; k <= 60000; ++k) {
            auto const pull = [&](double a, double s) { return -9.81 * std::sin(a) - 0.3 * s; };
            double const middle = angle + 0.5 * h * speed;
            double const fast = speed + 0.5 * h * pull(angle, speed);
            angle += h * fast;
            speed += h * pull(middle, fast);
            if (k % 500 != 0) continue;
            e.measurements.push_back(
                {k * h, 0, support::around(angle + d.uniform(-0.01, 0.01), 0.01)});
        }
        problem.experiments.push_back(e);
    }
    auto const found = estimate_places(problem);
    REQUIRE(found.places.size() == 1);
    CHECK(found.base.inflation > 5);
    CHECK(found.places[0].kind == place_kind::equation);
    CHECK(found.places[0].name == "x1");
    CHECK(found.places[0].law == "x1");
}

TEST_CASE("of many measurements the place and the scenario are told by all of its time") {
    auto real = small_campaign::with_scale(0.15);
    real.every = 1; // ms: 16000 measurements
    auto problem = small_campaign::problem(real);
    problem.experiments = {small_campaign::experiment(1, real),
                           small_campaign::experiment(2, real)};
    for (auto& m : problem.experiments[0].measurements) { // misses much, but later nothing
        double const middle = mid(m.bound);
        if (m.time > 0.8) m.bound = interval(middle - 2, middle + 2);
    }
    for (auto& m : problem.experiments[1].measurements) { // the other way round
        double const middle = mid(m.bound), half = rad(m.bound) * (m.time > 1.3 ? 0.62 : 3);
        m.bound = interval(middle - half, middle + half);
    }
    auto const found = estimate_places(problem);
    REQUIRE(found.places.size() == 1);
    auto const& p = found.places[0];
    CHECK(p.kind == place_kind::sensor);
    CHECK(p.name == "p");
    CHECK(p.law == "scale");
    CHECK_THAT(p.missing, WithinAbs(0.15, 0.02));
    CHECK(p.to == 4);
    std::vector<double> all, early; // squares of what is missed of the position
    for (std::size_t e = 0; e < 2; ++e) {
        auto const data = sorted(problem.experiments[e].measurements);
        double sum = 0;
        for (std::size_t k = 0; k < data.size(); ++k) {
            if (k == data.size() / 3) early.push_back(sum);
            if (data[k].channel == 0) sum += std::pow(found.base.residuals[e][k], 2);
        }
        all.push_back(sum);
    }
    CHECK(early[0] > early[1]);
    CHECK(all[0] < all[1]);
    CHECK(p.scenario == problem.experiments[1].name);
}
