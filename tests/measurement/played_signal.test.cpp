// SPDX-License-Identifier: MIT
#include <sivid/measurement/played_signal.hpp>

#include "measurement/drawn_signal.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace sivid;
using measurement_support::drawn;
using support::draws;

namespace {

/// The play by its definition, at these increasing times, between which u goes one way.
/// @param sign  where u lies within its bounds, from -1 to 1
std::vector<double> by_definition(sampled_signal const& u, std::vector<double> const& times,
                                  double b, double sign) {
    std::vector<double> result;
    for (double const t : times) {
        auto const k = u.piece(t);
        double const now = u.approximate_on(k, t) + sign * u.error_bound(k, t);
        result.push_back(result.empty() ? now
                                        : std::fmax(now - b, std::fmin(now + b, result.back())));
    }
    return result;
}

} // namespace

TEST_CASE("an input behind a play lies within its slice, for every gap and every error") {
    draws d(91);
    for (int n = 0; n < 1500; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, d.below(2) == 0);
        double const begin = d.below(3) == 0 ? u.times().front() : d.uniform(-0.5, 0.5);
        double const end = begin + d.uniform(0, 4);
        double const low = d.below(3) == 0 ? 0.0 : d.uniform(0, 0.8);
        double const high = low + (d.below(3) == 0 ? 0.0 : std::exp(d.uniform(-8, 0)));
        auto const p = played(u, begin, end, interval(low, high));
        REQUIRE(p.slope_by_width.size() + (kind == interpolation::linear ? 1 : 0) ==
                p.within.times().size());
        std::vector<double> times{begin};
        for (double const t : u.times()) {
            if (begin < t && t < end) times.push_back(t);
        }
        for (int i = 0; i < 40; ++i) times.push_back(d.uniform(begin, end));
        times.push_back(end);
        std::sort(times.begin(), times.end());
        for (double const sign : {-1.0, 0.0, 1.0}) {
            double const b = d.below(3) == 0 ? low : d.below(2) == 0 ? high : d.uniform(low, high);
            auto const truth = by_definition(u, times, b, sign);
            for (std::size_t i = 0; i < times.size(); ++i) {
                auto const k = p.within.piece(times[i]);
                CAPTURE(n, times[i], b, low, high, sign);
                double const off = std::abs(truth[i] - p.within.approximate_on(k, times[i]));
                REQUIRE(off <= p.within.error_bound(k, times[i]) + 1e-14);
            }
        }
    }
}

TEST_CASE("between its samples the true play lies within one for one gap, to the rounding") {
    draws d(92);
    for (int n = 0; n < 300; ++n) {
        auto const u = drawn(d, interpolation::linear, false);
        double const b = d.uniform(0, 0.6);
        auto const p = played(u, -0.5, 3, interval(b));
        for (double const e : p.within.errors()) CHECK(e < 1e-13);
    }
    // A triangle: it rests for the gap's 0.5 after each turn, and follows by 0.25 behind.
    sampled_signal const u({0, 1, 2}, {0, 1, 0}, interpolation::linear);
    auto const p = played(u, 0, 2, interval(0.25));
    CHECK(p.within.times() == std::vector<double>{0, 0.25, 1, 1.5, 2});
    CHECK(p.within.values() == std::vector<double>{0, 0, 0.75, 0.75, 0.25});
    CHECK(p.slope_by_width == std::vector<double>{0, -1, -1, 1});
    auto const wide = played(u, 0, 2, interval(0.2, 0.3));
    for (double const e : wide.within.errors()) {
        CHECK(e >= 0.05);
        CHECK(e < 0.0501);
    }
    auto const none = played(u, 0, 2, interval(0.0));
    CHECK(none.within.values() == std::vector<double>{0, 1, 0});
    auto const stuck = played(u, 0, 2, interval(2.0));
    CHECK(stuck.within.values() == std::vector<double>{0, 0, 0});
    CHECK_THROWS_AS(played(u, 0, 2, interval(-0.1, 0.2)), std::invalid_argument);
}
