// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/sensor/detail/sensor_faults.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

identification_problem two_speeds(draws& d) {
    auto const m = support::model_of({2, 1, 1, 20},
                                     [](auto const&, auto const& x, auto const& p, auto const& u) {
                                         using T = std::decay_t<decltype(x[0])>;
                                         return std::vector<T>{p[0] * u[0] - x[1], p[0] * x[0]};
                                     });
    std::vector<sampled_signal> const inputs{sine_input(2, 1.1, 5)};
    auto const truth = simulate(m, {1}, inputs, {0.5, -0.5}, 5);
    identification_problem problem{m, {support::all_constants(1), {}}, box{between(0.5, 2)}, {}};
    problem.experiments.push_back(measured(d, "S", truth, inputs, {0, 1}, 0.01, noise::uniform));
    return problem;
}

} // namespace

TEST_CASE("the ranges of a sensor's faults are in its unit and mix what one instrument shows") {
    draws d(43);
    auto const problem = two_speeds(d);
    std::vector<std::optional<std::size_t>> const channels{0, 1};
    auto const f = faults_of(problem, channels, 1, {});
    CHECK(f.channel == 1);
    CHECK(f.offset.upper() > 0);
    CHECK_THAT(f.drift.upper(), WithinRel(f.offset.upper() / 5, 1e-9));
    REQUIRE(f.mixing.size() == 1);
    CHECK(f.mixing[0].first == 0);
    auto const [delays, half] = delay_slices(problem, f, 40);
    CHECK_FALSE(delays.empty());
    CHECK(delays.front() - half <= 0);
    CHECK(delays.back() + half >= f.latency);
    for (std::size_t k = 0; k + 1 < delays.size(); ++k) {
        CHECK(delays[k] + half >= delays[k + 1] - half);
    }
    CHECK(fault_assumption(problem, {f}).find("y1") != std::string::npos);
}

TEST_CASE("a suspect's problem is about what its sensor shows") {
    draws d(44);
    auto const problem = two_speeds(d);
    auto const f = faults_of(problem, {0, 1}, 1, {});
    std::map<std::string, std::vector<rate_variation>> const laws{{"S", {{0.1, 1}, {0.1, 2}}}};
    auto const s = suspect_of(problem, f, laws, 0.05, 0.01);
    CHECK(s.problem.prior.size() == 1 + f.size());
    CHECK_NOTHROW(s.problem.require_valid());
    CHECK(s.sensor.laws.at("S")[0].variation == 1);
    CHECK(s.sensor.laws.at("S")[1].variation > 2); // what is shown may vary more than what is
    auto const& before = problem.experiments[0];
    auto const& after = s.problem.experiments[0];
    CHECK(subset(before.initial[1], after.initial[1]));
    CHECK(equal(before.initial[0], after.initial[0]));
    for (auto const& m : after.measurements) {
        auto const same = std::find_if(
            before.measurements.begin(), before.measurements.end(), [&](measurement const& b) {
                double const late = m.channel == 1 ? 0.05 : 0;
                return b.channel == m.channel && std::abs(b.time - late - m.time) < 1e-9;
            });
        REQUIRE(same != before.measurements.end());
        CHECK(subset(same->bound, m.bound));
        CHECK((m.channel == 1 || equal(same->bound, m.bound)));
    }
    // The corrected rates: those of the true state wherever it is shown as it is.
    auto const exact =
        suspect_of(problem, {1, 1, interval(0.0), interval(0.0), interval(0.0), {}, 0}, laws, 0, 0);
    CHECK(exact.problem.experiments[0].measurements.size() == before.measurements.size());
    CHECK(equal(exact.problem.experiments[0].initial[1], before.initial[1]));
}

TEST_CASE("a delay as long as a record leaves nothing of it, one almost as long few outliers") {
    draws d(45);
    auto problem = two_speeds(d);
    auto& e = problem.experiments[0];
    std::erase_if(e.measurements, [](measurement const& m) { return m.channel == 0; });
    e.outliers = 3;
    auto const f = faults_of(problem, {std::nullopt, 1}, 1, {});
    std::map<std::string, std::vector<rate_variation>> const laws{{"S", {{0.1, 1}, {0.1, 2}}}};
    auto const last = e.measurements.back().time;
    auto const few = suspect_of(problem, f, laws, last, 0).problem;
    CHECK(few.experiments.at(0).measurements.size() == 1);
    CHECK_NOTHROW(few.require_valid());
    CHECK(suspect_of(problem, f, laws, last + 0.1, 0).problem.experiments.empty());
}

TEST_CASE("half a slice of delays may span many samples of a dense record") {
    // y' = u - 30 y, shown 0.0999 s late, 50 kHz: within half a slice the speed turns.
    draws d(41);
    auto const m = support::model_of({1, 2, 1, 200},
                                     [](auto const&, auto const& x, auto const& p, auto const& u) {
                                         using T = std::decay_t<decltype(x[0])>;
                                         return std::vector<T>{p[0] * u[0] - p[1] * x[0]};
                                     });
    double const duration = 0.15, period = 0.00002, late = 0.0999, pace = 1000;
    std::vector<double> t, v;
    for (int k = 0; k * 0.00001 <= duration + 1e-9; ++k) {
        t.push_back(k * 0.00001);
        v.push_back(2000 * std::sin(pace * t.back()));
    }
    std::vector<sampled_signal> const inputs{{t, v, interpolation::linear}};
    auto const truth = simulate(m, {1, 30}, inputs, {0.5}, duration, 0.00001);
    identification_problem problem{
        m, {support::all_constants(2), {}}, box{between(0.99, 1.01), between(29, 31)}, {}};
    experiment e;
    e.name = "S";
    e.inputs = {inputs[0]};
    e.initial = point_box(truth.states.front());
    for (int k = 1; k * period <= duration + 1e-9; ++k) {
        double const y = truth.at(std::max(0.0, k * period - late))[0];
        e.measurements.push_back({k * period, 0, around(y + d.uniform(-0.9, 0.9) * 1e-6, 1e-6)});
    }
    problem.experiments.push_back(std::move(e));
    // What the rate varies by within a time: 2000 times what sin(pace t) does, and a little.
    std::map<std::string, std::vector<rate_variation>> const laws{{"S", {{0.0001, 240}}}};
    sensor_fault_ranges ranges;
    ranges.scale = ranges.offset = 0.001;
    ranges.mixing = 0;
    ranges.latency = 0.2;
    auto const s = suspect_of(problem, faults_of(problem, {0}, 0, ranges), laws, 0.0975, 0.0025);
    auto const& moved = s.problem.experiments[0].measurements;
    REQUIRE(moved.size() > 2000);
    for (auto const& one : moved) {
        INFO(one.time);
        REQUIRE(contains(one.bound, truth.at(one.time)[0]));
    }
}
