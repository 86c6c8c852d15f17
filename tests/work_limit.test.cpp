// SPDX-License-Identifier: MIT
#include <sivid/work_limit.hpp>

#include "support/catch.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

using Catch::Matchers::WithinAbs;
using sivid::work_clock;
using sivid::work_limit;

TEST_CASE("a limit ends when its seconds of work are counted, and its copies with it") {
    work_limit const limit(10);
    std::function<bool()> const copy = limit;
    work_clock::advance(9);
    CHECK(copy());
    CHECK_THAT(limit.seconds(), WithinAbs(1, 1e-6));
    CHECK_THAT(limit.spent(), WithinAbs(9, 1e-6));
    work_clock::advance(2);
    CHECK_FALSE(limit());
    CHECK_FALSE(copy());
    CHECK(limit.seconds() == 0);
    CHECK(limit.left() == 0);
    CHECK_FALSE(limit.late());
}

TEST_CASE("the time ends a limit that stands alone, and that is told") {
    using namespace std::chrono_literals;
    work_limit const alone(0.01);
    std::this_thread::sleep_for(20ms);
    CHECK_FALSE(alone());
    CHECK(alone.late());
    CHECK(alone.left() == 0);
}

TEST_CASE("a limit within another counts alone, and ends with it") {
    using namespace std::chrono_literals;
    work_limit const outer(1000);
    work_limit const inner(0.01, outer);
    std::this_thread::sleep_for(20ms);
    CHECK(inner());
    work_clock::advance(0.02);
    CHECK_FALSE(inner());
    CHECK_FALSE(inner.late());
    CHECK(outer());
    work_limit const brief(0.01);
    work_limit const within(1000, brief);
    std::this_thread::sleep_for(20ms);
    CHECK_FALSE(within());
    CHECK(within.late());
}

TEST_CASE("who says stop is obeyed, and grants no more than is asked for then") {
    bool stop = false;
    work_limit limit(1000, [&stop] { return !stop; });
    std::function<bool()> const copy = limit;
    CHECK(copy());
    stop = true;
    CHECK_FALSE(copy());
    CHECK(limit.seconds() == 0);
    limit.allow(100);
    CHECK(copy());
    CHECK(limit.seconds() <= 100);
    CHECK(limit.seconds() > 90);
}

TEST_CASE("allowing more never takes away") {
    work_limit limit(1000);
    limit.allow(1);
    CHECK(limit.seconds() > 900);
    work_limit spent(0);
    CHECK_FALSE(spent());
    spent.allow(10);
    CHECK(spent());
}

TEST_CASE("any number of seconds will do") {
    double const inf = std::numeric_limits<double>::infinity();
    for (double const seconds : {1e9, 1e300, inf}) CHECK(work_limit(seconds)());
    for (double const seconds : {-1.0, 0.0, -inf, std::nan("")}) CHECK_FALSE(work_limit(seconds)());
}

TEST_CASE("a stopwatch tells the time, of copies too") {
    using namespace std::chrono_literals;
    sivid::stopwatch const clock;
    std::this_thread::sleep_for(20ms);
    auto const same = clock;
    for (double const spent : {clock.spent(), same.spent()}) CHECK(spent >= 0.02);
}
