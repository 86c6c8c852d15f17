// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>

#include "diagnosis/lagged_input.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace sivid;
using diagnosis_support::lagged;

namespace {

/// A recorded input with jumps, long and short pieces, with errors or none.
sampled_signal drawn(support::draws& d, interpolation kind, bool with_errors) {
    std::vector<double> times, values, errors;
    double t = d.uniform(-1.0, 0.5);
    auto const count = 1 + d.below(12);
    for (std::size_t k = 0; k < count; ++k) {
        times.push_back(t);
        values.push_back(d.below(4) == 0 && k > 0 ? values.back() : d.uniform(-2.0, 2.0));
        errors.push_back(d.below(3) == 0 ? 0.0 : d.uniform(0.0, 0.3));
        t += d.below(3) == 0 ? d.uniform(1.0, 3.0) : d.uniform(0.001, 0.3);
    }
    if (!with_errors) errors.clear();
    return sampled_signal(times, values, kind, errors);
}

/// Errors hold outside of the samples, but lines through samples with errors leave them there.
std::pair<double, double> span_of(support::draws& d, sampled_signal const& u) {
    double begin = d.below(3) == 0 ? u.times().front() : d.uniform(-1.5, 2.0);
    double end = begin + d.uniform(0.0, 12.0);
    if (!u.exact()) {
        begin = std::clamp(begin, u.times().front(), u.times().back());
        end = std::clamp(end, begin, u.times().back());
    }
    return {begin, end};
}

/// One of the true inputs: at the edge of what the errors allow.
sampled_signal at_edge(sampled_signal const& u, double sign) {
    auto values = u.values();
    for (std::size_t k = 0; k < values.size() && !u.exact(); ++k) values[k] += sign * u.errors()[k];
    return sampled_signal(u.times(), values, u.kind());
}

void require_within(sampled_signal const& wide, double t, double value) {
    auto const k = wide.piece(t);
    double const off = std::abs(value - wide.approximate_on(k, t));
    INFO("t " << t << ", off by " << off << " of " << wide.error_bound(k, t));
    REQUIRE(off <= wide.error_bound(k, t) + 1e-11);
}

} // namespace

TEST_CASE("a lagged input lies within its slice for every time constant up to the longest") {
    support::draws d(7);
    for (int n = 0; n < 300; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, d.below(2) == 0);
        auto const [begin, end] = span_of(d, u);
        double const longest = std::exp(d.uniform(-7.0, 1.0));
        bool const rests = d.below(2) == 0;
        auto const wide = lagged_within(u, begin, end, longest, rests);
        for (int i = 0; i < 40; ++i) {
            double const tau = d.below(4) == 0 ? longest : longest * d.uniform(1e-6, 1.0);
            double const t = d.uniform(begin, end);
            for (double const sign : {-1.0, 0.0, 1.0}) {
                require_within(wide, t, lagged(at_edge(u, sign), begin, rests, tau, t));
            }
        }
        for (int i = 0; i < 10 && !rests; ++i) { // no lag at all
            double const t = d.uniform(begin, end);
            require_within(wide, t, u.approximate(t));
        }
    }
}

