// SPDX-License-Identifier: MIT
// Sampled loops, simulated sample by sample, against what is proved of the closed model.
#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/decision/control_law.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/model/closed_loop.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace decision_support;

namespace {

constexpr double period = 0.02, delay = 0.015, sensor = 0.01, end = 2;

sivid::recorded_model plant() { // x0' = u0 - p0 x0
    return support::model_of(
        {.states = 1, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{u[0] - c[0] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
}

struct loop {
    sivid::closed_model closed;
    sivid::prediction_problem problem;

    loop(std::string const& law, double slew, sivid::recorded_model model = plant()) {
        sivid::closed_loop l(std::move(model));
        l.sensor("y0", sensor);
        l.sampled(period, delay);
        l.slew("u0", slew);
        sivid::command_by(law, l, end);
        closed = l.finish();
        problem.model = closed.model;
        problem.choice.unknown = {"p0"};
        problem.sets = {{between(0.5, 1)}};
        problem.initial = {between(0, 0.1)};
        std::vector<sivid::signal> const open(
            1, sivid::sampled_signal({0}, {0}, sivid::interpolation::hold));
        problem.inputs = closed.inputs(open);
        problem.end = end;
    }
    [[nodiscard]] sivid::verification verified(std::string const& text, double seconds = 10) const {
        auto p = problem;
        auto const what = sivid::parse_requirement(closed.with_slews(text), p.model, end);
        return sivid::verify(p, what, all_feasible(p), {.seconds = seconds});
    }
};

/// The state and what is commanded at each of some times, when the law acts on samples that are
/// taken, late and wrong as they may be.
std::vector<std::pair<double, double>> sampled_motion(std::function<double(double)> const& law,
                                                      double rate, double x,
                                                      std::vector<double> const& times,
                                                      std::mt19937& random, bool extreme) {
    std::uniform_real_distribution<double> share(0, 1);
    auto const up_to = [&](double most) {
        return extreme ? (share(random) < 0.5 ? 0.0 : most) : most * share(random);
    };
    double const bias = share(random) < 0.5 ? -sensor : sensor; // an error that stays is worst
    auto const error = [&] { return extreme ? bias : sensor * (2 * share(random) - 1); };
    std::vector<std::pair<double, double>> result;
    double t = 0, u = law(x + error()), next_sample = extreme ? period : up_to(period);
    std::deque<std::pair<double, double>> waiting; // when, what
    auto next = times.begin();
    while (next != times.end()) {
        double const act = waiting.empty() ? HUGE_VAL : waiting.front().first;
        double const to = std::min({*next, next_sample, act});
        double const rest = u / rate; // exact between two events
        x = rest + (x - rest) * std::exp(-rate * (to - t));
        t = to;
        if (t == act) {
            u = waiting.front().second;
            waiting.pop_front();
        } else if (t == next_sample) {
            double const when = t + (extreme ? delay : up_to(delay));
            if (waiting.empty() || waiting.back().first <= when)
                waiting.emplace_back(when, law(x + error()));
            next_sample = t + (extreme ? period : std::max(1e-4, up_to(period)));
        } else {
            result.emplace_back(x, u);
            ++next;
        }
    }
    return result;
}

void attack(std::string const& text, double slew, std::function<double(double)> const& law) {
    loop l(text, slew);
    REQUIRE(l.closed.slews.size() == 1);
    CAPTURE(text);
    REQUIRE(l.verified("x0 < 2").answer == sivid::requirement_answer::proved); // the slew is kept
    auto const tubes = sivid::predict(l.problem, {.cells = 50});
    REQUIRE(tubes.complete);
    auto const& tube = tubes.states[0];
    auto const& command = tubes.channels[1];
    REQUIRE(command.name == "u0");
    std::mt19937 random(7);
    double reached = 0;
    for (int n = 0; n < support::swept(60, 400); ++n) {
        double const rate = n % 3 == 0 ? 0.5 : n % 3 == 1 ? 1 : 0.75;
        double const start = n % 2 == 0 ? 0 : 0.1;
        auto const motion = sampled_motion(law, rate, start, tubes.times, random, n % 4 < 2);
        for (std::size_t k = 0; k < motion.size(); ++k) {
            auto const [x, u] = motion[k];
            CHECK(x >= tube.low[2 * k] - 1e-12);
            CHECK(x <= tube.high[2 * k] + 1e-12);
            CHECK(u >= command.low[2 * k] - 1e-12);
            CHECK(u <= command.high[2 * k] + 1e-12);
        }
        reached = std::max(reached, motion.back().first);
    }
    CHECK(tube.high.back() - reached < 0.2); // and not by far
}

std::string refusal(std::function<void(sivid::closed_loop&)> const& with) {
    sivid::closed_loop l(support::model_of(
        {.states = 1, .constants = 1, .inputs = 2},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{u[0] + u[1] - c[0] * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; }));
    try {
        l.sampled(period, delay);
        with(l);
        static_cast<void>(l.finish());
    } catch (std::invalid_argument const& e) {
        return e.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("sampled, late and noisy loops move within the tubes of the closed model") {
    attack("u0 = 3 * (1 - measured(y0))", 12, [](double y) { return 3 * (1 - y); });
    if (!support::long_sweeps) return;
    attack("u0 = 2 * tanh(2 * (1 - measured(y0)))", 12,
           [](double y) { return 2 * std::tanh(2 * (1 - y)); });
}

TEST_CASE("a limit of the slew that is not kept proves nothing") {
    loop fast("u0 = 3 * (1 - measured(y0))", 2); // u0' = -3 x0', 9 at the begin
    loop just("u0 = 3 * (1 - measured(y0))", 8);
    for (auto* l : {&fast, &just}) { // what holds, and what does not: nothing is known
        CHECK(l->verified("x0 < 2", 1).answer == sivid::requirement_answer::open);
        CHECK(l->verified("x0 > 2", 1).answer == sivid::requirement_answer::open);
    }
    auto const says = fast.verified("x0 < 2", 1);
    REQUIRE_FALSE(says.open.empty());
    CHECK(says.open.front().why == sivid::open_reason::not_kept);
    CHECK(says.found.low < -1e300);
    CHECK(says.found.high > 1e300);
    loop kept("u0 = 3 * (1 - measured(y0))", 12);
    CHECK(kept.verified("x0 > 2").answer == sivid::requirement_answer::refuted);
}

TEST_CASE("gains whose slew is not kept are not excluded") {
    for (double const slew : {0.5, 20.0}) {
        sivid::closed_loop l(plant());
        l.sampled(0.01, 0);
        l.slew("u0", slew);
        l.gain("K", "1");
        sivid::command_by("u0 = K * (1 - measured(y0))", l, end);
        auto const closed = l.finish();
        sivid::prediction_problem p;
        p.model = closed.model;
        p.choice.unknown = {"p0", "K"};
        p.sets = {{between(0.5, 1), between(2, 3)}};
        p.initial = closed.initial({sivid::interval(0.0)}, {}, {});
        p.inputs = closed.inputs({});
        p.end = end;
        bool const kept = slew > 1;
        for (bool const holds : {true, false}) { // x0 stays below 1
            auto const what = sivid::parse_requirement(
                closed.with_slews(holds ? "always(x0 < 2)" : "x0 at end > 2"), p.model, end);
            auto const found =
                sivid::find_gains(p, {"K"}, what, all_feasible(p), {{.seconds = 20}, 200, 1e-2});
            CHECK(found.some_proved() == (kept && holds));
            CHECK(found.none_exists() == (kept && !holds));
            CHECK(found.unknown == !kept);
        }
    }
}

TEST_CASE("a channel of the model that has the name of a rate does not stand for it") {
    auto model = plant();
    model.about.channels.push_back({"u0.slew", "1"});
    model.observe.push_back(model.g.constant(0.0));
    model.about.channels.push_back({"u0", "1"});
    model.observe.push_back(model.g.constant(0.0));
    loop just("u0 = 3 * (1 - measured(y0))", 8, model); // 9 at the begin
    CHECK(just.verified("x0 < 2").answer != sivid::requirement_answer::proved);
    loop kept("u0 = 3 * (1 - measured(y0))", 12, model);
    CHECK(kept.verified("x0 < 2").answer == sivid::requirement_answer::proved);
    auto const& channels = kept.closed.model.about.channels;
    REQUIRE(channels.size() == 5);
    CHECK(channels[3].name == "u0.command");
    CHECK(channels[4].name == "u0.slew.slew");
    CHECK(kept.closed.slews[0].channel == channels[4].name);
}

TEST_CASE("the rate of a command holds for any error of the sample") {
    // d/dt tanh(20 y) depends on the error: 0.01 moves it from one side of the bend to the other.
    loop l("u0 = -tanh(20 * measured(y0)) + 0 * t", 25);
    auto const tubes = sivid::predict(l.problem, {.cells = 40});
    auto const slew = std::find_if(tubes.channels.begin(), tubes.channels.end(),
                                   [](auto const& c) { return c.name == "u0.slew"; });
    REQUIRE(slew != tubes.channels.end());
    for (double const x : {0.0, 0.05, 0.1}) {
        for (double const now : {-sensor, sensor}) {
            for (double const then : {-sensor, sensor}) {
                double const rate = -std::tanh(20 * (x + now)) - x; // p0 = 1
                double const c = std::cosh(20 * (x + then));
                CHECK(slew->low[0] <= -20 / (c * c) * rate);
                CHECK(slew->high[0] >= -20 / (c * c) * rate);
            }
        }
    }
}

TEST_CASE("a constant command needs no limit of its slew") {
    sivid::closed_loop l(plant());
    l.sampled(period, delay);
    l.command("u0", l.constant("p0") * 2.0);
    auto const closed = l.finish();
    CHECK(closed.slews.empty());
    CHECK(closed.own_inputs.empty());
    CHECK(closed.with_slews("x0 > 1") == "x0 > 1");
}

TEST_CASE("laws that cannot be sampled are refused") {
    auto const x = [](sivid::closed_loop& l) { return l.state("x0"); };
    CHECK_THAT(refusal([&](auto& l) { l.command("u0", x(l)); }),
               ContainsSubstring("'u0' is not limited"));
    auto const limited = [&](std::string const& law) {
        return refusal([&](auto& l) {
            l.slew("u0", 1);
            sivid::command_by(law, l, end);
        });
    };
    CHECK(limited("u0 = x0") == "nothing");
    CHECK_THAT(limited("u0 = sign(x0)"), ContainsSubstring("jumps"));
    CHECK_THAT(limited("u0 = integral(x0)"), ContainsSubstring("integral"));
    CHECK_THAT(limited("u0 = x0 * during(0, 1)"), ContainsSubstring("switches in time"));
    CHECK_THAT(limited("u0 = x0 + u1"), ContainsSubstring("depends on the input 'u1'"));
    CHECK_THAT(refusal([](auto& l) { l.sampled(0, 1); }), ContainsSubstring("above 0"));
    CHECK_THAT(refusal([](auto& l) { l.sampled(1, -1); }), ContainsSubstring("0 or more"));
    CHECK_THAT(refusal([](auto& l) { l.slew("u0", 0); }), ContainsSubstring("above 0"));
    CHECK_THAT(refusal([](auto& l) { l.slew("u9", 1); }), ContainsSubstring("u9"));
}
