// SPDX-License-Identifier: MIT
#include <sivid/work_limit.hpp>

#include "support/catch.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

using sivid::work_limit;

TEST_CASE("a limit ends after its seconds, and its copies with it") {
    using namespace std::chrono_literals;
    work_limit const longer(1000);
    CHECK(longer());
    CHECK(longer.seconds() <= 1000);
    work_limit const limit(0.01);
    std::function<bool()> const copy = limit;
    std::this_thread::sleep_for(20ms);
    CHECK_FALSE(limit());
    CHECK_FALSE(copy());
    CHECK(limit.seconds() == 0);
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

TEST_CASE("what is spent counts from the begin, of copies too") {
    using namespace std::chrono_literals;
    sivid::stopwatch const clock;
    work_limit const limit(0);
    std::this_thread::sleep_for(20ms);
    auto const copy = limit;
    auto const same = clock;
    for (double const spent : {clock.spent(), same.spent(), limit.spent(), copy.spent()}) {
        CHECK(spent >= 0.02);
    }
}
