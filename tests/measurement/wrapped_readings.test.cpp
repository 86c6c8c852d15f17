// SPDX-License-Identifier: MIT
#include <sivid/measurement/wrapped_readings.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

using namespace sivid;

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Readings of a channel at every tenth of a second.
record readings(std::vector<double> const& values, std::size_t channel = 0) {
    record result;
    for (std::size_t k = 0; k < values.size(); ++k)
        result.push_back({0.1 * static_cast<double>(k + 1), channel,
                          interval(values[k] - 0.02, values[k] + 0.02)});
    return result;
}
double wrapped(double y, double low = -std::numbers::pi) {
    return y - turn * std::floor((y - low) / turn);
}
/// What is shown of an angle, but for noise, and the angle.
struct seen {
    std::vector<double> angle, shown;
};
seen turning(support::draws& d, double rate) {
    seen s;
    double angle = d.uniform(-1, 1);
    for (int k = 0; k < 80; ++k) {
        angle += 0.1 * d.uniform(-0.3 * rate, rate);
        s.angle.push_back(angle);
        s.shown.push_back(wrapped(angle + d.uniform(-0.02, 0.02)));
    }
    return s;
}

} // namespace

TEST_CASE("wraps are counted so that readings follow the angle") {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        support::draws d(seed);
        auto const s = turning(d, d.uniform(2, 10));
        CAPTURE(seed);
        auto const n = wraps_of(readings(s.shown), 0, turn / 2, 0);
        double const before = std::round((s.angle[0] - s.shown[0]) / turn);
        for (std::size_t k = 0; k < s.angle.size(); ++k) {
            double const turns = n.approximate(0.1 * static_cast<double>(k + 1)) + before;
            CHECK(std::abs(s.shown[k] + turns * turn - s.angle[k]) < 0.05);
        }
    }
}

TEST_CASE("turns before the first reading are those that all starts and all T agree on") {
    auto const r = readings({-2.2, -2.1, -2.0});
    interval const known(turn), about(6.2, 6.4);
    auto const before = [&](interval const& start, interval const& of) {
        return wraps_before(r, 0, start, of);
    };
    CHECK(before(interval(-2.25), known) == 0);
    CHECK(before(interval(4.05), known) == 1);
    CHECK(before(interval(-2.2 - 3 * turn), about) == -3);
    CHECK(before(interval(4.05), interval(4.5, 10)) == 1);
    CHECK_FALSE(before(interval(4.05), interval(4.5, 13)));          // none, too
    CHECK(before(interval(-2.2 + 1000 * turn), known) == 1000);      // many turns away
    CHECK_FALSE(before(interval(-2.2 + 1000 * turn), about));        // T is not known so well
    CHECK(before(interval(-2.2, 0.9), known) == 0);                  // all of the start
    CHECK_FALSE(before(interval(0.9, 1.0), known));                  // about half a turn away
    CHECK_FALSE(before(interval(-2.2, 4), known));                   // the start is not known
    CHECK_FALSE(before(interval_traits<interval>::entire(), known)); // at all
    CHECK_FALSE(before(interval(-2.2), interval(0.0, 13.0)));        // T may be next to nothing
    CHECK(wraps_before(r, 1, interval(4.05), known) == 0);           // never read
    CHECK(wraps_of(r, 0, turn / 2, 0).values() == std::vector<double>{0});
    CHECK(wraps_of(r, 0, turn / 2, 0, -3).values() == std::vector<double>{-3});
    CHECK(wraps_of(r, 1, turn / 2, 0, 1).values() == std::vector<double>{1});
}

TEST_CASE("leaps tell T within what moves between two readings") {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        support::draws d(seed);
        auto const r = readings(turning(d, d.uniform(2, 25)).shown);
        auto const told = turn_of_leaps(r, 0, turn / 2);
        CAPTURE(seed);
        bool const leaps = wraps_of(r, 0, turn / 2, 0).values().size() > 1;
        CHECK(is_empty(told) == !leaps);
        if (leaps) CHECK((contains(told, turn) && width(told) < 1.5 * turn));
        CHECK(is_empty(turn_of_leaps(r, 1, turn / 2)));
    }
}

