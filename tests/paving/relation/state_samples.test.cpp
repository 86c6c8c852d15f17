// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/channel_tube.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

experiment start_at(interval const& x) {
    experiment e;
    e.name = "S";
    e.initial = box{x};
    return e;
}

} // namespace

TEST_CASE("only channels that show a state as it is, and were measured, count") {
    auto const m = support::model_of(
        {3, 1, 0},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0], x[1], x[2]};
        },
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{2 * x[0], x[1] + 0, x[2], x[1], p[0] * x[2]};
        });
    auto const bound = bind(m, {{"p0"}, {}}, {});
    experiment e = start_at(between(0, 1));
    CHECK_FALSE(measured_states(bound, {&e})[1]);
    for (std::size_t y = 0; y < 5; ++y) e.measurements.push_back({1.0, y, between(0, 1)});
    auto const found = measured_states(bound, {&e});
    CHECK_FALSE(found[0]);
    CHECK(found[1] == 1U);
    CHECK(found[2] == 2U);
}

TEST_CASE("samples begin with the initial box, and agree at equal times") {
    auto e = start_at(between(0, 1));
    e.measurements = {{2.0, 0, between(1, 2)},   {1.0, 0, between(0, 3)}, {0.0, 0, between(0.5, 4)},
                      {2.0, 0, between(1.5, 3)}, {2.0, 1, between(7, 8)}, {3.0, 0, between(0, 1)},
                      {3.0, 0, between(2, 3)}};
    auto const s = state_samples::of(e, 0, 0);
    CHECK(s.times == std::vector<double>{0, 1, 2, 3});
    CHECK(equal(s.bounds[0], between(0.5, 1)));
    CHECK(equal(s.bounds[1], between(0, 3)));
    CHECK(equal(s.bounds[2], between(1.5, 2)));
    CHECK(equal(s.bounds[3], between(2, 3))); // they contradict each other: the later one
    auto const alone = state_samples::sensed(e, 0);
    CHECK(alone.times == s.times);
    CHECK(equal(alone.bounds[0], between(0.5, 4))); // without the initial state
    CHECK(state_samples::sensed(e, 2).times.empty());
    CHECK_THAT(s.period(), WithinAbs(1, 1e-14));
    CHECK(s.spacing() == s.period());
    CHECK(equal(*s.near(0.5), between(0, 3)));
    CHECK_FALSE(s.near(-1));
    CHECK_FALSE(s.near(3));
}

TEST_CASE("secants and their changes bound those of the truth") {
    auto e = start_at(between(0, 0));
    for (int k = 1; k <= 10; ++k) {
        double const t = 0.5 * k;
        e.measurements.push_back({t, 0, around(t * t, 0.01)});
    }
    auto const s = state_samples::of(e, 0, 0);
    CHECK(s.greatest_secant(1) >= 9.5);
    CHECK(s.greatest_secant(1) <= 9.6);
    CHECK_THAT(s.greatest_secant(100), WithinAbs(5, 0.01));
    // Over one gap the secant changes by 2 * 0.5, errors: 4 * 0.01/0.5.
    CHECK_THAT(s.secant_change(1).first, WithinAbs(1.08, 1e-6));
    CHECK(s.secant_change(1).second <= 1);
    CHECK(s.secant_change(1).second >= 0.9);
    CHECK_THAT(s.secant_change(3).first, WithinAbs(3, 0.03));
}

TEST_CASE("a start of which nothing is known is no sample to measure rates by") {
    auto e = start_at(between(-50, 50));
    for (int k = 1; k <= 3; ++k) e.measurements.push_back({0.1 * k, 0, around(1, 0.01)});
    auto const s = state_samples::of(e, 0, 0);
    CHECK(s.times.size() == 4);
    CHECK(s.without_vague_start().times.size() == 3);
    CHECK(s.without_vague_start().without_vague_start().times.size() == 3);
    CHECK(s.without_vague_start().greatest_secant(3) < 1);
    e.measurements[1].bound = interval_traits<interval>::bounds(0.0, HUGE_VAL);
    auto const told = state_samples::of(e, 0, 0).bounded();
    CHECK(told.times == std::vector<double>{0, 0.1, 3 * 0.1});
    CHECK(told.bounds.size() == 3);
    CHECK(state_samples{{0.0}, {between(0, 1)}}.period() == 1);
    CHECK(state_samples{{0.0}, {between(0, 1)}}.greatest_secant(3) == 0);
}

TEST_CASE("equal gaps are one period each, whatever the size of the time stamps") {
    for (double const begin : {0.0, -1e5, 1.7e9}) {
        auto e = start_at(between(-1, 1));
        e.begin = begin;
        for (int k = 1; k <= 200; ++k) e.measurements.push_back({begin + 0.01 * k, 0, {}});
        auto const s = state_samples::of(e, 0, 0);
        CHECK_THAT(s.period(), WithinRel(0.01, 1e-4));
        for (double const v : channel_tube::in_gaps({s.period(), 1}, s.times)) CHECK(v < 1.001);
    }
}

TEST_CASE("samples that are close together do not stand for the others") {
    auto e = start_at(between(-1, 1));
    for (int k = 1; k <= 40; ++k)
        for (int n = 0; n < 3; ++n) e.measurements.push_back({k + 1e-6 * n, 0, {}});
    auto const s = state_samples::of(e, 0, 0);
    CHECK(s.period() < 1e-5);
    CHECK_THAT(s.spacing(), WithinAbs(1 / 12.0, 1e-3));
}
