// SPDX-License-Identifier: MIT
#include <sivid/model/problem.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace sivid;
using support::between;

namespace {

identification_problem sound() {
    support::draws d(331);
    return support::plant(d, 0, {}).problem;
}

} // namespace

TEST_CASE("a sound problem is accepted") { CHECK_NOTHROW(sound().require_valid()); }

TEST_CASE("each defect of a problem is named") {
    auto const empty = interval_traits<interval>::empty();
    double const nan = std::numeric_limits<double>::quiet_NaN();
    auto p = sound();
    auto const refused = [&p](std::string const& words) {
        CHECK_THROWS_WITH(p.require_valid(), ContainsSubstring(words));
        CHECK_THROWS_AS(p.require_valid(), std::invalid_argument);
        p = sound();
    };
    p.choice.unknown.clear();
    refused("no unknown parameter");
    p.prior = box{between(0, 1)};
    refused("one side per parameter: 2 are needed, 1 was given");
    p.prior[1] = empty;
    refused("prior is empty");
    p.experiments.clear();
    refused("no experiment");
    p.experiments[0].initial = box{};
    refused("E0");
    p.experiments[0].inputs.push_back(sampled_signal({0}, {1}, interpolation::hold));
    refused("signals were given");
    p.experiments[0].initial[0] = empty;
    refused("initial box is empty");
    p.experiments[0].measurements.clear();
    refused("no measurement");
    p.experiments[0].measurements[2].channel = 7;
    refused("unknown channel");
    p.experiments[0].measurements[2].time = -1;
    refused("before the begin");
    p.experiments[0].measurements[2].time = nan;
    refused("E0");
    p.experiments[0].measurements[0].bound = empty;
    refused("empty measurement");
    double const inf = std::numeric_limits<double>::infinity();
    for (double const end : {inf, -inf}) {
        p.experiments[0].measurements[0].bound = interval(end, end); // without a member
        refused("empty measurement");
        p.experiments[0].begin = end;
        refused("no finite time");
    }
    p.experiments[0].measurements[0].bound = interval_traits<interval>::bounds(0, inf);
    CHECK_NOTHROW(p.require_valid());
    p.choice.fixed[p.choice.unknown[0]] = interval(1.0);
    refused("'" + p.choice.unknown[0] + "' is unknown and has a fixed value");
    p.experiments[0].begin = nan;
    refused("E0");
    p.experiments[0].constraint = true;
    p.experiments[0].outliers = 1;
    refused("allows no outliers");
}

TEST_CASE("a condition is no data, and what takes it for data is told so") {
    auto p = sound();
    CHECK_NOTHROW(p.require_data());
    CHECK_NOTHROW(p.require_valid_campaign());
    p.experiments.back().constraint = true;
    CHECK_NOTHROW(p.require_valid());
    CHECK_THROWS_WITH(p.require_data(), ContainsSubstring("'E0'") && ContainsSubstring("original"));
    CHECK_THROWS_WITH(p.require_valid_campaign(), ContainsSubstring("no data"));
}
