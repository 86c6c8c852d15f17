// SPDX-License-Identifier: MIT
#include <sivid/decision/gain_search.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/model/closed_loop.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace decision_support;

namespace {

/// Bounded by boxes, not by time: the same on a slow machine.
sivid::gain_options until(double accuracy, std::size_t boxes = 20'000) {
    return {{.seconds = 300}, boxes, accuracy};
}

/// x0' = u0 - p0 x0 under u0 = K (1 - x0) from x0(0) = 0: x0(t) = K / a (1 - exp(-a t)), a = K +
/// p0.
struct servo {
    sivid::prediction_problem problem;
    sivid::requirement what;

    servo(std::vector<sivid::interval> const& rates, sivid::interval const& gains,
          std::string const& text, double sensor_bound = 0) {
        auto const open = support::model_of(
            {.states = 1, .constants = 1, .inputs = 1},
            [](auto const&, auto const& x, auto const& c, auto const& u) {
                return std::vector{u[0] - c[0] * x[0]};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        sivid::closed_loop law(open);
        if (sensor_bound > 0) law.sensor("y0", sensor_bound);
        auto const k = law.gain("K", "1/s");
        law.command("u0", k * (1.0 - law.measured("y0")));
        auto const closed = law.finish();
        problem.model = closed.model;
        problem.choice.unknown = {"p0", "K"};
        for (auto const& r : rates) problem.sets.push_back({r, gains});
        problem.initial = closed.initial({sivid::interval(0.0)}, {}, {});
        problem.inputs = closed.inputs({});
        problem.end = 2;
        what = sivid::parse_requirement(text, problem.model, problem.end);
    }
    [[nodiscard]] sivid::gain_set found(sivid::gain_options const& o = until(1e-3)) const {
        return found(all_feasible(problem), o);
    }
    [[nodiscard]] sivid::gain_set found(sivid::feasible_points const& feasible,
                                        sivid::gain_options const& o = until(1e-3)) const {
        return sivid::find_gains(problem, {"K"}, what, feasible, o);
    }
};

double servo_at(double t, double rate, double gain) {
    double const a = gain + rate;
    return gain / a * (1 - std::exp(-a * t));
}

sivid::box_verdict verdict_at(sivid::gain_set const& g, double gain) {
    for (auto const& b : g.paving.paving.boxes()) {
        if (b.set[0].lower() <= gain && gain <= b.set[0].upper()) return b.verdict;
    }
    return sivid::box_verdict::pending;
}

/// Counts how many of many gains are decided, and checks every decision against `holds`.
double decided_share(sivid::gain_set const& g, double low, double high,
                     std::function<bool(double)> const& holds) {
    std::size_t decided = 0;
    constexpr std::size_t all = 2000;
    for (std::size_t k = 0; k < all; ++k) {
        double const gain = low + (high - low) * (static_cast<double>(k) + 0.37) / all;
        auto const says = verdict_at(g, gain);
        if (says == sivid::box_verdict::inside) CHECK(holds(gain));
        if (says == sivid::box_verdict::outside) CHECK_FALSE(holds(gain));
        decided += says == sivid::box_verdict::inside || says == sivid::box_verdict::outside;
    }
    return static_cast<double>(decided) / all;
}

} // namespace

TEST_CASE("gains are proved for all parameters or excluded by one") {
    servo const s({between(0.5, 1)}, between(0, 20), "x0 at end in [0.8, 0.92]");
    auto const g = s.found();
    auto const holds = [](double gain) {
        return servo_at(2, 1, gain) >= 0.8 && servo_at(2, 0.5, gain) <= 0.92;
    };
    CHECK(decided_share(g, 0, 20, holds) > 0.99);
    CHECK(g.some_proved());
    CHECK_FALSE(g.none_exists());
    REQUIRE(g.suggested);
    CHECK(holds((*g.suggested)[0]));
    CHECK(g.found.low > 0);
    CHECK(g.found.low <= std::min(servo_at(2, 1, (*g.suggested)[0]) - 0.8,
                                  0.92 - servo_at(2, 0.5, (*g.suggested)[0])));
    REQUIRE(g.tolerance.size() == 1);
    CHECK(holds(g.tolerance[0].lower()));
    CHECK(holds(g.tolerance[0].upper()));
    for (auto const& w : g.against) {
        double const end = servo_at(2, w.parameters[0], w.parameters[1]);
        CHECK((end < 0.8 || end > 0.92));
    }
    auto const fixed = sivid::with_gains(s.problem, {"K"}, *g.suggested);
    CHECK(sivid::verify(fixed, s.what, all_feasible(fixed)).answer ==
          sivid::requirement_answer::proved);
}

TEST_CASE("where no gain will do all are excluded") {
    // Fast parameters need K > 4, slow ones K < 4.
    servo const s({between(0.1, 0.2), between(1.8, 2)}, between(0, 30),
                  "x0 at end in [0.70, 0.85]");
    auto const g = s.found();
    CHECK(g.none_exists());
    CHECK_FALSE(g.some_proved());
    CHECK_FALSE(g.suggested);
    CHECK(g.against.size() >= 2);
    CHECK(decided_share(g, 0, 30, [](double) { return false; }) == 1);
}

TEST_CASE("only parameters in the sets count for gains") {
    servo const s({between(0.1, 0.2), between(1.8, 2)}, between(0, 30), "x0 at end > 0.8");
    CHECK(decided_share(s.found(), 0, 30, [](double gain) { return servo_at(2, 2, gain) > 0.8; }) >
          0.99);
}

TEST_CASE("nothing is excluded without a parameter that is proved feasible") {
    servo const s({between(0.5, 1)}, between(0, 20), "x0 at end in [0.8, 0.92]");
    auto feasible = all_feasible(s.problem);
    feasible.proved = [](std::vector<double> const& p) { return p[0] < 0.7; };
    auto const g = s.found(feasible);
    auto const says = [&](double gain) { return verdict_at(g, gain); };
    CHECK(says(1) == sivid::box_verdict::outside);  // all rates are too slow
    CHECK(says(19) == sivid::box_verdict::outside); // 0.5 is too fast
    double const slowest = 3.5; // too slow for 1 only, which nobody proves feasible
    REQUIRE(servo_at(2, 1, slowest) < 0.8);
    REQUIRE(servo_at(2, 0.7, slowest) > 0.8);
    CHECK(says(slowest) != sivid::box_verdict::outside);
    CHECK(says(slowest) != sivid::box_verdict::inside);
    auto const none = s.found(sivid::feasible_points{});
    CHECK(none.paving.paving.count(sivid::box_verdict::outside) == 0);
    CHECK(none.some_proved());
    CHECK(none.against.empty());
}

TEST_CASE("errors of sensors count at every instant") {
    double const bound = 0.05;
    servo const s({between(0.5, 1)}, between(0, 20), "x0 at end in [0.7, 0.95]", bound);
    auto const g = s.found(until(1e-2, 60));
    REQUIRE(g.some_proved());
    // The worst errors are constant: x0' = K (1 -+ bound) - (K + p0) x0.
    auto const holds = [bound](double gain) {
        return servo_at(2, 1, gain) * (1 - bound) >= 0.7 &&
               servo_at(2, 0.5, gain) * (1 + bound) <= 0.95;
    };
    auto const holds_without = [](double gain) {
        return servo_at(2, 1, gain) >= 0.7 && servo_at(2, 0.5, gain) <= 0.95;
    };
    CHECK(decided_share(g, 0, 20, [&](double gain) { // what is excluded violates for all errors
              return verdict_at(g, gain) == sivid::box_verdict::inside ? holds(gain)
                                                                       : holds_without(gain);
          }) > 0.1);
}

TEST_CASE("what happens between two instants only decides gains too") {
    servo const s({between(0.5, 0.55)}, between(2, 10), "eventually(abs(x0 - 0.5) < 0.05)");
    auto few = until(1e-2);
    few.motions.cells = 4;
    CHECK(decided_share(s.found(few), 2, 10, [](double) { return true; }) > 0.9);
}

TEST_CASE("a gain that does not matter is proved in its whole range") {
    auto p = decay({{between(0.5, 1), between(0, 7)}}, {sivid::interval(2.0)}, 1);
    p.model.about.constants.push_back({"K", "1", {}});
    p.choice.unknown.push_back("K");
    auto const judged = [&](char const* text) {
        auto const what = sivid::parse_requirement(text, p.model, p.end);
        return sivid::find_gains(p, {"K"}, what, all_feasible(p));
    };
    CHECK(judged("x0 at end > 0.7").paving.paving.inner_volume().lower() == 1);
    CHECK(judged("x0 at end > 0.8").none_exists());
}

TEST_CASE("a pair of gains") {
    // x1'' = -K x1 - D x1' - p0: the end lies within a band for a band of gains only.
    auto const open = support::model_of(
        {.states = 2, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{x[1], u[0] - c[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    sivid::closed_loop law(open);
    auto const k = law.gain("K", "1/s^2"), d = law.gain("D", "1/s");
    law.command("u0", k * (1.0 - law.state("x0")) - d * law.state("x1"));
    auto const closed = law.finish();
    sivid::prediction_problem p;
    p.model = closed.model;
    p.choice.unknown = {"D", "p0", "K"};
    p.sets = {{between(0, 6), between(-0.1, 0.1), between(0, 12)}};
    p.initial = {sivid::interval(0.0), sivid::interval(0.0)};
    p.end = 3;
    auto const what =
        sivid::parse_requirement("always(x0 < 1.1) and x0 at end > 0.9", p.model, p.end);
    auto const g = sivid::find_gains(p, {"K", "D"}, what, all_feasible(p),
                                     until(support::swept(1.0 / 16, 1.0 / 64), 600));
    REQUIRE(g.suggested);
    std::size_t inside = 0, outside = 0;
    auto const holds = [](double gain, double damping, double force) {
        double x = 0, v = 0, most = 0, h = 1e-3;
        for (int n = 0; n < 3000; ++n) { // midpoint rule
            double const a = gain * (1 - x) - damping * v - force;
            double const xm = x + h / 2 * v, vm = v + h / 2 * a;
            x += h * vm;
            v += h * (gain * (1 - xm) - damping * vm - force);
            most = std::max(most, x);
        }
        return std::min(1.1 - most, x - 0.9);
    };
    for (double gain = 0.3; gain < 12; gain += 0.77) {
        for (double damping = 0.2; damping < 6; damping += 0.41) {
            for (auto const& b : g.paving.paving.boxes()) {
                if (!contains(b.set[0], gain) || !contains(b.set[1], damping)) continue;
                double const worst =
                    std::min(holds(gain, damping, -0.1), holds(gain, damping, 0.1));
                if (b.verdict == sivid::box_verdict::inside) CHECK(worst > -1e-4);
                if (b.verdict == sivid::box_verdict::outside) CHECK(worst < 1e-4);
                inside += b.verdict == sivid::box_verdict::inside;
                outside += b.verdict == sivid::box_verdict::outside;
                break;
            }
        }
    }
    CHECK(inside > 10);
    CHECK(outside > 10);
}

TEST_CASE("a search for gains keeps its budget and proves nothing without time") {
    servo const s({between(0.5, 1)}, between(0, 20), "x0 at end in [0.8, 0.92]");
    auto const g = s.found({.motions = {.seconds = 0}, .accuracy = 1e-3});
    CHECK_FALSE(g.some_proved());
    CHECK_FALSE(g.none_exists());
    sivid::gain_options stopped;
    stopped.motions.keep_going = [] { return false; };
    CHECK_FALSE(s.found(stopped).some_proved());
}

TEST_CASE("gains that cannot be searched are refused") {
    servo const s({between(0.5, 1)}, between(0, 20), "x0 at end in [0.8, 0.92]");
    auto const refused = [&](sivid::prediction_problem const& p,
                             std::vector<std::string> const& gains, char const* words) {
        CHECK_THROWS_WITH(sivid::find_gains(p, gains, s.what, {}), ContainsSubstring(words));
    };
    refused(s.problem, {}, "no gain is named");
    refused(s.problem, {"Q"}, "'Q' is no unknown");
    auto apart = s.problem;
    apart.sets.push_back({between(0.5, 1), between(0, 10)});
    refused(apart, {"K"}, "the whole range of each gain");
    refused(decay({{between(0.5, 1)}}, {sivid::interval(2.0)}, 1), {"p0"}, "another model");
}