TEST_CASE("readings of which nobody can tell the turn are refused") {
    auto r = readings({2.9, 3.0, 3.1, -3.1, -3.0});
    CHECK(wraps_of(r, 0, 3, 0).values() == std::vector<double>{0, 1});
    auto twice = r;
    twice.push_back({r[3].time, 0, interval(3.12, 3.14)}); // at one time, on both sides
    CHECK_THROWS_WITH(wraps_of(twice, 0, 3, 0), ContainsSubstring("on both sides of a leap"));
    twice.back().bound = r[3].bound; // at one time, on one side
    CHECK(wraps_of(twice, 0, 3, 0).values() == std::vector<double>{0, 1});
    twice = r;
    twice[2].time = std::nextafter(r[3].time, 0.0); // no time lies between
    CHECK_THROWS_WITH(wraps_of(twice, 0, 3, 0), ContainsSubstring("on both sides of a leap"));
    for (bool const above : {true, false}) {
        double const inf = std::numeric_limits<double>::infinity();
        auto half = r;
        half.push_back({0.35, 0, above ? interval(3.1, inf) : interval(-inf, -3.1)});
        CHECK_THROWS_WITH(wraps_of(half, 0, 3, 0), ContainsSubstring("at t = 0.35 has one bound"));
        CHECK_NOTHROW(wraps_of(half, 1, 3, 0));
    }
}

TEST_CASE("the range within which readings wrap is seen") {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        support::draws d(seed);
        auto const s = turning(d, d.uniform(3, 10));
        CAPTURE(seed);
        CHECK_THAT(wrapping_range({readings(s.shown)}, 0, turn), WithinAbs(turn, 1.2));
        CHECK(wrapping_range({readings(s.angle)}, 0, turn) == 0);
        CHECK(wrapping_range({readings(s.shown)}, 1, turn) == 0); // never measured
    }
    // A counter of something else has to leap twice.
    std::vector<double> counts;
    for (int k = 0; k < 50; ++k) counts.push_back(std::fmod(3.0 * k, 64));
    CHECK_THAT(wrapping_range({readings(counts)}, 0, 0), WithinAbs(61, 1e-9));
    counts.resize(25);
    CHECK(wrapping_range({readings(counts)}, 0, 0) == 0);
    CHECK_THAT(wrapping_range({readings(counts), readings(counts)}, 0, 0), WithinAbs(61, 1e-9));
}

TEST_CASE("nothing wraps where steps are of all sizes, or none is a turn") {
    CHECK(wrapping_range({}, 0, turn) == 0);
    CHECK(wrapping_range({readings({1})}, 0, turn) == 0);
    CHECK(wrapping_range({readings({1, 1, 1, 1, 1})}, 0, turn) == 0);
    support::draws d(1);
    std::vector<double> noise, steps;
    for (int k = 0; k < 100; ++k) noise.push_back(d.uniform(-3.1, 3.1));
    CHECK(wrapping_range({readings(noise)}, 0, turn) == 0);
    for (int k = 0; k < 100; ++k) steps.push_back(k < 50 ? 0 : 2.5); // a step, of no turn
    CHECK(wrapping_range({readings(steps)}, 0, turn) == 0);
    for (int k = 0; k < 100; ++k) steps[static_cast<std::size_t>(k)] = k % 2 == 0 ? 0 : turn;
    CHECK(wrapping_range({readings(steps)}, 0, turn) == 0); // it leaps all the time
    for (int k = 0; k < 100; ++k)
        steps[static_cast<std::size_t>(k)] = k == 40 || k == 70 ? turn : 0;
    for (double const of : {turn, 0.0}) { // outliers, of one sample each
        CHECK(wrapping_range({readings(steps)}, 0, of) == 0);
    }
    steps[71] = steps[41] = turn; // of two, in what is no angle
    CHECK(wrapping_range({readings(steps)}, 0, 0) == 0);
}

TEST_CASE("readings without a finite bound, and others, say nothing of wraps") {
    auto all = readings({0, 0.1, 0.2});
    all.push_back({0.15, 0, interval_traits<interval>::entire()});
    all.push_back({0.15, 1, interval(6.2, 6.3)});
    CHECK(steps_of(all, 0).size() == 2);
    CHECK(steps_of(all, 1).empty());
    auto const n = wraps_of(all, 0, 3, 0);
    CHECK(n.values().size() == 1);
    CHECK(n.approximate(0.15) == 0);
}