TEST_CASE("a late input lies within its slice for every delay") {
    support::draws d(8);
    for (int n = 0; n < 600; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, d.below(2) == 0);
        auto const [begin, end] = span_of(d, u);
        double const low = d.below(3) == 0 ? 0.0 : d.uniform(0.0, 1.0);
        double const high = low + (d.below(4) == 0 ? 0.0 : std::exp(d.uniform(-8.0, 0.5)));
        // Of every other input the clock runs slow, too.
        double const slow = n < 300 ? 0.0 : d.uniform(0.0, 0.4);
        double const slower =
            n < 300 ? 0.0 : slow + (d.below(4) == 0 ? 0.0 : std::exp(d.uniform(-8.0, -1.0)));
        auto const wide =
            delayed_within(u, begin, end, interval(low, high), interval(slow, slower));
        for (int i = 0; i < 40; ++i) {
            double const share = d.uniform(0.0, 1.0);
            double const drift = d.below(3) == 0 ? slower : d.uniform(slow, slower);
            double const tau = std::min(high, d.below(4) == 0   ? low
                                              : d.below(3) == 0 ? high
                                                                : low + share * (high - low));
            // Where the late input jumps, plain numbers do not tell on which side they are.
            double const t = d.uniform(begin, end);
            double const past = std::max(begin, t - tau - drift * (t - begin));
            if (std::abs(u.next_knot(past - 1e-12) - past) < 1e-11) continue;
            for (double const sign : {-1.0, 0.0, 1.0}) {
                require_within(wide, t, at_edge(u, sign).approximate(past));
            }
        }
    }
}

TEST_CASE("a late input lies about its line in the delay, for every delay") {
    support::draws d(9);
    double most_gained = 0;
    for (int n = 0; n < 400; ++n) {
        auto const u = drawn(d, interpolation::linear, d.below(3) == 0);
        auto const [begin, end] = span_of(d, u);
        double const low = d.below(3) == 0 ? 0.0 : d.uniform(0.0, 1.0);
        double const high = low + (d.below(4) == 0 ? 0.0 : std::exp(d.uniform(-8.0, 0.5)));
        auto const late = late_by_parameter(u, begin, end, interval(low, high));
        for (int i = 0; i < 60; ++i) {
            double const tau = d.below(4) == 0   ? low
                               : d.below(3) == 0 ? high
                                                 : std::min(high, d.uniform(low, high));
            double t = d.uniform(begin, end);
            if (d.below(3) == 0) { // about a knot
                auto const k = d.below(u.times().size());
                t = std::clamp(u.times()[k] + tau + d.uniform(-1e-3, 1e-3), begin, end);
            }
            double const past = std::max(begin, t - tau);
            auto const& w = late.middle;
            auto const k = w.piece(t);
            double const line = w.approximate(t) + late.slope.approximate(t) * (tau - late.at);
            double const error = w.error_bound(k, t);
            for (double const sign : {-1.0, 0.0, 1.0}) {
                double const truth = at_edge(u, sign).approximate(past);
                INFO("delay " << tau << " of " << low << " to " << high << ", t " << t);
                CHECK(std::abs(truth - line) <= error + 1e-13 * (1 + std::abs(truth)));
            }
            if (u.exact() && high > low) {
                auto const wide = delayed_within(u, begin, end, interval(low, high));
                double const there = wide.error_bound(wide.piece(t), t);
                if (there > 0) most_gained = std::max(most_gained, 1 - error / there);
            }
        }
    }
    CHECK(most_gained > 0.99);
    // Along a line the delay alone says all; about the knot, half of the change of slope.
    sampled_signal const bend({0.0, 1.0, 2.0}, {0.0, 1.0, 1.0}, interpolation::linear);
    auto const late = late_by_parameter(bend, 0, 2, interval(0.1, 0.2));
    CHECK(late.middle.error_bound(late.middle.piece(0.7), 0.7) < 1e-12);
    CHECK(late.slope.approximate(0.7) == -1);
    CHECK(std::abs(late.middle.error_bound(late.middle.piece(1.15), 1.15) - 0.025) < 1e-9);
}

