// SPDX-License-Identifier: MIT
#include <sivid/decision/prediction.hpp>

#include "decision/planar_models.hpp"
#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/paving/judge/feasibility_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace decision_support;

namespace {

/// The segments that hold an instant.
std::vector<std::size_t> segments_at(std::vector<double> const& times, double t) {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < times.size(); ++k) {
        if (times[k] == t) return {2 * k};
        if (k > 0 && times[k - 1] < t && t < times[k]) return {2 * k - 1};
    }
    return all;
}

} // namespace

TEST_CASE("tubes hold every motion at every instant and are as wide as they must be") {
    auto const p = oscillator(between(1.5, 2.2), 4);
    auto const found = sivid::predict(p, {.cells = 40});
    REQUIRE(found.complete);
    CHECK(found.reached == 4);
    CHECK(found.excess <= 0.02);
    REQUIRE(found.states.size() == 2);
    auto const& x = found.states[0];
    support::draws d{3};
    for (int n = 0; n < 2000; ++n) {
        double const w = d.in(between(1.5, 2.2));
        double const t = n % 3 == 0 ? found.times[d.below(found.times.size())] : d.uniform(0, 4);
        double const value = std::cos(w * t);
        for (auto const s : segments_at(found.times, t)) {
            CHECK(x.low[s] <= value + 1e-14);
            CHECK(x.high[s] >= value - 1e-14);
        }
    }
    for (std::size_t k = 0; k < found.times.size(); ++k) {
        double low = 1, high = -1;
        for (int n = 0; n <= 700; ++n) {
            double const value = std::cos((1.5 + 0.001 * n) * found.times[k]);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        CHECK(x.high[2 * k] - x.low[2 * k] <= 1.03 * (high - low) + 1e-5);
    }
    // Between the instants there is little more.
    for (std::size_t s = 1; s < x.low.size(); s += 2) {
        CHECK(x.low[s] > std::min(x.low[s - 1], x.low[s + 1]) - 0.01);
        CHECK(x.high[s] < std::max(x.high[s - 1], x.high[s + 1]) + 0.01);
    }
}

TEST_CASE("a union of sets is predicted as such") {
    auto const p = decay({{between(0.1, 0.2)}, {between(1, 1.1)}}, {between(1, 1.01)}, 2);
    auto const found = sivid::predict(p, {.cells = 10});
    REQUIRE(found.complete);
    auto const& y = found.channels.at(0);
    CHECK(y.low.back() <= std::exp(-2.2));
    CHECK(y.low.back() > std::exp(-2.2) * 0.9);
    CHECK(y.high.back() >= 1.01 * std::exp(-0.2));
    CHECK(y.high.back() < 1.02 * std::exp(-0.2));
}

TEST_CASE("measurements leave of a tube what they leave of the parameters and no less") {
    for (auto const& start : {sivid::interval(2.0), sivid::interval(1.95, 2.05)}) {
        auto const data = plain_problem::make(0, 0, start);
        sivid::feasibility_test test(data, {});
        auto p = decay({{between(0.3, 0.5)}, {between(0.5, 0.8)}}, {sivid::interval(1.0)}, 3);
        auto const whole = sivid::predict(p, {.cells = 30});
        p.measured = [&](sivid::box const& parameters, std::function<bool()> const&) {
            auto const& run = data.experiments[0];
            return sivid::measured_responses{{test.run(0, run.initial, parameters)}, {run.initial}};
        };
        auto const found = sivid::predict(p, {.cells = 30});
        REQUIRE(found.complete);
        auto const feasible = plain_problem::feasible(); // from a start of 2
        double widest = 0;
        for (std::size_t k = 1; k < found.times.size(); ++k) {
            double const t = found.times[k];
            auto const& x = found.states[0];
            CHECK(x.low[2 * k] <= std::exp(-feasible.upper() * t));
            CHECK(x.high[2 * k] >= std::exp(-feasible.lower() * t));
            CHECK(x.low[2 * k] >= whole.states[0].low[2 * k]);
            CHECK(x.high[2 * k] <= whole.states[0].high[2 * k]);
            double const own = std::exp(-feasible.lower() * t) - std::exp(-feasible.upper() * t);
            widest = std::max(widest, (x.high[2 * k] - x.low[2 * k]) / own);
            CHECK(whole.states[0].high[2 * k] - whole.states[0].low[2 * k] > 2 * own);
        }
        CHECK(widest < (start.lower() == start.upper() ? 1.1 : 1.6));
    }
}

TEST_CASE("a motion that ends before the scenario does is said to") {
    auto const found = sivid::predict(explosion(between(0.9, 1.1), 2), {.seconds = 1, .cells = 40});
    CHECK_FALSE(found.complete);
    CHECK(found.reached < 1);
    CHECK(found.reached > 0.4);
    CHECK(std::isinf(found.states[0].high.back()));
    CHECK(std::isinf(found.excess));
}

TEST_CASE("expressions are followed besides") {
    auto p = oscillator(between(1.9, 2.1), 1);
    auto const node = p.model.g.add(p.model.g.leaf(sivid::operation::state, 0),
                                    p.model.g.leaf(sivid::operation::time, 0));
    auto const found = sivid::predict(p, {.cells = 10}, {node});
    REQUIRE(found.further.size() == 1);
    CHECK(found.further[0].low.back() <= std::cos(2.1) + 1);
    CHECK(found.further[0].high.back() >= std::cos(1.9) + 1);
}

TEST_CASE("a problem that does not fit is refused") {
    auto p = decay({{between(1, 2)}}, {sivid::interval(1.0)}, 1);
    CHECK_NOTHROW(p.require_valid());
    auto const refused = [](auto problem, char const* words) {
        CHECK_THROWS_WITH(sivid::predict(problem), ContainsSubstring(words));
    };
    auto q = p;
    q.end = 0;
    refused(q, "duration");
    q = p;
    q.end = NAN;
    refused(q, "duration");
    q = p;
    q.sets.clear();
    refused(q, "no parameters");
    q = p;
    q.sets = {{between(1, 2), between(1, 2)}};
    refused(q, "one side per parameter");
    q = p;
    q.sets = {{between(1, HUGE_VAL)}};
    refused(q, "bounded");
    q = p;
    q.initial = {};
    refused(q, "one side per state");
    q = p;
    q.inputs = {sivid::sampled_signal({0}, {0}, sivid::interpolation::hold)};
    refused(q, "one signal per input");
}

TEST_CASE("a prediction ends where a channel may reach a limit") {
    auto const p = decay({{support::between(0.5, 1)}}, {sivid::interval(2.0)}, 2);
    auto const whole = sivid::predict(p, {.cells = 20});
    REQUIRE(whole.complete);
    auto kept = whole;
    sivid::end_where_reached(kept, "y0", 2.1);
    CHECK(kept.complete);
    CHECK(kept.reached == whole.reached);
    auto none = whole; // it begins at 2
    sivid::end_where_reached(none, "y0", 2);
    CHECK_FALSE(none.complete);
    CHECK(none.reached == 0);
    CHECK(none.states[0].high[0] == HUGE_VAL);
    auto late = whole;
    late.channels[0].high[7] = 5; // between the instants 3 and 4
    sivid::end_where_reached(late, "y0", 4);
    CHECK(late.reached == late.times[3]);
    CHECK(late.states[0].high[6] == whole.states[0].high[6]);
    CHECK(late.states[0].high[7] == HUGE_VAL);
    CHECK(late.channels[0].low.back() == -HUGE_VAL);
    CHECK_THROWS_AS(sivid::end_where_reached(late, "z", 1), std::invalid_argument);
}
