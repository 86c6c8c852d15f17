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

TEST_CASE("an isolated reading may have moved by what the rate varies by in the gaps beside it") {
    // Gaps of ten periods on either side of a reading at the turn of a motion with |x''| <= 10: its
    // rate varies by 1 within each period of 0.1 s, and by 10 within the gaps.
    auto const truth = [](double t) {
        double const s = std::abs(t - 2);
        return (t < 2 ? -1 : 1) * (s <= 1 ? 5 * s - 5 * s * s : 5 - 5 * s);
    };
    auto const m =
        support::model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p,
                                             auto const&) { return std::vector{p[0] * x[0]}; });
    double const late = 0.2, half = 0.01;
    std::vector<double> times;
    for (int k = 1; k <= 10; ++k) times.push_back(0.1 * k);
    times.push_back(2 + late);
    for (int k = 0; k < 10; ++k) times.push_back(3 + 2 * late + 0.1 * k);
    experiment e;
    e.name = "S";
    e.initial = box{around(truth(0), 0.001)};
    for (double const t : times) e.measurements.push_back({t, 0, around(truth(t - late), 0.0001)});
    identification_problem const problem{
        m, {support::all_constants(1), {}}, box{between(0, 1)}, {e}};
    std::map<std::string, std::vector<rate_variation>> const laws{{"S", {{0.1, 1.001}}}};
    faulty_channel const f{0, 0, interval(0.0), interval(0.0), interval(0.0), {}, late};
    auto const s = suspect_of(problem, f, laws, late - half, half * (1 + 1e-9));
    auto const& moved = s.problem.experiments[0].measurements;
    CHECK(moved.size() == 19); // all but those of before the begin
    for (auto const& one : moved) {
        INFO(one.time);
        CHECK(contains(one.bound, truth(one.time)));
    }
    // Of one reading alone no rate can be told.
    auto single = problem;
    single.experiments[0].measurements = {e.measurements.back()};
    auto const vague = suspect_of(single, f, laws, late - half, half);
    CHECK_FALSE(is_bounded(vague.problem.experiments[0].measurements[0].bound));
}

TEST_CASE("late readings are followed at times since 1970, which are rounded") {
    auto const m =
        support::model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p,
                                             auto const&) { return std::vector{p[0] * x[0]}; });
    double const begin = 1.7e9;
    experiment e;
    e.name = "S";
    e.begin = begin;
    e.initial = box{between(-1, 1)};
    for (int k = 1; k < 20; ++k) {
        double const t = begin + 0.1 * k;
        e.measurements.push_back({t, 0, around(1000 * (t - begin - 0.0301), 1e-6)});
    }
    identification_problem const problem{
        m, {support::all_constants(1), {}}, box{between(0, 1)}, {e}};
    faulty_channel const f{0, 0, interval(0.0), interval(0.0), interval(0.0), {}, 0.05};
    auto const s = suspect_of(problem, f, {{"S", {{0.1, 0}}}}, 0.0301, 0);
    for (auto const& one : s.problem.experiments[0].measurements)
        CHECK(contains(one.bound, 1000 * (one.time - begin)));
}

TEST_CASE("experiments that a delay leaves without a reading are left out") {
    draws d(45);
    auto problem = two_speeds(d);
    auto at_begin = problem.experiments[0];
    at_begin.name = "begin";
    at_begin.measurements = {{0, 1, between(-1, 0)}};
    auto few = problem.experiments[0];
    few.name = "few";
    few.outliers = few.measurements.size();
    problem.experiments.insert(problem.experiments.end(), {at_begin, few});
    faulty_channel const f{1, 1, interval(0.0), interval(0.0), interval(0.0), {}, 0.2};
    std::map<std::string, std::vector<rate_variation>> laws;
    for (auto const& e : problem.experiments) laws[e.name] = {{0.1, 1}, {0.1, 2}};
    auto const s = suspect_of(problem, f, laws, 0.15, 0.01);
    CHECK_NOTHROW(s.problem.require_valid());
    REQUIRE(s.problem.experiments.size() == 2);
    CHECK(s.problem.experiments[1].name == "few");
    CHECK(s.problem.experiments[1].outliers < few.outliers);
    problem.experiments = {at_begin};
    CHECK(suspect_of(problem, f, laws, 0.15, 0.01).problem.experiments.empty());
}

TEST_CASE("a second sensor of a state does not stand for the suspect one") {
    draws d(46);
    auto problem = two_speeds(d);
    auto& model = problem.model;
    model.about.channels.push_back(model.about.channels[1]);
    model.about.channels.back().name = "twin";
    model.observe.push_back(model.observe[1]);
    auto& e = problem.experiments[0];
    std::erase_if(e.measurements,
                  [](measurement const& m) { return m.channel == 1 && m.time > 0.15; });
    for (int k = 1; k < 40; ++k) e.measurements.push_back({0.1 * k, 2, between(-9, 9)});
    auto const shown = [](identification_problem const& p) {
        auto const bound = bind(p.model, p.choice, {sampled_signal({0.0}, {0.0}, {})});
        return measured_states(bound, {&p.experiments[0]})[1];
    };
    CHECK(shown(problem) == 1U);
    faulty_channel const f{1, 1, between(-0.1, 0.1), interval(0.0), interval(0.0), {}, 0.3};
    auto const s = suspect_of(problem, f, {{"S", {{0.1, 1}, {0.1, 2}}}}, 0.2, 0.01);
    CHECK_FALSE(shown(s.problem)); // its only reading is of before the begin
}

TEST_CASE("readings without a bound on some side say nothing of what a sensor may do") {
    draws d(47);
    auto const bounded = two_speeds(d);
    auto problem = bounded;
    auto more = problem.experiments[0];
    more.name = "more";
    for (auto& m : more.measurements)
        m.bound = interval_traits<interval>::bounds(m.bound.lower(), HUGE_VAL);
    problem.experiments.push_back(more);
    auto const f = faults_of(problem, {0, 1}, 1, {});
    auto const same = faults_of(bounded, {0, 1}, 1, {});
    CHECK(equal(f.offset, same.offset));
    CHECK(equal(f.drift, same.drift));
    auto const [delays, half] = delay_slices(problem, f, 40);
    CHECK(delays == delay_slices(bounded, same, 40).first);
    CHECK(half > 0);
}