TEST_CASE("an input behind a threshold lies about its line in that, for every threshold") {
    support::draws d(10);
    for (int n = 0; n < 1200; ++n) {
        auto const kind = n % 2 == 0 ? interpolation::linear : interpolation::hold;
        auto const u = drawn(d, kind, d.below(3) == 0);
        auto const [begin, end] = span_of(d, u);
        bool const stands = d.below(2) == 0;
        double const low = d.below(3) == 0 ? 0.0 : d.uniform(0.0, 1.5);
        double const high = low + (d.below(6) == 0 ? 0.0 : std::exp(d.uniform(-8.0, 0.5)));
        auto const in = threshold_by_parameter(u, begin, end, stands, interval(low, high));
        for (int i = 0; i < 40; ++i) {
            double const p = d.below(4) == 0   ? low
                             : d.below(3) == 0 ? high
                                               : std::min(high, d.uniform(low, high));
            double const t = d.below(4) == 0
                                 ? std::clamp(u.times()[d.below(u.times().size())], begin, end)
                                 : d.uniform(begin, end);
            double const line = in.middle.approximate(t) + in.slope.approximate(t) * (p - in.at);
            double const error = in.middle.error_bound(in.middle.piece(t), t);
            for (double const sign : {-1.0, 0.0, 1.0}) {
                double const x = at_edge(u, sign).approximate(t);
                double const cut = std::clamp(x, -p, p);
                double const truth = stands ? cut : x - cut;
                INFO("threshold " << p << " of " << low << " to " << high << ", t " << t
                                  << ", input " << x);
                CHECK(std::abs(truth - line) <= error + 1e-13 * (1 + std::abs(truth)));
            }
        }
    }
    // A ramp: errors about the threshold only.
    sampled_signal const ramp({0.0, 2.0}, {-2.0, 2.0}, interpolation::linear);
    for (bool const stands : {true, false}) {
        auto const in = threshold_by_parameter(ramp, 0, 2, stands, interval(0.9, 1.1));
        for (double const t : {0.2, 0.4, 0.8, 1.0, 1.2, 1.6, 1.9})
            CHECK(in.middle.error_bound(in.middle.piece(t), t) < 1e-12);
        CHECK(std::abs(in.middle.error_bound(in.middle.piece(1.5), 1.5) - 0.05) < 1e-9);
        CHECK(in.slope.approximate(1.7) == (stands ? 1 : -1));
        CHECK(in.slope.approximate(0.3) == (stands ? -1 : 1));
        CHECK(in.slope.approximate(1.2) == 0);
    }
}

TEST_CASE("slices of inputs are no wider than they must be") {
    // A ramp of slope 2: a lag of tau stays 2 tau behind, a delay of tau, too.
    sampled_signal const ramp({0.0, 1.0, 2.0, 3.0}, {0.0, 2.0, 4.0, 6.0}, interpolation::linear);
    auto const slow = lagged_within(ramp, 0, 3, 0.01, false);
    CHECK(slow.error_bound(slow.piece(2.5), 2.5) < 0.0200001);
    auto const late = delayed_within(ramp, 0, 3, interval(0.5, 0.75));
    CHECK(std::abs(late.approximate(2.5) - 2 * (2.5 - 0.625)) < 1e-12);
    CHECK(late.error_bound(late.piece(2.5), 2.5) < 0.2500001);
    // So does a clock that runs slow by a share: the more, the later.
    auto const later = delayed_within(ramp, 0, 3, interval(0.0), interval(0.1, 0.2));
    CHECK(std::abs(later.approximate(2) - 2 * 0.85 * 2) < 1e-12);
    CHECK(later.error_bound(later.piece(2.9), 2.9) < 2 * 0.05 * 3.01);
    CHECK(later.error_bound(later.piece(0.5), 0.5) < 2 * 0.05 * 1.7);
    // From a clock that stands to one that nearly keeps up: anything that was.
    auto const any = delayed_within(ramp, 0, 3, interval(0.0), interval(0.01, 1.5));
    for (double t = 0; t < 3; t += 0.1) {
        CHECK(std::abs(any.approximate(t) - 3) <= 3);
        CHECK(any.error_bound(any.piece(t), t) >= 3);
    }
    // A jump is forgotten.
    sampled_signal const jump({0.0, 1.0}, {0.0, 1.0}, interpolation::hold);
    auto const soon = lagged_within(jump, 0, 3, 0.05, false);
    CHECK(soon.error_bound(soon.piece(0.9), 0.9) == 0);
    CHECK(soon.error_bound(soon.piece(1.01), 1.01) >= 0.8);
    CHECK(soon.error_bound(soon.piece(1.9), 1.9) < 1e-3);
    auto const shifted = delayed_within(jump, 0, 3, interval(0.1, 0.2));
    CHECK(shifted.error_bound(shifted.piece(1.15), 1.15) >= 0.5);
    CHECK(shifted.error_bound(shifted.piece(1.25), 1.25) == 0);
    CHECK(shifted.approximate(1.25) == 1);
}

