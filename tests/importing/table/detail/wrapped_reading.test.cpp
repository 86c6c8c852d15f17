// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/turns.hpp>

#include "io/import_support.hpp"
#include "support/random.hpp"

#include <cmath>
#include <string>

using namespace sivid;
using namespace io_support;

namespace {

wrapped_reading degrees() { return {dec("360"), dec("360")}; }

} // namespace

TEST_CASE("a heading is followed through its ends, exactly") {
    auto follow = degrees();
    CHECK(follow(dec("170.1")).lower == dec("170.1"));
    auto const over = follow(dec("-179.8"));
    CHECK(over.possible);
    CHECK(over.wrapped);
    CHECK_FALSE(over.doubtful);
    CHECK(over.lower == dec("180.2"));
    CHECK(over.upper == dec("180.2"));
    for (auto const* next : {"-90", "0", "90", "179.9"}) CHECK_FALSE(follow(dec(next)).wrapped);
    CHECK(follow(dec("-100")).lower == dec("620")); // the second turn
    auto const back = follow(dec("150"));
    CHECK(back.wrapped);
    CHECK(back.doubtful); // by 110 degrees at once
    CHECK(back.lower == dec("510"));
    for (auto const* before : {"30", "-60", "-150", "140"}) CHECK(follow(dec(before)).possible);
    CHECK(follow(dec("30")).lower == dec("30"));
}

TEST_CASE("half a period cannot be decided, and changes nothing") {
    auto follow = degrees();
    CHECK(follow(dec("10")).possible);
    CHECK_FALSE(follow(dec("190")).possible);
    CHECK_FALSE(follow(dec("-170")).possible);
    CHECK_FALSE(follow(dec("1e300")).possible);
    CHECK(follow(dec("20")).lower == dec("20"));
    CHECK_FALSE(wrapped_reading(dec("360"), dec("360"))(dec("1e9")).possible);
}

TEST_CASE("a period that is no decimal leaves bounds around the truth") {
    double const pi = 3.14159265358979323846;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        support::draws d(seed);
        wrapped_reading follow(dec("6.283185307179586"), dec("6.283185307179587"));
        double truth = d.uniform(-3, 3), width = 0;
        for (int k = 0; k < 400; ++k) {
            auto const seen = exact_decimal::shortest(std::remainder(truth, 2 * pi));
            auto const step = follow(seen);
            REQUIRE(step.possible);
            CHECK(*nearest(step.lower) <= truth + 1e-12);
            CHECK(*nearest(step.upper) >= truth - 1e-12);
            width = std::max(width, *nearest(step.upper - step.lower));
            truth += d.uniform(-1, 3);
        }
        CHECK(width > 0);
        CHECK(width < 1e-12);
    }
}
