// SPDX-License-Identifier: MIT
#include <sivid/decision/motion/detail/motion_cover.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace decision_support;

namespace {

struct cover_of_decay {
    sivid::prediction_problem problem =
        decay({{between(0.5, 0.7)}, {between(0.9, 1)}}, {between(1, 1.5)}, 1);
    sivid::followed_outputs outputs{problem.model, {}};
    sivid::motion_cover cover{problem, outputs, {0, 0.25, 0.5, 0.75, 1}, {}};
};

} // namespace

TEST_CASE("a part holds its motions at all segments, and its halves are sharper") {
    cover_of_decay c;
    auto whole = c.cover.whole();
    CHECK(whole.sets.size() == 2);
    c.cover.learn({&whole});
    REQUIRE(whole.known->complete);
    auto parts = c.cover.split(whole, 1); // along the parameter, at 0.75: between the sets
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].parameters[0].upper() == 0.7);
    CHECK(parts[1].parameters[0].lower() == 0.9);
    for (auto const& p : c.cover.split(parts[0], 0)) parts.push_back(p); // along the start
    parts.push_back(whole);
    support::draws d{1};
    for (auto const& p : parts) {
        auto const v = c.cover.look(p);
        CHECK(v.reached == 5);
        std::vector<double> low, high;
        c.cover.segments(p, v, 0, low, high);
        REQUIRE(low.size() == 9);
        for (int n = 0; n < 300; ++n) {
            auto const& set = c.problem.sets[p.sets[d.below(p.sets.size())]];
            double const rate = d.in(intersect(set, p.parameters))[0], x = d.in(p.initial)[0];
            auto const s = d.below(9);
            double const t = s % 2 == 0 ? 0.125 * static_cast<double>(s)
                                        : d.uniform(0.125 * static_cast<double>(s - 1),
                                                    0.125 * static_cast<double>(s + 1));
            double const y = x * std::exp(-rate * t);
            CHECK(low[s] <= y + 1e-13);
            CHECK(high[s] >= y - 1e-13);
        }
    }
    auto const rest = [&](auto const& p) { return c.cover.look(p).rest.back(); };
    CHECK(rest(parts[0]) < 0.5 * rest(whole));
}

TEST_CASE("sides without width have no variable and cannot be cut") {
    auto p = decay({{between(0.5, 0.7)}}, {sivid::interval(1.0)}, 1);
    sivid::followed_outputs const outputs(p.model, {});
    sivid::motion_cover cover(p, outputs, {0, 1}, {});
    auto whole = cover.whole();
    CHECK(cover.variable_of(whole, 1) == sivid::motion_cover::none); // nothing is known yet
    cover.learn({&whole});
    CHECK(cover.variable_of(whole, 0) == sivid::motion_cover::none);
    CHECK(cover.variable_of(whole, 1) == 0);
    CHECK(cover.split(whole, 0).empty());
    CHECK(cover.split(whole).size() == 2);
    auto single = cover.point({1.0}, {0.6});
    cover.learn({&single});
    auto const v = cover.look(single);
    CHECK(v.low.back() <= std::exp(-0.6));
    CHECK(v.high.back() >= std::exp(-0.6));
    CHECK(v.high.back() - v.low.back() < 1e-6);
    CHECK(cover.split(single).empty());
}

TEST_CASE("an integration that is cut short takes nothing away from what is known") {
    auto const p = decay({{between(0.5, 1)}}, {between(1, 1.5)}, 1);
    sivid::followed_outputs const outputs(p.model, {});
    bool going = true;
    sivid::run_options options;
    options.keep_going = [&going] { return going; };
    sivid::motion_cover cover(p, outputs, {0, 0.25, 0.5, 0.75, 1}, options);
    auto whole = cover.whole();
    cover.learn({&whole});
    REQUIRE(whole.known->complete);
    auto halves = cover.split(whole, 1);
    REQUIRE(halves.size() == 2);
    going = false;
    cover.learn({&halves[0], &halves[1]});
    for (auto const& half : halves) {
        CHECK(half.known->complete);
        CHECK(cover.look(half).reached == 5);
    }
}

TEST_CASE("a grid must go from the begin to the end") {
    cover_of_decay c;
    CHECK_THROWS_AS(sivid::motion_cover(c.problem, c.outputs, {0, 0.5}, {}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::motion_cover(c.problem, c.outputs, {0.1, 1}, {}), std::invalid_argument);
    CHECK_THROWS_AS(sivid::motion_cover(c.problem, c.outputs, {0}, {}), std::invalid_argument);
}

TEST_CASE("the widest side that can be cut is cut: a start given as a decimal is none") {
    // [0.1] as a decimal is two doubles wide: as wide as the whole, and nothing to halve.
    auto const decimal = support::between(0.1, std::nextafter(0.1, 1.0));
    auto const p = decay({{support::between(0.5, 1)}}, {decimal}, 1);
    sivid::motion_cover const cover(p, {p.model, {}}, {0, 1}, {});
    auto const halves = cover.split(cover.whole());
    REQUIRE(halves.size() == 2);
    CHECK(halves[0].parameters[0].upper() == 0.75);
    CHECK(halves[1].parameters[0].lower() == 0.75);
    CHECK(cover.share(cover.whole(), 0) == 0);
    CHECK(cover.share(halves[0], 1) == 0.5);
}