TEST_CASE("a switch lies within its slice whenever in it it goes on and off") {
    support::draws d(11);
    double open_most = 0;
    for (int n = 0; n < 4000; ++n) {
        double const begin = d.uniform(-1.0, 1.0), end = begin + d.uniform(0.0, 3.0);
        auto const time = [&] {
            auto const which = d.below(6);
            return which == 0 ? begin : which == 1 ? end : d.uniform(begin - 0.5, end + 0.5);
        };
        auto const slice = [&] {
            double a = time(), b = d.below(4) == 0 ? a : time();
            return a < b ? interval(a, b) : interval(b, a);
        };
        auto const within = [&](interval const& x) {
            return d.below(3) == 0   ? x.lower()
                   : d.below(2) == 0 ? x.upper()
                                     : d.uniform(x.lower(), x.upper());
        };
        switch_times times{slice()};
        bool const ends = d.below(2) == 0;
        if (ends) times.off = slice();
        auto const wide = switched_within(begin, end, times);
        double const on = within(times.on), off = ends ? within(times.off) : HUGE_VAL;
        INFO("on " << on << " in " << times.on.lower() << " to " << times.on.upper() << ", off "
                   << off << " in " << times.off.lower() << " to " << times.off.upper() << ", seen "
                   << begin << " to " << end);
        for (double const t : {begin, end, times.on.lower(), times.on.upper(), on, off,
                               times.off.lower(), times.off.upper(), d.uniform(begin, end)}) {
            if (!(t >= begin && t <= end)) continue;
            require_within(wide, t, on <= t && t < off ? 1 : 0);
            if (times.on.upper() >= end) require_within(wide, t, 0); // never
            if (ends && times.off.upper() >= end && on <= t) require_within(wide, t, 1);
            // No wider than it must be.
            auto const k = wide.piece(t);
            bool const open = wide.error_bound(k, t) > 0;
            bool const may_be_on =
                t >= times.on.lower() && (t < times.off.upper() || times.off.upper() >= end);
            bool const may_be_off =
                t < times.on.upper() || times.on.upper() >= end || t >= times.off.lower();
            CHECK(open == (may_be_on && may_be_off));
        }
        double const open = open_time(begin, end, times);
        CHECK((open >= 0 && open <= end - begin + 1e-12));
        open_most = std::max(open_most, open);
    }
    CHECK(open_most > 1);
    CHECK(open_time(0, 4, {interval(1, 2), interval(2.5, 3)}) == 1.5);
    CHECK(open_time(0, 4, {interval(1, 3), interval(2, 4)}) == 3);
}

TEST_CASE("an input that never changes is exact in every slice, so that states may rest") {
    for (double const value : {0.0, 250.0}) {
        for (auto const kind : {interpolation::linear, interpolation::hold}) {
            sampled_signal const u({0, 0.5, 1, 1.5}, {value, value, value, value}, kind);
            interval const delays(0.05, 0.2);
            CHECK(delayed_within(u, 0, 2, delays).exact());
            CHECK(lagged_within(u, 0, 2, 0.2, false).exact());
        }
        sampled_signal const u({0, 0.5, 1}, {value, value, value}, interpolation::linear);
        auto const late = late_by_parameter(u, 0, 2, interval(0.05, 0.2));
        CHECK(late.middle.exact());
        for (double const slope : late.slope.values()) CHECK(slope == 0);
    }
}
