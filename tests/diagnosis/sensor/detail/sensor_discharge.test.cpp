// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

/// Two carts on one rail, side by side: both are pushed and braked, and their speeds are measured
/// by one instrument. x0' = p0 u0 - p1 x0, x1' = p0 u1 - p1 x1.
recorded_model carts(double gust = 0) {
    return support::model_of(
        {2, 2, 2, 20}, [gust](auto const&, auto const& x, auto const& p, auto const& u) {
            using T = std::decay_t<decltype(x[0])>;
            return std::vector<T>{p[0] * u[0] - p[1] * x[0] + T(gust) * x[0] * abs(x[0]),
                                  p[0] * u[1] - p[1] * x[1]};
        });
}
box const prior{between(0.8, 1.2), between(0.2, 0.5)};

using fault = std::function<std::vector<double>(double t, motion_truth const&)>;

/// What sensors show is made of the truth by `shown`.
identification_problem problem_of(draws& d, recorded_model const& real, fault const& shown,
                                  double error = 0.005) {
    identification_problem problem{carts(), {support::all_constants(2), {}}, prior, {}};
    for (double const pace : {1.1, 1.7}) {
        std::vector<sampled_signal> const inputs{sine_input(2, pace, 5), sine_input(1.5, 0.9, 5)};
        auto const truth = simulate(real, {1, 0.3}, inputs, {0.5, -0.5}, 5);
        experiment e;
        e.name = support::numbered('S', problem.experiments.size());
        for (auto const& i : inputs) e.inputs.emplace_back(i);
        e.initial = point_box(truth.states.front());
        for (int k = 1; k <= 50; ++k) {
            auto const y = shown(k * 0.1, truth);
            for (std::size_t i = 0; i < 2; ++i) {
                double const off = d.uniform(-0.9, 0.9) * error;
                e.measurements.push_back({k * 0.1, i, around(y[i] + off, error)});
            }
        }
        problem.experiments.push_back(std::move(e));
    }
    return problem;
}
std::vector<double> right(double t, motion_truth const& truth) { return truth.at(t); }

} // namespace

TEST_CASE("no fault within the ranges lets an equation be called broken") {
    draws d(41);
    std::vector<std::pair<char const*, fault>> const faults{
        {"offset",
         [](double t, auto const& s) {
             return std::vector<double>{s.at(t)[0] + 0.3, s.at(t)[1]};
         }},
        {"scale",
         [](double t, auto const& s) {
             return std::vector<double>{1.09 * s.at(t)[0], s.at(t)[1]};
         }},
        {"drift",
         [](double t, auto const& s) {
             return std::vector<double>{s.at(t)[0] + 0.05 * t, s.at(t)[1]};
         }},
        {"askew",
         [](double t, auto const& s) {
             double const c = std::cos(0.1), n = std::sin(0.1);
             return std::vector<double>{c * s.at(t)[0] + n * s.at(t)[1], s.at(t)[1]};
         }},
        {"late", [](double t, auto const& s) {
             return std::vector<double>{s.at(std::max(0.0, t - 0.15))[0], s.at(t)[1]};
         }}};
    int broken = 0;
    for (auto const& [what, shown] : faults) {
        INFO(what);
        auto const problem = problem_of(d, carts(), shown);
        for (auto const& f : find_broken_relations(problem)) {
            ++broken;
            CHECK_FALSE(sensor_discharge(problem)(f));
        }
    }
    CHECK(broken >= 3); // together with their sensors they cannot hold
}

TEST_CASE("what no fault of a sensor can do is proved of the equation") {
    draws d(42);
    auto const problem = problem_of(d, carts(-0.6), right, 0.002);
    auto const found = examine_relations(problem)[0];
    REQUIRE(found.proved);
    sensor_fault_ranges ranges;
    ranges.scale = 0.03;
    ranges.offset = 0.02;
    ranges.mixing = 0.02;
    ranges.latency = 0.01;
    auto const place = sensor_discharge(problem, ranges)(found);
    REQUIRE(place);
    CHECK_THAT(place->assumptions.back(), ContainsSubstring("at most one sensor"));
    if (place->missing) {
        CHECK(place->missing->value.upper() < 0);
        // The proof with right sensors says more.
        auto const sure = relation_examiner(problem).missing_over(0, place->missing->window);
        REQUIRE(sure);
        CHECK(subset(*sure, place->missing->value));
    }
    CHECK_FALSE(sensor_discharge(problem, ranges, {}, [] { return false; })(found));
    // An experiment with nothing but a reading at its begin changes nothing.
    auto longer = problem;
    longer.experiments.push_back(problem.experiments[0]);
    longer.experiments.back().name = "begin";
    longer.experiments.back().measurements = {{0, 0, between(-9, 9)}};
    CHECK(sensor_discharge(longer, ranges)(examine_relations(longer)[0]));
    auto definition = found;
    definition.definition = true;
    CHECK_FALSE(sensor_discharge(problem, ranges)(definition));
    CHECK_FALSE(sensor_discharge(problem, ranges)(relation_finding{}));
}

TEST_CASE("a record that ends before a sensor may show anything discharges nobody") {
    auto const cart = support::model_of(
        {1, 2, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            using T = std::decay_t<decltype(x[0])>;
            return std::vector<T>{p[0] * u[0] - p[1] * x[0]};
        });
    identification_problem problem{cart, {support::all_constants(2), {}}, prior, {}};
    experiment e;
    e.name = "S";
    e.inputs = {sine_input(2, 1.1, 1)};
    e.initial = box{interval(0.0)};
    for (int k = 1; k <= 4; ++k)
        e.measurements.push_back({0.1 + k * 0.01, 0, around(k * 1.0, 0.001)});
    problem.experiments.push_back(std::move(e));
    relation_options options;
    options.shortest_gaps = 1;
    auto const found = examine_relations(problem, options)[0];
    REQUIRE(found.proved);
    sensor_fault_ranges ranges;
    ranges.scale = ranges.offset = 0.01;
    ranges.mixing = 0;
    ranges.latency = 0.05;
    CHECK(sensor_discharge(problem, ranges, options)(found));
    ranges.latency = 0.4;
    CHECK_FALSE(sensor_discharge(problem, ranges, options)(found));
}
