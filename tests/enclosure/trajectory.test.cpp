// SPDX-License-Identifier: MIT
#include <sivid/enclosure/trajectory.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/systems.hpp"

#include <cfenv>
#include <limits>

using namespace sivid;
using support::between;

namespace {

std::shared_ptr<flow const> decay() {
    return support::flow_of(
        support::model_of({1, 1, 1}, [](auto const&, auto const& x, auto const& p,
                                        auto const& u) { return std::vector{u[0] - p[0] * x[0]}; }),
        {sampled_signal({0, 0.3, 0.7}, {1, 0, 2}, interpolation::hold)});
}

} // namespace

TEST_CASE("steps end at the knots of inputs and where asked") {
    auto const f = decay();
    trajectory<interval> run(*f, {});
    run.begin(0, box{interval(1.0)}, box{between(1, 1.1)});
    std::vector<double> ends;
    while (run.time() < 1) {
        REQUIRE(run.step(run.time() < 0.5 ? 0.5 : 1));
        ends.push_back(run.time());
        CHECK(run.last().to == run.time());
    }
    for (double const knot : {0.3, 0.5, 0.7, 1.0}) {
        CHECK(std::find(ends.begin(), ends.end(), knot) != ends.end());
    }
    CHECK(run.steps() == ends.size());
    CHECK_FALSE(run.failure());
    // Started anew it forgets.
    run.begin(2, box{interval(1.0)}, box{between(1, 1.1)});
    CHECK(run.time() == 2);
    CHECK(run.steps() == 0);
    CHECK(run.set().hull[0].lower() == 1);
}

TEST_CASE("a trajectory refuses boxes and steps that make no sense") {
    auto const f = decay();
    trajectory<interval> run(*f, {});
    box const x{interval(1.0)};
    CHECK_THROWS_AS(run.begin(0, box{}, x), std::invalid_argument);
    CHECK_THROWS_AS(run.begin(0, x, box{}), std::invalid_argument);
    CHECK_THROWS_AS(run.begin(0, box{interval_traits<interval>::empty()}, x),
                    std::invalid_argument);
    CHECK_THROWS_AS(run.begin(0, x, box{interval_traits<interval>::entire()}),
                    std::invalid_argument);
    CHECK_THROWS_WITH(run.begin(0, box{}, x),
                      ContainsSubstring("has 1 state and 1 unknown parameter, but boxes of 0 sides "
                                        "and 1 side were given"));
    CHECK_THROWS_WITH(run.begin(0, x, box{interval_traits<interval>::entire()}),
                      ContainsSubstring("the range of the parameter '") &&
                          ContainsSubstring("' is empty or unbounded"));
    run.begin(0, x, x);
    CHECK_THROWS_WITH(run.step(-1), ContainsSubstring("not from 0 to -1"));
    CHECK_THROWS_AS(run.step(0), std::invalid_argument);
    CHECK_THROWS_AS(run.step(-1), std::invalid_argument);
    CHECK_THROWS_AS(run.step(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
    CHECK(run.step(0.1));
}

TEST_CASE("a changed rounding mode of the caller is refused at the start") {
    auto const f = decay();
    trajectory<interval> run(*f, {});
    std::fesetround(FE_UPWARD);
    bool refused = false;
    try {
        run.begin(0, box{interval(1.0)}, box{interval(1.0)});
    } catch (unsound_environment const&) {
        refused = true;
    }
    std::fesetround(FE_TONEAREST);
    CHECK(refused);
}

TEST_CASE("after a failure nothing goes on, and what was proved stays") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 10}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0])};
        }));
    trajectory<interval> run(*f, {});
    run.begin(0, box{interval(1.0)}, box{});
    while (run.step(2)) {
    }
    REQUIRE(run.failure());
    double const time = run.time();
    CHECK(time < 1);
    CHECK_FALSE(run.step(2));
    CHECK(run.time() == time);
    CHECK(run.failure()->time == time);
}
