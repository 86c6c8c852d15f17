// SPDX-License-Identifier: MIT
// Drawn clocks: the search keeps the true one, and comes near it.
#include <sivid/importing/scenario/detail/found_clock.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <functional>
#include <random>

using namespace sivid;

namespace {

/// Both ends hold the drawn clock, and are as narrow as that.
void check_ends(clock_range const& found, double offset, double drift, double ahead,
                double within) {
    CHECK(subset(interval(offset) - interval(drift) * interval(ahead), found.first));
    CHECK(subset(interval(offset) + interval(drift) * interval(ahead), found.last));
    CHECK(width(found.first) < within);
    CHECK(width(found.last) < within);
}

using signal_of = std::function<double(double)>;

/// Readings of a signal of the first clock, by a clock that shows t where that one shows
/// t + offset + drift t.
std::vector<shared_reading> record(std::mt19937_64& random, signal_of const& signal, double from,
                                   double to, double step, double error, double offset,
                                   double drift) {
    std::uniform_real_distribution<double> unit{-1, 1};
    std::vector<shared_reading> result;
    for (double t = from; t < to; t += step * (1 + 0.3 * unit(random))) {
        double const value = signal(t + offset + drift * t) + 0.999999 * error * unit(random);
        result.push_back({interval(t), interval(value - error, value + error)});
    }
    return result;
}

} // namespace

TEST_CASE("clocks are found by a signal that changes slowly, and the truth is never lost") {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> unit{-1, 1};
    for (int k = 0; k < 8; ++k) {
        double const offset = 2 * unit(random), drift = 2e-3 * unit(random);
        double const w = 2 + unit(random), error = 0.01;
        auto const signal = [w](double t) { return std::sin(w * t) + 0.5 * std::sin(0.7 * t); };
        auto const there = record(random, signal, -12, 12, 0.02, error, 0, 0);
        auto const here = record(random, signal, -9, 9, 0.05, error, offset, drift);
        clock_prior const prior{interval(-2.0, 2.0), interval(-2e-3, 2e-3), interval(9.0)};
        auto const found = clock_search(here, there, prior, w + 0.35)(prior);
        REQUIRE(found);
        check_ends(*found, offset, drift, 9, 0.04); // 2 errors by a slope of about 2
    }
}

TEST_CASE("clocks are found by a signal that steps, and the truth is never lost") {
    std::mt19937_64 random{6};
    std::uniform_real_distribution<double> unit{-1, 1};
    for (int k = 0; k < 40; ++k) {
        std::vector<double> edges; // at least 0.3 s apart
        for (double t = -30; t < 30; t += 0.3 + 2 * std::abs(unit(random))) edges.push_back(t);
        auto const signal = [&](double t) {
            return (std::ranges::upper_bound(edges, t) - edges.begin()) % 2 == 0 ? 0.0 : 1.0;
        };
        double const offset = 0.5 * unit(random), drift = 1e-3 * unit(random);
        auto const there = record(random, signal, -25, 25, 0.01, 0.1, 0, 0);
        auto const here = record(random, signal, -20, 20, 0.02, 0.1, offset, drift);
        clock_prior const prior{interval(-0.5, 0.5), interval(-1e-3, 1e-3), interval(20.0)};
        auto const found = clock_search(here, there, 0.5)(prior);
        REQUIRE(found);
        check_ends(*found, offset, drift, 20, 0.03); // the steps of both clocks
        clock_prior const wrong{interval(offset + 0.05, offset + 0.1), prior.drift, prior.ahead};
        CHECK_FALSE(clock_search(here, there, 0.5)(wrong));
    }
}

TEST_CASE("without readings that say anything a clock stays as it is stated") {
    clock_prior const prior{interval(-1.0, 1.0), interval(0.0), interval(1.0)};
    std::vector<shared_reading> const none, one{{interval(0.0), interval(0.0, 1.0)}};
    for (auto const& there : {none, one}) {
        auto const found = clock_search(one, there, prior, 1)(prior);
        REQUIRE(found);
        CHECK(width(found->first) == 2);
        CHECK(clock_search(none, there, 0.5)(prior));
    }
}
